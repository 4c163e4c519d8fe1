#include "sim/plan/seed.h"

#include <cmath>
#include <numbers>

#include "sim/math/counter_rng.h"
#include "sim/shape/shape.h"

namespace lather {
namespace {

/// Lattice places that are tried for all bodies together: planning answers within seconds.
constexpr double kMostPlaces = 3e8;

/// Lattice places 0 … count-1 per axis; place i lies at min + (i + 1/2) distance.
struct Lattice {
  Vec3 min;
  double distance;
  std::array<std::int64_t, 3> count{1, 1, 1};

  explicit Lattice(const Scene& scene) : min(scene.domain.box.min), distance(point_distance(scene)) {
    const Vec3 extent = scene.domain.box.extent();
    for (int a = 0; a < scene.dimension; ++a)
      count[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(std::floor(extent[a] / distance + 1e-6));
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

/// Calls inside(place, x) for every lattice place whose point lies in `body` and in no earlier body.
template <class Visit>
void for_points_of(const Scene& scene, std::size_t body, const Visit& visit) {
  const Lattice lattice(scene);
  std::array<std::int64_t, 3> first{};
  std::array<std::int64_t, 3> last{};
  const Shape& shape = *scene.bodies[body].shape;
  clip(lattice, bounds(shape, scene.domain.box), scene.dimension, first, last);
  for (std::int64_t i = first[0]; i <= last[0]; ++i)
    for (std::int64_t j = first[1]; j <= last[1]; ++j)
      for (std::int64_t k = first[2]; k <= last[2]; ++k) {
        const std::int64_t index[3] = {i, j, k};
        const auto place = static_cast<std::uint64_t>((i * lattice.count[1] + j) * lattice.count[2] + k);
        Vec3 x = Vec3::Zero();
        for (int a = 0; a < scene.dimension; ++a)
          x[a] = lattice.min[a] + (static_cast<double>(index[a]) + 0.5) * lattice.distance;
        if (!(distance(shape, x) < 0)) continue;
        bool taken = false;
        for (std::size_t b = 0; b < body && !taken; ++b) taken = distance(*scene.bodies[b].shape, x) < 0;
        if (!taken) visit(place, x);
      }
}

/// Refuses a scene so fine that planning it would take minutes.
void check_size(const Scene& scene) {
  const Lattice lattice(scene);
  double places = 0;
  for (const Body& body : scene.bodies) {
    const Box3 box = bounds(*body.shape, scene.domain.box);
    double own = 1;
    for (int a = 0; a < scene.dimension; ++a) {
      const double lo = std::fmax(box.min[a], scene.domain.box.min[a]);
      const double hi = std::fmin(box.max[a], scene.domain.box.max[a]);
      own *= std::fmax(0.0, hi - lo) / lattice.distance + 1;
    }
    places += own;
  }
  if (places > kMostPlaces)
    throw InputError(
        {{"/spacing", std::to_string(scene.spacing), "at most 3e8 lattice places in the boxes of all bodies",
          "At this spacing the bodies' boxes hold " + std::to_string(places) +
              " places for points; raise \"spacing\", lower \"points_per_cell\" or use smaller bodies."}});
}

Vec3 jittered(const Scene& scene, std::uint64_t place, Vec3 x) {
  if (scene.jitter == 0) return x;
  const double d = point_distance(scene);
  for (int a = 0; a < scene.dimension; ++a)
    x[a] += scene.jitter * d * (random_unit(scene.seed, place, static_cast<std::uint64_t>(a)) - 0.5);
  return x;
}

std::uint32_t material_index(const Scene& scene, const Body& body) {
  std::uint32_t i = 0;
  while (scene.materials[i].name != body.material) ++i;
  return i;
}

Vec3 center_of(const Scene& scene, std::size_t body) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for_points_of(scene, body, [&](std::uint64_t, const Vec3& x) {
    sum += x;
    ++count;
  });
  if (count == 0)
    throw InputError(
        {{"/bodies/" + std::to_string(body) + "/shape", "", "at least one point",
          "No point of the lattice lies inside this body: it is outside the domain, hidden by earlier "
          "bodies, or thinner than the distance of points; move or enlarge it, or lower \"spacing\"."}});
  return sum / count;
}

}  // namespace

double point_distance(const Scene& scene) {
  return scene.spacing / std::round(std::pow(scene.points_per_cell, 1.0 / scene.dimension));
}

void seed_points(const Scene& scene, const std::function<void(const Seed&)>& visit) {
  check_size(scene);
  Seed seed;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    seed.material = material_index(scene, body);
    const Vec3 center = center_of(scene, b);
    const Vec3 spin = body.spin_deg * (std::numbers::pi / 180);
    Mat3 spin_matrix;
    spin_matrix << 0, -spin.z(), spin.y(), spin.z(), 0, -spin.x(), -spin.y(), spin.x(), 0;
    seed.velocity_gradient = body.velocity_gradient + spin_matrix;
    for_points_of(scene, b, [&](std::uint64_t place, const Vec3& x) {
      seed.position = jittered(scene, place, x);
      seed.velocity =
          body.velocity + body.velocity_gradient * seed.position + spin.cross(seed.position - center);
      visit(seed);
      ++seed.id;
    });
  }
}

std::vector<std::uint64_t> count_points(const Scene& scene) {
  check_size(scene);
  std::vector<std::uint64_t> count(scene.materials.size(), 0);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const std::uint32_t material = material_index(scene, scene.bodies[b]);
    std::uint64_t own = 0;
    for_points_of(scene, b, [&](std::uint64_t, const Vec3&) { ++own; });
    if (own == 0) (void)center_of(scene, b);  // throws with the reason
    count[material] += own;
  }
  return count;
}

}  // namespace lather
