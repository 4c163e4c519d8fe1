#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "sim/shape/shape.h"

namespace lather::test {

/// One shape of every kind, with what is known about it.
struct Sample {
  std::string name;
  ShapePtr shape;
  double volume = 0;  ///< m^3, closed form; 0 where there is none
  bool exact = true;  ///< distance() is the distance, not only a bound
  bool has_closed_mesh = true;
};

ShapePtr make(decltype(Shape::kind) kind);
ShapePtr place(ShapePtr shape, const Vec3& translate, const Vec3& rotate_deg = Vec3::Zero(),
               double scale = 1);
std::vector<Sample> samples();

/// The world of these tests: a box that holds every bounded sample.
inline const Box3 kWorld{Vec3::Constant(-2), Vec3::Constant(2)};

/// A point evenly spread over the box.
Vec3 random_point(std::mt19937_64& random, const Box3& box);

}  // namespace lather::test
