#include "sim/shape/mesh_builder.h"

#include <algorithm>
#include <cmath>

namespace lather::tessellation {
namespace {

constexpr int kMaxSegments = 512;

std::array<float, 3> single(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

std::uint32_t MeshBuilder::add(const Vec3& position, const Vec3& normal) {
  mesh_.positions.push_back(single(position));
  mesh_.normals.push_back(single(normal));
  return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const auto& p = mesh_.positions;
  if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
  mesh_.triangles.push_back({a, b, c});
}

void MeshBuilder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

TriangleMesh lathe(const std::vector<ProfileStrip>& strips, double detail) {
  double widest = 0;
  for (const ProfileStrip& strip : strips) {
    for (const ProfilePoint& p : strip) widest = std::max(widest, p.position.x());
  }
  const int around = std::clamp(static_cast<int>(std::ceil(2 * M_PI * widest / detail)), 12, kMaxSegments);
  MeshBuilder mesh;
  for (const ProfileStrip& strip : strips) {
    std::uint32_t first = 0;
    for (std::size_t j = 0; j < strip.size(); ++j) {
      for (int i = 0; i < around; ++i) {
        const double angle = 2 * M_PI * i / around;
        const double c = std::cos(angle), s = std::sin(angle);
        const ProfilePoint& p = strip[j];
        const std::uint32_t index = mesh.add({p.position.x() * c, p.position.y(), p.position.x() * s},
                                             {p.normal.x() * c, p.normal.y(), p.normal.x() * s});
        if (i == 0 && j == 0) first = index;
      }
    }
    const auto ring = static_cast<std::uint32_t>(around);
    for (std::uint32_t j = 0; j + 1 < strip.size(); ++j) {
      for (std::uint32_t i = 0; i < ring; ++i) {
        const std::uint32_t next = (i + 1) % ring;
        const std::uint32_t lower = first + j * ring, upper = lower + ring;
        mesh.quad(lower + i, upper + i, upper + next, lower + next);
      }
    }
  }
  return mesh.take();
}

// Each face of the box is a grid over directions in a 45-degree cone; a corner's part of the grid lies on the
// sphere about that corner of the core box. Faces meet bit for bit because a direction is built alike from
// either side.
TriangleMesh rounded_box(const BoxShape& box, double detail) {
  const Vec3 core = 0.5 * box.size - Vec3::Constant(box.rounding);
  const int per_arc =
      box.rounding > 0 ? std::clamp(static_cast<int>(std::ceil(0.25 * M_PI * box.rounding / detail)), 4, 64)
                       : 0;
  std::vector<std::pair<double, double>> stops;  // slope in [-1, 1] and the side of the core it belongs to
  for (int i = 0; i <= per_arc; ++i) {
    stops.emplace_back(-std::tan(0.25 * M_PI * (per_arc - i) / std::max(per_arc, 1)), -1.0);
  }
  for (int i = 0; i <= per_arc; ++i)
    stops.emplace_back(std::tan(0.25 * M_PI * i / std::max(per_arc, 1)), 1.0);
  if (per_arc > 0) {
    stops.front().first = -1;
    stops.back().first = 1;
  }

  MeshBuilder mesh;
  const auto n = static_cast<std::uint32_t>(stops.size());
  for (int face = 0; face < 6; ++face) {
    const int w = face / 2, u = (w + 1) % 3, v = (w + 2) % 3;
    const double side = face % 2 == 0 ? 1 : -1;
    std::uint32_t first = 0;
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        Vec3 direction, corner;
        direction[w] = side;
        direction[u] = stops[i].first;
        direction[v] = stops[j].first;
        corner[w] = side * core[w];
        corner[u] = stops[i].second * core[u];
        corner[v] = stops[j].second * core[v];
        direction.normalize();
        const std::uint32_t index = mesh.add(corner + box.rounding * direction, direction);
        if (i == 0 && j == 0) first = index;
      }
    }
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
      for (std::uint32_t i = 0; i + 1 < n; ++i) {
        const std::uint32_t a = first + j * n + i, b = a + 1, c = b + n, d = a + n;
        if (side > 0) {
          mesh.quad(a, b, c, d);
        } else {
          mesh.quad(a, d, c, b);
        }
      }
    }
  }
  return mesh.take();
}

TriangleMesh plane_polygon(const Vec3& point, const Vec3& normal, const Box3& world) {
  const Vec3 n = normal.normalized();
  const Vec3 a = n.unitOrthogonal(), b = n.cross(a);
  const double reach = world.extent().norm() + (world.center() - point).norm();
  const Vec3 middle = world.center() - n * n.dot(world.center() - point);
  std::vector<Vec3> polygon = {middle + reach * (a + b), middle + reach * (b - a), middle - reach * (a + b),
                               middle + reach * (a - b)};
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1 : -1;
    const double limit = sign > 0 ? world.max[axis] : -world.min[axis];
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3& p = polygon[i];
      const Vec3& q = polygon[(i + 1) % polygon.size()];
      const double over_p = sign * p[axis] - limit, over_q = sign * q[axis] - limit;
      if (over_p <= 0) kept.push_back(p);
      if ((over_p < 0 && over_q > 0) || (over_p > 0 && over_q < 0)) {
        kept.push_back(p + (q - p) * (over_p / (over_p - over_q)));
      }
    }
    polygon = std::move(kept);
  }
  MeshBuilder mesh;
  for (const Vec3& p : polygon) mesh.add(p, n);
  for (std::uint32_t i = 1; i + 1 < polygon.size(); ++i) mesh.triangle(0, i, i + 1);
  return mesh.take();
}

}  // namespace lather::tessellation
