#include "tests/unit/sim/mlsrk/arrangement.h"

#include <cmath>
#include <random>

namespace lather::testing_support {
namespace {

double spline(double s) {
  s = std::abs(s);
  return s < 1 ? 0.5 * s * s * s - s * s + 2.0 / 3 : s < 2 ? std::pow(2 - s, 3) / 6 : 0;  // [MLSRK eq. 7]
}
double spline_slope(double s) {
  const double r = std::abs(s);
  const double slope = r < 1 ? 1.5 * r * r - 2 * r : r < 2 ? -0.5 * (2 - r) * (2 - r) : 0;
  return s < 0 ? -slope : slope;
}

std::vector<double> basis(const Vec3& x, int dimension, int order) {
  std::vector<double> h = {1};
  if (order >= 1)
    for (int a = 0; a < dimension; ++a) h.push_back(x[a]);
  if (order >= 2) {
    for (int a = 0; a < dimension; ++a) h.push_back(x[a] * x[a]);
    h.push_back(x.x() * x.y());
    if (dimension == 3) h.push_back(x.y() * x.z()), h.push_back(x.z() * x.x());
  }
  return h;
}

/// Of a component of a point's velocity in what the kernels take.
std::size_t velocity_at(std::size_t point, int row) {
  return (point / kTile * mlsrk::kVelocityRows + static_cast<std::size_t>(row)) * kTile + point % kTile;
}

}  // namespace

template <class Real>
void Arrangement<Real>::add(const Vec3& x, double volume) {
  points_.push_back(x);
  volumes_.push_back(volume);
  cloud_.add(x, volume);
}

template <class Real>
void Arrangement<Real>::fill(int n, double d, double jitter, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter * d, jitter * d);
  const int last = dimension_ == 3 ? n : 0;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k <= last; ++k) {
        Vec3 x(i * d, j * d, k * d);
        for (int a = 0; a < dimension_; ++a) x[a] += shift(random);
        add(x, std::pow(d, dimension_));
      }
}

template <class Real>
void Arrangement<Real>::compute(const mlsrk::ShapeConstants<Real>& constants) {
  constants_ = constants;
  const std::size_t slots = cloud_.tiles() * kTile;
  shape_.assign(slots * static_cast<std::size_t>(kernels_.shape_reals), Real(0));
  crowding_.assign(slots, Real(0));
  fallen_.assign(slots, Real(0));
  for (std::size_t t = 0; t < cloud_.tiles(); ++t)
    kernels_.shape_functions(constants, cloud_.around(t),
                             shape_.data() + t * kTile * static_cast<std::size_t>(kernels_.shape_reals),
                             crowding_.data() + t * kTile, fallen_.data() + t * kTile);
}

template <class Real>
typename Arrangement<Real>::Function Arrangement<Real>::shape_function(std::size_t j, std::size_t i,
                                                                       int order, bool radial) const {
  const Vec3 xi = points_[j] - points_[i];
  const std::vector<double> h = basis(xi, dimension_, order);
  double phi = 1;
  Vec3 slope = Vec3::Zero();
  if (radial) {
    const double r = xi.norm();
    phi = spline(r);
    if (r > 0) slope = spline_slope(r) / r * xi;
  } else {
    for (int a = 0; a < dimension_; ++a) phi *= spline(xi[a]);
    for (int a = 0; a < dimension_; ++a) {
      slope[a] = spline_slope(xi[a]);
      for (int b = 0; b < dimension_; ++b)
        if (b != a) slope[a] *= spline(xi[b]);
    }
  }
  const Real* row = shape_.data() + i * static_cast<std::size_t>(kernels_.shape_reals);
  const auto dot = [&](const Real* w) {
    double sum = 0;
    for (std::size_t k = 0; k < h.size(); ++k) sum += static_cast<double>(w[k]) * h[k];
    return sum;
  };
  const double volume = volumes_[j];
  Function f{dot(row) * phi * volume, Vec3::Zero()};
  for (int a = 0; a < dimension_; ++a)
    f.gradient[a] =
        (dot(row + h.size() * static_cast<std::size_t>(1 + a)) * phi - dot(row) * slope[a]) * volume;
  return f;
}

template <class Real>
void Arrangement<Real>::differentiate(const std::vector<Vec3>& u, std::vector<Mat3>& gradient,
                                      std::vector<Vec3>& smooth) {
  std::vector<Real> velocity(cloud_.tiles() * kTile * mlsrk::kVelocityRows, Real(0));
  for (std::size_t i = 0; i < size(); ++i)
    for (int a = 0; a < 3; ++a) velocity[velocity_at(i, a)] = static_cast<Real>(u[i][a]);
  gradient.assign(size(), Mat3::Zero());
  smooth.assign(size(), Vec3::Zero());
  const std::size_t reals = kTile * static_cast<std::size_t>(kernels_.shape_reals);
  for (std::size_t t = 0; t < cloud_.tiles(); ++t) {
    Real L[9 * kTile];
    Real du[3 * kTile];
    kernels_.gradients(constants_, Real(1), cloud_.around(t), shape_.data() + t * reals, velocity.data(), L,
                       du);
    for (std::size_t i = 0; i < kTile && t * kTile + i < size(); ++i)
      for (int a = 0; a < dimension_; ++a) {
        smooth[t * kTile + i][a] = static_cast<double>(du[static_cast<std::size_t>(a) * kTile + i]);
        for (int b = 0; b < dimension_; ++b)
          gradient[t * kTile + i](a, b) =
              static_cast<double>(L[static_cast<std::size_t>(a * dimension_ + b) * kTile + i]);
      }
  }
}

template <class Real>
std::vector<Vec3> Arrangement<Real>::accelerate(const std::vector<std::array<double, 6>>& stress,
                                                const std::vector<double>& mass, double dt, bool own_mass) {
  const std::size_t slots = cloud_.tiles() * kTile;
  std::vector<Real> rows(slots * mlsrk::kStressReals, Real(0));
  std::vector<Real> velocity(slots * mlsrk::kVelocityRows, Real(0));
  for (std::size_t i = 0; i < size(); ++i) {
    for (std::size_t c = 0; c < 6; ++c) rows[i * mlsrk::kStressReals + c] = static_cast<Real>(stress[i][c]);
    rows[i * mlsrk::kStressReals + 7] = static_cast<Real>(mass[i]);
    velocity[velocity_at(i, 3)] = static_cast<Real>(mass[i]);
  }
  const mlsrk::MomentumStep<Real> step = {
      static_cast<Real>(dt), {Real(0), Real(0), Real(0)}, Real(1), own_mass};
  for (std::size_t t = 0; t < cloud_.tiles(); ++t) {
    Real lumped[kTile];
    kernels_.momentum(step, cloud_.around(t), shape_.data(), rows.data(),
                      velocity.data() + t * kTile * mlsrk::kVelocityRows, lumped);
  }
  std::vector<Vec3> out(size(), Vec3::Zero());
  for (std::size_t i = 0; i < size(); ++i)
    for (int a = 0; a < dimension_; ++a) out[i][a] = static_cast<double>(velocity[velocity_at(i, a)]);
  return out;
}

template class Arrangement<float>;
template class Arrangement<double>;

}  // namespace lather::testing_support
