#include "sim/mpm/resample/point_values.h"

#include <algorithm>
#include <cmath>

namespace lather::mpm::resample {

PointValues::PointValues(const TileLayout& layout) {
  for (const Field f : {Field::kVelocity, Field::kVolumeChange, Field::kElasticStrain, Field::kAffine,
                        Field::kPlasticStrain, Field::kDeformation, Field::kPlasticity})
    if (layout.has(f))
      for (int c = 0; c < layout.components[static_cast<int>(f)]; ++c) rows_.push_back({f, c});
}

std::size_t PointValues::at(Field field) const {
  const auto row = std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.field == field; });
  return static_cast<std::size_t>(row - rows_.begin());
}

bool PointValues::has(Field field) const {
  return at(field) < rows_.size();
}

std::size_t PointValues::components(Field field) const {
  return static_cast<std::size_t>(
      std::count_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.field == field; }));
}

void PointValues::renormalize(double* values) const {
  renormalize_strain(values);
  if (has(Field::kDeformation)) renormalize_deformation(values);
}

void PointValues::renormalize_deformation(double* values) const {
  double* g = values + at(Field::kDeformation);  // G = F - I, row by row; xx xy yx yy zz in 2D
  const int d = components(Field::kDeformation) == 9 ? 3 : 2;
  Mat3 F = Mat3::Identity();
  for (int i = 0; i < d * d; ++i) F(i / d, i % d) += g[i];
  if (d == 2) F(2, 2) += g[4];
  const double J = 1 + values[at(Field::kVolumeChange)];
  const double more = std::cbrt(J / F.determinant()) - 1;
  for (int i = 0; i < d * d; ++i) g[i] += more * F(i / d, i % d);
  if (d == 2) g[4] += more * F(2, 2);
}

void PointValues::renormalize_strain(double* values) const {
  double* b = values + at(Field::kElasticStrain);  // B = be - I: xx yy zz xy (xz yz)
  const bool space = components(Field::kElasticStrain) == 6;
  const double xz = space ? b[4] : 0;
  const double yz = space ? b[5] : 0;
  const double minors = b[0] * b[1] - b[3] * b[3] + b[0] * b[2] - xz * xz + b[1] * b[2] - yz * yz;
  const double det =
      b[0] * (b[1] * b[2] - yz * yz) - b[3] * (b[3] * b[2] - yz * xz) + xz * (b[3] * yz - b[1] * xz);
  // s (I + B) - I with s = det(I + B)^(-1/3), without forming the sums with I.
  const double more = std::expm1(-std::log1p(b[0] + b[1] + b[2] + minors + det) / 3);
  for (std::size_t c = 0; c < components(Field::kElasticStrain); ++c)
    b[c] += more * b[c] + (c < 3 ? more : 0);
}

}  // namespace lather::mpm::resample
