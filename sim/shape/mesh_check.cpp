#include <algorithm>
#include <numeric>

#include "sim/math/vec.h"
#include "sim/shape/mesh_file.h"

namespace lather {
namespace {

constexpr const char* kAllowed = "a closed surface of triangles that face outward";

using Triangle = std::array<std::uint32_t, 3>;

/// For each position the least index that holds the same bits.
std::vector<std::uint32_t> equal_positions(const std::vector<std::array<float, 3>>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return positions[a] != positions[b] ? positions[a] < positions[b] : a < b;
  });
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] =
        i > 0 && positions[order[i]] == positions[order[i - 1]] ? first[order[i - 1]] : order[i];
  return first;
}

/// Without doubled and unused positions and without triangles that have collapsed.
MeshData welded(MeshData mesh) {
  const std::vector<std::uint32_t> first = equal_positions(mesh.positions);
  std::vector<std::uint32_t> place(mesh.positions.size(), 0xFFFFFFFF);
  MeshData out;
  out.face_word = mesh.face_word;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle corners = mesh.triangles[t];
    for (std::uint32_t& i : corners) i = first[i];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (std::uint32_t& i : corners) {
      if (place[i] == 0xFFFFFFFF) {
        place[i] = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(mesh.positions[i]);
      }
      i = place[i];
    }
    out.triangles.push_back(corners);
    out.face.push_back(mesh.face[t]);
  }
  return out;
}

struct Edge {
  std::uint32_t low, high;
  bool forward;  // from low to high, as its triangle runs
  std::uint32_t triangle;
};

/// All edges, the two sides of each next to each other.
std::vector<Edge> sorted_edges(const std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = triangles[t][c];
      const std::uint32_t b = triangles[t][(c + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b, t});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
    return x.low != y.low ? x.low < y.low : x.high != y.high ? x.high < y.high : x.triangle < y.triangle;
  });
  return edges;
}

class EdgeCheck {
 public:
  EdgeCheck(const MeshData& mesh, const std::string& file) : mesh_(mesh), file_(file) {}

  void run() const {
    const std::vector<Edge> edges = sorted_edges(mesh_.triangles);
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t end = i + 1;
      while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
      check(edges, i, end);
      i = end;
    }
  }

 private:
  [[nodiscard]] std::string place(const Edge& edge) const {
    const auto& p = mesh_.positions[edge.low];
    return mesh_.face_word + ' ' + std::to_string(mesh_.face[edge.triangle]) +
           " (an edge at x = " + std::to_string(p[0]) + ", y = " + std::to_string(p[1]) +
           ", z = " + std::to_string(p[2]) + ")";
  }
  [[noreturn]] void refuse(const Edge& edge, const std::string& what) const {
    throw MeshError(file_ + ", " + place(edge) + ": " + what, kAllowed);
  }

  void check(const std::vector<Edge>& edges, std::size_t first, std::size_t end) const {
    if (end - first == 1)
      refuse(edges[first],
             "the surface is not closed: nothing joins the face there. Fill the hole (in a modelling "
             "program: \"fill "
             "holes\", after merging vertices by distance).");
    if (end - first > 2)
      refuse(edges[first],
             "more than two faces meet in one edge, so inside and outside are not told apart. Take out "
             "faces inside the solid, or keep parts that touch from sharing vertices.");
    if (edges[first].forward == edges[first + 1].forward)
      refuse(edges[first],
             "neighbouring faces look to opposite sides. Make the normals consistent (\"recalculate "
             "outside\").");
  }

  const MeshData& mesh_;
  const std::string& file_;
};

}  // namespace

double enclosed_volume(const std::vector<std::array<float, 3>>& positions,
                       const std::vector<Triangle>& triangles) {
  if (positions.empty()) return 0;
  const auto at = [&](std::uint32_t i) { return Vec3(positions[i][0], positions[i][1], positions[i][2]); };
  // From a point of the mesh, so that a small mesh far from the origin keeps its digits.
  const Vec3 origin = at(0);
  double six = 0;
  for (const Triangle& t : triangles)
    six += (at(t[0]) - origin).dot((at(t[1]) - origin).cross(at(t[2]) - origin));
  return six / 6;
}

MeshData closed_surface(MeshData mesh, const std::string& file) {
  MeshData out = welded(std::move(mesh));
  if (out.triangles.empty())
    throw MeshError(file + " has no triangles. Export the mesh with its faces.", kAllowed);
  if (out.triangles.size() > kMaxMeshTriangles)
    throw MeshError(
        file + " has " + std::to_string(out.triangles.size()) + " triangles. Reduce them (\"decimate\").",
        "at most " + std::to_string(kMaxMeshTriangles) + " triangles");
  EdgeCheck(out, file).run();
  if (!(enclosed_volume(out.positions, out.triangles) > 0))
    throw MeshError(file + " is inside out: its faces look inward, or it is flat. Flip its normals.",
                    kAllowed);
  return out;
}

}  // namespace lather
