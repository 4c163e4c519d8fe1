#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/math/vec.h"
#include "sim/mlsrk/levels.h"
#include "sim/mlsrk/loose_cloud.h"

namespace lather::testing_support {

/// Points put by hand for the kernels of one level. Lengths over the kernel's scale a.
template <class Real>
class Arrangement {
 public:
  Arrangement(int dimension, const mlsrk::Kernels<Real>& kernels)
      : dimension_(dimension), kernels_(kernels) {}

  void add(const Vec3& x, double volume);
  /// A lattice of distance d in [0, n d]^dim, each point moved by up to `jitter` d along each axis.
  void fill(int n, double d, double jitter, unsigned seed);

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] Vec3 x(std::size_t i) const { return points_[i]; }

  /// The shape functions.
  void compute(const mlsrk::ShapeConstants<Real>& constants);

  /// N_j(x_i) and a grad N_j(x_i), from the rows that compute() made and the equations at the head of
  /// sim/mlsrk/kernels.h, in double precision.
  struct Function {
    double value;
    Vec3 gradient;
  };
  [[nodiscard]] Function shape_function(std::size_t j, std::size_t i, int order, bool radial) const;

  [[nodiscard]] double crowding(std::size_t i) const { return static_cast<double>(crowding_[i]); }
  [[nodiscard]] bool fallen(std::size_t i) const { return fallen_[i] != Real(0); }
  [[nodiscard]] const std::vector<Real>& shape() const { return shape_; }

  /// Velocity gradients (1/s, a = 1 m) and u^h - u of velocities u_i, one tile after the other.
  void differentiate(const std::vector<Vec3>& u, std::vector<Mat3>& gradient, std::vector<Vec3>& smooth);
  /// Velocities after a step of `dt` under stresses V sigma (xx yy zz xy xz yz), from rest, without gravity.
  [[nodiscard]] std::vector<Vec3> accelerate(const std::vector<std::array<double, 6>>& stress,
                                             const std::vector<double>& mass, double dt, bool own_mass);

 private:
  int dimension_;
  const mlsrk::Kernels<Real>& kernels_;
  mlsrk::ShapeConstants<Real> constants_{};
  std::vector<Vec3> points_;
  std::vector<double> volumes_;
  mlsrk::LooseCloud<Real> cloud_;
  std::vector<Real> shape_;
  std::vector<Real> crowding_;
  std::vector<Real> fallen_;
};

}  // namespace lather::testing_support
