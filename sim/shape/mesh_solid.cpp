#include "sim/shape/mesh_solid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lather {
namespace {

const double kSharp = std::cos(40 * M_PI / 180);

Vec3 as_vec(const std::array<float, 3>& p) {
  return {p[0], p[1], p[2]};
}

/// Normals of the triangles, as long as twice their areas.
std::vector<Vec3> area_normals(const MeshData& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 a = as_vec(mesh.positions[t[0]]);
    normals.push_back((as_vec(mesh.positions[t[1]]) - a).cross(as_vec(mesh.positions[t[2]]) - a));
  }
  return normals;
}

/// For each position the triangles around it: those of position i stand from first[i] to first[i + 1].
struct Around {
  std::vector<std::uint32_t> first, triangles;
};

Around triangles_around(const MeshData& mesh) {
  Around around;
  around.first.assign(mesh.positions.size() + 1, 0);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t i : t) ++around.first[i + 1];
  for (std::size_t i = 1; i < around.first.size(); ++i) around.first[i] += around.first[i - 1];
  std::vector<std::uint32_t> next(around.first.begin(), around.first.end() - 1);
  around.triangles.resize(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t i : mesh.triangles[t]) around.triangles[next[i]++] = t;
  return around;
}

}  // namespace

MeshSolid::MeshSolid(std::string_view bytes, const std::string& file, int resolution)
    : mesh_(closed_surface(read_mesh(bytes, file), file)) {
  bounds_ = {as_vec(mesh_.positions[0]), as_vec(mesh_.positions[0])};
  for (const auto& p : mesh_.positions) bounds_.include(as_vec(p));
  grid_ = sample_distance(mesh_, resolution);
}

double MeshSolid::distance(const Vec3& x) const {
  const Vec3 at = (x - grid_.origin) / grid_.cell;
  std::array<int, 3> node{};
  std::array<double, 3> part{};
  double beyond = 0;  // squared distance from the mesh's box, m^2
  bool outside = false;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double last = grid_.nodes[a] - 1;
    outside = outside || !(at[axis] >= 0) || !(at[axis] < last);
    const double clamped = std::clamp(at[axis], 0.0, last - 1e-9);
    node[a] = static_cast<int>(clamped);
    part[a] = clamped - node[a];
    const double out = std::max({bounds_.min[axis] - x[axis], x[axis] - bounds_.max[axis], 0.0});
    beyond += out * out;
  }
  if (outside) return std::sqrt(beyond);
  const auto stride_y = static_cast<std::size_t>(grid_.nodes[0]);
  const std::size_t stride_z = stride_y * static_cast<std::size_t>(grid_.nodes[1]);
  const float* const corner = grid_.values.data() + static_cast<std::size_t>(node[2]) * stride_z +
                              static_cast<std::size_t>(node[1]) * stride_y +
                              static_cast<std::size_t>(node[0]);
  double sum = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const bool up_x = (i & 1U) != 0, up_y = (i & 2U) != 0, up_z = (i & 4U) != 0;
    const double weight =
        (up_x ? part[0] : 1 - part[0]) * (up_y ? part[1] : 1 - part[1]) * (up_z ? part[2] : 1 - part[2]);
    sum +=
        weight * static_cast<double>(corner[(up_x ? 1 : 0) + (up_y ? stride_y : 0) + (up_z ? stride_z : 0)]);
  }
  return beyond > 0 ? std::max(sum, std::sqrt(beyond)) : sum;
}

// Each corner of a triangle takes the normals of all triangles around its position that are not turned away
// from its own by a sharp edge; corners of one position with the same normal share a point.
TriangleMesh MeshSolid::surface() const {
  const std::vector<Vec3> areas = area_normals(mesh_);
  const Around around = triangles_around(mesh_);
  std::map<std::pair<std::uint32_t, std::array<float, 3>>, std::uint32_t> points;
  TriangleMesh out;
  out.triangles.reserve(mesh_.triangles.size());
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const Vec3 own = areas[t].norm() > 0 ? Vec3(areas[t].normalized()) : Vec3::UnitY();
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t position = mesh_.triangles[t][c];
      Vec3 sum = Vec3::Zero();
      for (std::uint32_t n = around.first[position]; n < around.first[position + 1]; ++n) {
        const Vec3& other = areas[around.triangles[n]];
        if (other.dot(own) >= kSharp * other.norm()) sum += other;
      }
      const Vec3 normal = sum.norm() > 0 ? Vec3(sum.normalized()) : own;
      const std::array<float, 3> single = {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                                           static_cast<float>(normal.z())};
      const auto [at, added] =
          points.try_emplace({position, single}, static_cast<std::uint32_t>(out.positions.size()));
      if (added) {
        out.positions.push_back(mesh_.positions[position]);
        out.normals.push_back(single);
      }
      triangle[c] = at->second;
    }
    out.triangles.push_back(triangle);
  }
  return out;
}

}  // namespace lather
