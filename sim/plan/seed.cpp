#include "sim/plan/seed.h"

#include <cmath>
#include <numbers>

#include "sim/math/counter_rng.h"
#include "sim/scene/value.h"
#include "sim/shape/shape.h"

namespace lather {
namespace {

/// Lattice places that are tried for all bodies together: planning answers within seconds.
constexpr double kMostPlaces = 3e8;
/// Ids are 32 bits wide.
constexpr double kMostPoints = 4e9;

/// Lattice places 0 … count-1 per axis; place i lies at min + (i + 1/2) distance. A lattice that has moved by
/// `shift` is described by its places that are in the domain now: `first` is the first one's own index.
struct Lattice {
  Vec3 min;
  double distance;
  std::array<std::int64_t, 3> count{1, 1, 1};
  std::array<std::int64_t, 3> first{0, 0, 0};

  explicit Lattice(const Scene& scene, const Vec3& shift = Vec3::Zero())
      : min(scene.domain.box.min), distance(point_distance(scene)) {
    const Vec3 extent = scene.domain.box.extent();
    for (int a = 0; a < scene.dimension; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      const double whole = std::round(shift[a] / distance);
      min[a] += shift[a] - whole * distance;
      first[axis] = -static_cast<std::int64_t>(whole);
      count[axis] = static_cast<std::int64_t>(std::floor(extent[a] / distance + 1e-6));
    }
  }

  [[nodiscard]] Vec3 position(const std::int64_t (&index)[3], int dimension) const {
    Vec3 x = Vec3::Zero();
    for (int a = 0; a < dimension; ++a) x[a] = min[a] + (static_cast<double>(index[a]) + 0.5) * distance;
    return x;
  }

  /// A number of its own for every place; the key of its random numbers.
  [[nodiscard]] std::uint64_t key(const std::int64_t (&index)[3]) const {
    return static_cast<std::uint64_t>(((index[0] + first[0]) * count[1] + index[1] + first[1]) * count[2] +
                                      index[2] + first[2]);
  }
};

/// The range of lattice places that a body's box covers.
void clip(const Lattice& lattice, const Box3& box, int dimension, std::array<std::int64_t, 3>& first,
          std::array<std::int64_t, 3>& last) {
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    first[axis] = 0;
    last[axis] = lattice.count[axis] - 1;
    if (a >= dimension) continue;
    const auto n = static_cast<double>(lattice.count[axis]);
    const double lo = std::floor((box.min[a] - lattice.min[a]) / lattice.distance) - 1;
    const double hi = std::ceil((box.max[a] - lattice.min[a]) / lattice.distance) + 1;
    first[axis] = static_cast<std::int64_t>(std::fmin(std::fmax(lo, 0.0), n));
    last[axis] = static_cast<std::int64_t>(std::fmin(std::fmax(hi, -1.0), n - 1));
  }
}

/// Calls visit(key, x) for every place of the lattice that lies in `shape`.
template <class Visit>
void for_places_in(const Scene& scene, const Lattice& lattice, const Shape& shape, const Visit& visit) {
  std::array<std::int64_t, 3> first{};
  std::array<std::int64_t, 3> last{};
  clip(lattice, bounds(shape, scene.domain.box), scene.dimension, first, last);
  for (std::int64_t i = first[0]; i <= last[0]; ++i)
    for (std::int64_t j = first[1]; j <= last[1]; ++j)
      for (std::int64_t k = first[2]; k <= last[2]; ++k) {
        const std::int64_t index[3] = {i, j, k};
        const Vec3 x = lattice.position(index, scene.dimension);
        if (distance(shape, x) < 0) visit(lattice.key(index), x);
      }
}

/// Calls visit(key, x) for every lattice place whose point lies in `body` and in no earlier body.
template <class Visit>
void for_points_of_body(const Scene& scene, std::size_t body, const Visit& visit) {
  for_places_in(scene, Lattice(scene), *scene.bodies[body].shape, [&](std::uint64_t key, const Vec3& x) {
    for (std::size_t b = 0; b < body; ++b)
      if (distance(*scene.bodies[b].shape, x) < 0) return;
    visit(key, x);
  });
}

/// Calls visit(key, x) for every point of one release.
template <class Visit>
void for_points_of_release(const Scene& scene, const Release& release, const Visit& visit) {
  const Shape& shape = *scene.emitters[release.emitter].shape;
  for_places_in(scene, Lattice(scene, release.shift), shape, [&](std::uint64_t key, const Vec3& x) {
    if (!release.layer || distance(shape, x - release.sweep) >= 0) visit(key, x);
  });
}

/// Lattice places in the part of a shape's box that is in the domain.
double places_in_box(const Scene& scene, const Shape& shape) {
  const Box3 box = bounds(shape, scene.domain.box);
  double places = 1;
  for (int a = 0; a < scene.dimension; ++a) {
    const double lo = std::fmax(box.min[a], scene.domain.box.min[a]);
    const double hi = std::fmin(box.max[a], scene.domain.box.max[a]);
    places *= std::fmax(0.0, hi - lo) / point_distance(scene) + 1;
  }
  return places;
}

/// Refuses a scene so fine that planning it would take minutes.
void check_size(const Scene& scene) {
  double places = 0;
  for (const Body& body : scene.bodies) places += places_in_box(scene, *body.shape);
  for (const Emitter& emitter : scene.emitters) places += places_in_box(scene, *emitter.shape);
  if (places > kMostPlaces)
    throw InputError({{"/spacing", std::to_string(scene.spacing),
                       "at most 3e8 lattice places in the boxes of all bodies and emitters",
                       "At this spacing the boxes of bodies and emitters hold " + std::to_string(places) +
                           " places for points; raise \"spacing\", lower \"points_per_cell\" or use "
                           "smaller shapes."}});
}

/// x, jittered by random numbers of `seed`, keyed by the place.
Vec3 jittered(const Scene& scene, std::uint64_t seed, std::uint64_t key, Vec3 x) {
  if (scene.jitter == 0) return x;
  const double d = point_distance(scene);
  for (int a = 0; a < scene.dimension; ++a)
    x[a] += scene.jitter * d * (random_unit(seed, key, static_cast<std::uint64_t>(a)) - 0.5);
  return x;
}

std::uint32_t material_index(const Scene& scene, const std::string& name) {
  std::uint32_t i = 0;
  while (scene.materials[i].name != name) ++i;
  return i;
}

/// Which material each point of a body is of.
class MaterialChoice {
 public:
  MaterialChoice(const Scene& scene, std::size_t body)
      : random_(random_bits(scene.seed, kMixtures, static_cast<std::uint64_t>(body))) {
    const Body& b = scene.bodies[body];
    for (const std::string& name : b.material_names()) materials_.push_back(material_index(scene, name));
    for (const MixturePart& part : b.mixture) up_to_.push_back(share_so_far() + part.share);
  }

  [[nodiscard]] std::uint32_t of(std::uint64_t key) const {
    if (up_to_.empty()) return materials_.front();
    const double drawn = random_unit(random_, key) * up_to_.back();
    std::size_t i = 0;
    while (i + 1 < up_to_.size() && drawn >= up_to_[i]) ++i;
    return materials_[i];
  }

 private:
  /// Keeps these random numbers apart from those of jitter and emitters.
  static constexpr std::uint64_t kMixtures = 0x6d69787475726573U;

  [[nodiscard]] double share_so_far() const { return up_to_.empty() ? 0.0 : up_to_.back(); }

  std::uint64_t random_;
  std::vector<std::uint32_t> materials_;
  std::vector<double> up_to_;
};

/// 1 + index of the first grip that takes a point of `body` at `x` (m); 0 for none.
std::uint32_t grip_at(const Scene& scene, const Body& body, const Vec3& x) {
  for (std::uint32_t g = 0; g < scene.grips.size(); ++g) {
    const Grip& grip = scene.grips[g];
    const bool owned = grip.body.empty() || grip.body == body.name;
    if (owned && (grip.shape == nullptr || distance(*grip.shape, x) < 0)) return g + 1;
  }
  return 0;
}

Mat3 spin_matrix(const Vec3& spin) {
  Mat3 m;
  m << 0, -spin.z(), spin.y(), spin.z(), 0, -spin.x(), -spin.y(), spin.x(), 0;
  return m;
}

/// The mean of the positions that for_points(visit) visits; throws `none` when there are none.
template <class ForPoints>
Vec3 center_of(const ForPoints& for_points, const Problem& none) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for_points([&](std::uint64_t, const Vec3& x) {
    sum += x;
    ++count;
  });
  if (count == 0) throw InputError({none});
  return sum / count;
}

Vec3 center_of_body(const Scene& scene, std::size_t body) {
  return center_of(
      [&](const auto& visit) { for_points_of_body(scene, body, visit); },
      {"/bodies/" + std::to_string(body) + "/shape", "", "at least one point",
       "No point of the lattice lies inside this body: it is outside the domain, hidden by earlier "
       "bodies, or thinner than the distance of points; move or enlarge it, or lower \"spacing\"."});
}

/// Throws when some grip takes no point.
void check_grips(const Scene& scene) {
  std::vector<bool> taken(scene.grips.size() + 1, false);
  for (std::size_t b = 0; b < scene.bodies.size() && !scene.grips.empty(); ++b)
    for_points_of_body(scene, b, [&](std::uint64_t key, const Vec3& x) {
      taken[grip_at(scene, scene.bodies[b], jittered(scene, scene.seed, key, x))] = true;
    });
  for (std::size_t g = 0; g < scene.grips.size(); ++g)
    if (!taken[g + 1])
      throw InputError(
          {{"/grips/" + std::to_string(g), write_json(Value(scene.grips[g].name)), "at least one point",
            "No point of a body lies inside this grip, or earlier grips take them all; move or "
            "enlarge its \"shape\", or name another \"body\"."}});
}

/// Points of one release; throws when its shape holds none.
std::uint64_t count_of(const Scene& scene, const Release& release) {
  std::uint64_t count = 0;
  for_points_of_release(scene, release, [&](std::uint64_t, const Vec3&) { ++count; });
  return count;
}

/// What an emitter gives over the run if nothing waits; `before` points come from bodies and earlier
/// emitters.
std::uint64_t count_of_emitter(const Scene& scene, std::size_t emitter, double before) {
  const Emitter& e = scene.emitters[emitter];
  const double copy = static_cast<double>(count_of(scene, Release::copy_of(emitter, 0)));
  if (copy == 0)
    throw InputError(
        {{"/emitters/" + std::to_string(emitter) + "/shape", "", "at least one point",
          "No point of the lattice lies inside this emitter: it is outside the domain, or thinner "
          "than the distance of points; move or enlarge it, or lower \"spacing\"."}});
  double points = 0;
  if (e.start <= scene.duration && !e.stream) {
    const double fit = e.interval > 0 ? std::floor((scene.duration - e.start) / e.interval + 1e-9) + 1 : 1;
    points = copy * std::fmin(fit, e.count);
  } else if (e.start <= scene.duration) {
    const Vec3 sweep = e.velocity * layer_interval(scene, e);
    const double layers =
        std::floor((std::fmin(e.end, scene.duration) - e.start) / layer_interval(scene, e) + 1e-9);
    points = copy + layers * static_cast<double>(count_of(scene, {emitter, 1, sweep, sweep, true}));
  }
  if (before + points >= kMostPoints)
    throw InputError(
        {{"/emitters/" + std::to_string(emitter), write_json(Value(e.name)), "less than 4e9 points in all",
          "This emitter would give " + write_json(Value(points)) +
              " points; lower \"count\", or the velocity of a stream, or raise \"spacing\"."}});
  return static_cast<std::uint64_t>(points);
}

}  // namespace

double point_distance(const Scene& scene) {
  return scene.spacing / std::round(std::pow(scene.points_per_cell, 1.0 / scene.dimension));
}

double layer_interval(const Scene& scene, const Emitter& emitter) {
  return point_distance(scene) / emitter.velocity.norm();
}

void seed_points(const Scene& scene, const std::function<void(const Seed&)>& visit) {
  check_size(scene);
  Seed seed;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    const MaterialChoice materials(scene, b);
    const Vec3 center = center_of_body(scene, b);
    const Vec3 spin = body.spin_deg * (std::numbers::pi / 180);
    seed.velocity_gradient = body.velocity_gradient + spin_matrix(spin);
    for_points_of_body(scene, b, [&](std::uint64_t key, const Vec3& x) {
      seed.material = materials.of(key);
      seed.position = jittered(scene, scene.seed, key, x);
      seed.grip = grip_at(scene, body, seed.position);
      seed.velocity =
          body.velocity + body.velocity_gradient * seed.position + spin.cross(seed.position - center);
      visit(seed);
      ++seed.id;
    });
  }
}

void seed_release(const Scene& scene, const Release& release, const std::function<void(const Seed&)>& visit) {
  const Emitter& emitter = scene.emitters[release.emitter];
  const auto for_points = [&](const auto& each) { for_points_of_release(scene, release, each); };
  const Vec3 spin = emitter.spin_deg * (std::numbers::pi / 180);
  const Vec3 center = spin.isZero(0) ? Vec3(Vec3::Zero()) : center_of(for_points, {});
  // A stream is one moving lattice; every copy has random numbers of its own.
  const std::uint64_t random =
      random_bits(scene.seed, release.emitter + 1, emitter.stream ? 0 : release.number);
  Seed seed;
  seed.material = material_index(scene, emitter.material);
  seed.velocity_gradient = spin_matrix(spin);
  for_points([&](std::uint64_t key, const Vec3& x) {
    seed.position = jittered(scene, random, key, x);
    seed.velocity = emitter.velocity + spin.cross(seed.position - center);
    visit(seed);
    ++seed.id;
  });
}

PointCounts count_points(const Scene& scene) {
  check_size(scene);
  PointCounts counts;
  counts.at_start.assign(scene.materials.size(), 0);
  counts.emitted.assign(scene.materials.size(), 0);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    std::uint64_t own = 0;
    const MaterialChoice materials(scene, b);
    for_points_of_body(scene, b, [&](std::uint64_t key, const Vec3&) {
      ++own;
      ++counts.at_start[materials.of(key)];
    });
    if (own == 0) (void)center_of_body(scene, b);  // throws with the reason
  }
  check_grips(scene);
  double total = 0;
  for (const std::uint64_t own : counts.at_start) total += static_cast<double>(own);
  for (std::size_t e = 0; e < scene.emitters.size(); ++e) {
    const std::uint64_t own = count_of_emitter(scene, e, total);
    counts.emitted[material_index(scene, scene.emitters[e].material)] += own;
    total += static_cast<double>(own);
  }
  return counts;
}

}  // namespace lather
