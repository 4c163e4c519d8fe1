#include "sim/mpm/probes.h"

#include <algorithm>
#include <cmath>

#include "sim/math/parallel.h"
#include "sim/mpm/point_states.h"

namespace lather::mpm {
namespace {

/// Linear B-spline, of distances in cell widths: on the lattice of 2^d points a cell its weights sum to 1.
double tent(double cells) {
  return std::max(0.0, 1 - std::abs(cells));
}

/// Sums visit(part, set, tile, lane) over all points, in chunks of fixed size.
template <class Real, class Part, class Visit>
Part fold_points(const State<Real>& state, int threads, const Visit& visit) {
  constexpr std::size_t kChunkTiles = 64;
  Part sum{};
  for (std::size_t s = 0; s < state.sets.size(); ++s) {
    const ParticleSet<Real>& set = state.sets[s];
    sum = parallel_fold(
        threads, static_cast<std::int64_t>((set.tiles() + kChunkTiles - 1) / kChunkTiles), sum,
        [&](std::int64_t chunk) {
          Part part{};
          const std::size_t first = static_cast<std::size_t>(chunk) * kChunkTiles;
          for (std::size_t t = first; t < std::min(first + kChunkTiles, set.tiles()); ++t)
            for (int lane = 0; lane < kTile; ++lane)
              if (set.template values<std::uint32_t>(t, Field::kId)[lane] != kNoPoint)
                visit(part, s, t, lane);
          return part;
        },
        [](Part& to, const Part& part) { to += part; });
  }
  return sum;
}

using Stress = Eigen::Matrix<double, 6, 1>;  // xx yy zz xy xz yz

/// Weighted sums around a place.
struct Surroundings {
  double mass = 0;                 // sum w m, kg
  double volume = 0;               // sum w J V, m^3
  Vec3 momentum = Vec3::Zero();    // sum w m v
  Stress stress = Stress::Zero();  // sum w V tau = sum w J V sigma, Pa m^3
  void operator+=(const Surroundings& o) {
    mass += o.mass;
    volume += o.volume;
    momentum += o.momentum;
    stress += o.stress;
  }
};

template <class Real>
class PointReader {
 public:
  PointReader(const State<Real>& state, const Model<Real>& model) : state_(state), model_(model) {}

  [[nodiscard]] Surroundings around(const Vec3& place, int threads) const {
    return fold_points<Real, Surroundings>(state_, threads,
                                           [&](Surroundings& sum, std::size_t s, std::size_t t, int lane) {
                                             const double w = weight(state_.sets[s].position(t, lane), place);
                                             if (w > 0) add(sum, w, s, t, lane);
                                           });
  }

  [[nodiscard]] double volume_ratio(std::size_t s, std::size_t t, int lane) const {
    return 1 + state_.sets[s].volume_change(t, lane);
  }

 private:
  /// Product of tents about the nearest image of the place.
  [[nodiscard]] double weight(const Vec3& x, const Vec3& place) const {
    const Scene& scene = model_.scene;
    double w = 1;
    for (int a = 0; a < scene.dimension; ++a) {
      double d = x[a] - place[a];
      const double period = scene.domain.box.extent()[a];
      if (scene.domain.periodic[static_cast<std::size_t>(a)]) d -= period * std::round(d / period);
      w *= tent(d / scene.spacing);
    }
    return w;
  }

  void add(Surroundings& sum, double w, std::size_t s, std::size_t t, int lane) const {
    const MaterialConstants<Real>& material = model_.materials[s];
    const ParticleSet<Real>& set = state_.sets[s];
    const std::array<double, 6> tau = law_stress(set, material, t)[static_cast<std::size_t>(lane)];
    const double volume = set.share(t, lane) * static_cast<double>(material.volume);
    const double mass = set.share(t, lane) * static_cast<double>(material.mass);
    sum.mass += w * mass;
    sum.momentum += w * mass * set.velocity(t, lane);
    sum.volume += w * volume * volume_ratio(s, t, lane);
    for (int c = 0; c < 6; ++c) sum.stress[c] += w * volume * tau[static_cast<std::size_t>(c)];
  }

  const State<Real>& state_;
  const Model<Real>& model_;
};

/// Material at a plane.
struct PlaneSums {
  double above = 0;  // kg
  double area = 0;   // m^2; a length in 2D
  void operator+=(const PlaneSums& o) {
    above += o.above;
    area += o.area;
  }
};

/// Takes one sample of one probe.
template <class Real>
class Sampler {
 public:
  Sampler(const State<Real>& state, const Model<Real>& model, int threads)
      : state_(state), model_(model), threads_(threads) {}

  [[nodiscard]] std::vector<double> sample(const Probe& probe, const ProbeState& own) const {
    return std::visit([&](const auto& kind) { return of(kind, own); }, probe.kind);
  }

 private:
  [[nodiscard]] std::vector<double> of(const ForceProbe&, const ProbeState& own) const {
    return mean_load(own);
  }
  [[nodiscard]] std::vector<double> of(const WallProbe&, const ProbeState& own) const {
    return mean_load(own);
  }

  [[nodiscard]] std::vector<double> mean_load(const ProbeState& own) const {
    const Vec3 force = own.load.impulse / (state_.time - own.since);
    const Vec3 torque = own.load.moment / (state_.time - own.since);
    return {force.x(), force.y(), force.z(), torque.x(), torque.y(), torque.z()};
  }

  [[nodiscard]] std::vector<double> of(const PointProbe& probe, const ProbeState&) const {
    const Scene& scene = model_.scene;
    Vec3 place = probe.at;
    if (!probe.obstacle.empty()) {
      const Pose pose = pose_at(scene.obstacles[obstacle_index(scene, probe.obstacle)].motion, state_.time);
      place = pose.rotation * place + pose.translation;
    }
    const Surroundings s = PointReader<Real>(state_, model_).around(place, threads_);
    if (!(s.mass > 0)) return std::vector<double>(7, 0.0);
    const double cell = std::pow(scene.spacing, scene.dimension);
    const Vec3 v = s.momentum / s.mass;
    const Stress sigma = s.stress / s.volume;
    const double pressure = -(sigma[0] + sigma[1] + sigma[2]) / 3;
    const Vec3 normal = sigma.head<3>().array() + pressure;  // of the deviator
    const double von_mises = std::sqrt(1.5 * (normal.squaredNorm() + 2 * sigma.tail<3>().squaredNorm()));
    return {v.x(), v.y(), v.z(), s.mass / cell, s.volume / cell, pressure, von_mises};
  }

  [[nodiscard]] std::vector<double> of(const PlaneProbe& probe, const ProbeState& own) const {
    const Scene& scene = model_.scene;
    const PlaneFrame plane(probe, scene.dimension);
    const PointReader<Real> reader(state_, model_);
    const PlaneSums sums = fold_points<Real, PlaneSums>(
        state_, threads_, [&](PlaneSums& sum, std::size_t s, std::size_t t, int lane) {
          const Vec3 x = state_.sets[s].position(t, lane);
          const double height = plane.height(x);
          const double share = state_.sets[s].share(t, lane);
          if (height > 0) sum.above += share * static_cast<double>(model_.materials[s].mass);
          const double w = tent(height / scene.spacing) / scene.spacing;
          if (w > 0 && plane.covers(x))
            sum.area +=
                w * share * static_cast<double>(model_.materials[s].volume) * reader.volume_ratio(s, t, lane);
        });
    return {own.passed / (state_.time - own.since), own.passed_before + own.passed, sums.above, sums.area};
  }

  const State<Real>& state_;
  const Model<Real>& model_;
  int threads_;
};

double interval_of(const Scene& scene, const Probe& probe) {
  return probe.interval > 0 ? probe.interval : 1 / scene.frame_rate;
}

/// Type and columns of each kind of probe. Forces and fluxes in 2D are those of a slab one metre deep.
struct Describe {
  ProbeSeries operator()(const ForceProbe&) const { return load("force"); }
  ProbeSeries operator()(const WallProbe&) const { return load("walls"); }
  ProbeSeries operator()(const PointProbe&) const {
    return {"",
            "point",
            {{"velocity_x", "m/s"},
             {"velocity_y", "m/s"},
             {"velocity_z", "m/s"},
             {"density", "kg/m^3"},
             {"volume_fraction", "1"},
             {"pressure", "Pa"},
             {"von_mises_stress", "Pa"}},
            {},
            {}};
  }
  ProbeSeries operator()(const PlaneProbe&) const {
    return {"",
            "plane",
            {{"mass_flux", "kg/s"}, {"mass_passed", "kg"}, {"mass_above", "kg"}, {"area", "m^2"}},
            {},
            {}};
  }
  static ProbeSeries load(const char* type) {
    return {"",
            type,
            {{"force_x", "N"},
             {"force_y", "N"},
             {"force_z", "N"},
             {"torque_x", "N m"},
             {"torque_y", "N m"},
             {"torque_z", "N m"}},
            {},
            {}};
  }
};

}  // namespace

std::vector<ProbeState> first_probe_states(const Scene& scene) {
  std::vector<ProbeState> states(scene.probes.size());
  for (std::size_t p = 0; p < states.size(); ++p)  // a mean has its first value after the first interval
    states[p].sample = std::holds_alternative<PointProbe>(scene.probes[p].kind) ? 0 : 1;
  return states;
}

std::vector<ProbeSeries> empty_probe_series(const Scene& scene) {
  std::vector<ProbeSeries> all;
  for (const Probe& p : scene.probes) {
    all.push_back(std::visit(Describe{}, p.kind));
    all.back().name = p.name;
  }
  return all;
}

template <class Real>
void sample_probes(State<Real>& state, const Model<Real>& model, int threads,
                   std::vector<ProbeSeries>& series) {
  constexpr double kRounding = 1e-9;  // of an interval: times are sums of steps
  const Sampler<Real> sampler(state, model, threads);
  for (std::size_t p = 0; p < state.probes.size(); ++p) {
    ProbeState& own = state.probes[p];
    const double intervals = state.time / interval_of(model.scene, model.scene.probes[p]) + kRounding;
    if (intervals < static_cast<double>(own.sample)) continue;
    const std::vector<double> values = sampler.sample(model.scene.probes[p], own);
    series[p].times.push_back(state.time);
    series[p].values.insert(series[p].values.end(), values.begin(), values.end());
    own = {static_cast<std::uint64_t>(intervals) + 1, state.time, {}, 0, own.passed_before + own.passed};
  }
}

template void sample_probes(State<float>&, const Model<float>&, int, std::vector<ProbeSeries>&);
template void sample_probes(State<double>&, const Model<double>&, int, std::vector<ProbeSeries>&);

}  // namespace lather::mpm
