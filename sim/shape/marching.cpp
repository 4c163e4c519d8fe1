#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "sim/shape/mesh_builder.h"
#include "sim/shape/primitives.h"
#include "sim/shape/unbounded.h"

/// Marching tetrahedra: a cell is cut into six tetrahedra around its diagonal, so neighbours agree on their
/// faces and the mesh is closed. Points are shared by the grid edge on which they lie.
namespace lather::tessellation {
namespace {

constexpr double kMaxNodes = 4e6;
constexpr double kMargin = 4;  // nodes beyond the shape's extent along each axis

/// Corner k of a cell is at (k & 1, k >> 1 & 1, k >> 2); each tetrahedron walks from corner 0 to corner 7
/// along the axes.
constexpr std::array<std::array<int, 4>, 6> kTetrahedra = {
    {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}}};

class Marcher {
 public:
  Marcher(const Shape& shape, const Box3& world, double detail)
      : shape_(shape), clip_(is_unbounded(shape)), world_(world) {
    Box3 box = bounds(shape, world);
    width_ = widest_detail(box.extent(), detail);
    origin_ =
        box.min - Vec3::Constant(1.37 * width_);  // off the lattice, so that flat faces do not hit nodes
    for (int i = 0; i < 3; ++i) {
      nodes_[static_cast<std::size_t>(i)] =
          static_cast<std::int64_t>(std::ceil(box.extent()[i] / width_) + kMargin);
    }
  }

  /// `detail`, or as much more as it takes for few enough nodes: long thin shapes have most of theirs in the
  /// margin.
  static double widest_detail(const Vec3& extent, double detail) {
    double width = detail;
    while (((extent / width).array().ceil() + kMargin).prod() > kMaxNodes) width *= 1.1;
    return width;
  }

  TriangleMesh run() {
    sample_nodes();
    for (std::int64_t k = 0; k + 1 < nodes_[2]; ++k) {
      for (std::int64_t j = 0; j + 1 < nodes_[1]; ++j) {
        for (std::int64_t i = 0; i + 1 < nodes_[0]; ++i) march_cell(i, j, k);
      }
    }
    return mesh_.take();
  }

 private:
  [[nodiscard]] double value(const Vec3& x) const {
    const double d = distance(shape_, x);
    if (!clip_) return d;
    return std::max(d, primitive::distance(BoxShape{world_.extent(), 0}, x - world_.center()));
  }

  [[nodiscard]] std::int64_t node(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return (k * nodes_[1] + j) * nodes_[0] + i;
  }

  [[nodiscard]] Vec3 position(std::int64_t n) const {
    const std::int64_t i = n % nodes_[0], j = n / nodes_[0] % nodes_[1], k = n / nodes_[0] / nodes_[1];
    return origin_ + width_ * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
  }

  void sample_nodes() {
    const std::int64_t count = nodes_[0] * nodes_[1] * nodes_[2];
    values_.resize(static_cast<std::size_t>(count));
    for (std::int64_t n = 0; n < count; ++n) values_[static_cast<std::size_t>(n)] = value(position(n));
  }

  void march_cell(std::int64_t i, std::int64_t j, std::int64_t k) {
    std::array<std::int64_t, 8> corner;
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      const std::int64_t n = node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
      corner[static_cast<std::size_t>(c)] = n;
      if (is_inside(n)) ++inside;
    }
    if (inside == 0 || inside == 8) return;
    for (const auto& t : kTetrahedra) {
      std::array<std::int64_t, 4> tetrahedron;
      for (std::size_t v = 0; v < 4; ++v) tetrahedron[v] = corner[static_cast<std::size_t>(t[v])];
      march_tetrahedron(tetrahedron);
    }
  }

  [[nodiscard]] bool is_inside(std::int64_t n) const { return values_[static_cast<std::size_t>(n)] < 0; }

  /// Sorts inside corners before outside ones by swaps; an odd number of swaps mirrors the tetrahedron.
  void march_tetrahedron(std::array<std::int64_t, 4> t) {
    bool mirrored = false;
    int inside = 0;
    for (std::size_t v = 0; v < 4; ++v) {
      if (!is_inside(t[v])) continue;
      const auto to = static_cast<std::size_t>(inside++);
      if (to == v) continue;
      std::swap(t[to], t[v]);
      mirrored = !mirrored;
    }
    if (inside == 1) {
      face(mirrored, cut(t[0], t[1]), cut(t[0], t[2]), cut(t[0], t[3]));
    } else if (inside == 2) {
      const std::uint32_t a = cut(t[0], t[2]), b = cut(t[0], t[3]), c = cut(t[1], t[3]), d = cut(t[1], t[2]);
      face(mirrored, a, b, c);
      face(mirrored, a, c, d);
    } else if (inside == 3) {
      face(mirrored, cut(t[0], t[3]), cut(t[1], t[3]), cut(t[2], t[3]));
    }
  }

  void face(bool mirrored, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mirrored ? mesh_.triangle(a, c, b) : mesh_.triangle(a, b, c);
  }

  /// The point where the surface crosses the grid edge, found by bisection between its inside and outside
  /// end.
  std::uint32_t cut(std::int64_t in, std::int64_t out) {
    const auto nodes = static_cast<std::uint64_t>(values_.size());
    const std::uint64_t key = static_cast<std::uint64_t>(in) * nodes + static_cast<std::uint64_t>(out);
    const auto found = points_.find(key);
    if (found != points_.end()) return found->second;
    Vec3 a = position(in), b = position(out);
    for (int step = 0; step < 16; ++step) {
      const Vec3 middle = 0.5 * (a + b);
      (value(middle) < 0 ? a : b) = middle;
    }
    const Vec3 point = 0.5 * (a + b);
    const std::uint32_t index = mesh_.add(point, surface_normal(point));
    points_.emplace(key, index);
    return index;
  }

  [[nodiscard]] Vec3 surface_normal(const Vec3& x) const {
    const double h = 1e-3 * width_;
    Vec3 gradient;
    for (int i = 0; i < 3; ++i) gradient[i] = value(x + h * Vec3::Unit(i)) - value(x - h * Vec3::Unit(i));
    const double length = gradient.norm();
    return length > 1e-6 * h ? Vec3(gradient / length) : Vec3(Vec3::UnitY());
  }

  const Shape& shape_;
  bool clip_;
  Box3 world_;
  double width_ = 0;
  Vec3 origin_ = Vec3::Zero();
  std::array<std::int64_t, 3> nodes_{};
  std::vector<double> values_;
  std::unordered_map<std::uint64_t, std::uint32_t> points_;
  MeshBuilder mesh_;
};

}  // namespace

TriangleMesh from_distance(const Shape& shape, const Box3& world, double detail) {
  return Marcher(shape, world, detail).run();
}

}  // namespace lather::tessellation
