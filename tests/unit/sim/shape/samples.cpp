#include "tests/unit/sim/shape/samples.h"

namespace lather::test {

ShapePtr make(decltype(Shape::kind) kind) {
  return std::make_shared<const Shape>(Shape{std::move(kind)});
}

ShapePtr place(ShapePtr shape, const Vec3& translate, const Vec3& rotate_deg, double scale) {
  return make(PlacedShape(std::move(shape), translate, rotate_deg, scale));
}

std::vector<Sample> samples() {
  const ShapePtr sphere = make(SphereShape{0.6});
  const ShapePtr box = make(BoxShape{{1.2, 0.8, 1.0}, 0});
  const double frustum = M_PI * 1.2 / 3 * (0.49 + 0.7 * 0.3 + 0.09);
  const double lens = 0.2;  // height of each cap of the intersection below
  const double cap = M_PI * lens * lens * (3 * 0.6 - lens) / 3;
  const RevolutionShape bottle{{{0, -0.8}, {0.5, -0.8}, {0.5, 0.1}, {0.2, 0.4}, {0.2, 0.8}, {0, 0.8}}};
  const RevolutionShape washer{{{0.4, 0.2}, {0.4, -0.2}, {0.9, -0.2}, {0.9, 0.2}}};
  std::vector<Sample> all = {
      {"sphere", sphere, 4.0 / 3 * M_PI * 0.216},
      {"box", box, 1.2 * 0.8 * 1.0},
      {"cylinder", make(CylinderShape{0.5, 1.4, 0}), M_PI * 0.25 * 1.4},
      {"capsule", make(CapsuleShape{0.4, 0.9}), M_PI * 0.16 * 0.9 + 4.0 / 3 * M_PI * 0.064},
      {"capsule of no height", make(CapsuleShape{0.4, 0}), 4.0 / 3 * M_PI * 0.064},
      {"cone", make(ConeShape{0.7, 0, 1.2}), M_PI * 0.49 * 1.2 / 3},
      {"frustum", make(ConeShape{0.7, 0.3, 1.2}), frustum},
      {"frustum on its head", make(ConeShape{0.3, 0.7, 1.2}), frustum},
      {"torus", make(TorusShape{0.8, 0.25}), 2 * M_PI * M_PI * 0.8 * 0.0625},
      {"ellipsoid", make(EllipsoidShape{{0.9, 0.3, 0.6}}), 4.0 / 3 * M_PI * 0.9 * 0.3 * 0.6},
      {"flat ellipsoid", make(EllipsoidShape{{1.1, 0.05, 1.1}}), 4.0 / 3 * M_PI * 1.1 * 0.05 * 1.1},
      {"bottle", make(bottle), M_PI * (0.25 * 0.9 + 0.3 / 3 * (0.25 + 0.1 + 0.04) + 0.04 * 0.4)},
      {"washer", make(washer), M_PI * (0.81 - 0.16) * 0.4},
      {"placed box", place(box, {0.3, -0.2, 0.1}, {30, -50, 110}, 0.7), 0.96 * 0.343},
  };
  // Rounded: the core, slabs on its faces, quarter cylinders on its edges, a sphere at its corners.
  const double r = 0.15;
  const Vec3 core(0.9, 0.5, 0.7);
  const double slabs = 2 * r * (core.x() * core.y() + core.y() * core.z() + core.z() * core.x());
  all.push_back({"rounded box", make(BoxShape{{1.2, 0.8, 1.0}, r}),
                 core.prod() + slabs + M_PI * r * r * core.sum() + 4.0 / 3 * M_PI * r * r * r});
  // By Pappus: the half rim's area is pi r^2 / 2 and its centroid lies 4 r / (3 pi) outside the core.
  const double a = 0.5 - r, h = 1.4;
  all.push_back({"rounded cylinder", make(CylinderShape{0.5, h, r}),
                 M_PI * a * a * h + 2 * M_PI * (a + r / 2) * r * (h - 2 * r) +
                     2 * M_PI * (a + 4 * r / (3 * M_PI)) * M_PI * r * r / 2});
  all.push_back({"plane", make(PlaneShape{{1, 2, -0.5}}), 0, true, false});
  all.push_back(
      {"union", make(UnionShape{{sphere, place(sphere, {1.3, 0, 0})}, 0}), 8.0 / 3 * M_PI * 0.216, false});
  all.push_back({"smooth union",
                 make(UnionShape{{sphere, place(box, {0.5, 0.5, 0}), place(sphere, {0, -1, 0})}, 0.3}), 0,
                 false});
  all.push_back(
      {"intersection", make(IntersectionShape{{sphere, place(sphere, {0.8, 0, 0})}}), 2 * cap, false});
  all.push_back({"difference", make(DifferenceShape{{sphere, place(sphere, {0.8, 0, 0})}}),
                 4.0 / 3 * M_PI * 0.216 - 2 * cap, false});
  return all;
}

Vec3 random_point(std::mt19937_64& random, const Box3& box) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 u(unit(random), unit(random), unit(random));
  return box.min + u.cwiseProduct(box.extent());
}

}  // namespace lather::test
