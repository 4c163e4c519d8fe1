#include "sim/mpm/resample/subgrid_removal.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "sim/math/parallel.h"

namespace lather::mpm::resample {
namespace {

/// The kernel at a distance of d cells along one axis.
double kernel_at(const KernelWeights& weights, double d) {
  double weight[4];
  const double below = std::floor(d);
  const int node = -static_cast<int>(below) - weights(d - below, weight);
  return node >= 0 && node < 4 ? weight[node] : 0;
}

/// Sums over points at x relative to the weak one, r.
struct Moments {
  double sum = 0;  // of w m
  Vec3 first = Vec3::Zero();
  double sum_squares = 0;  // of (w m)^2
  Vec3 first_squares = Vec3::Zero();
  Mat3 second_squares = Mat3::Zero();

  void add(double w, const Vec3& x) {
    sum += w;
    first += w * x;
    sum_squares += w * w;
    first_squares += w * w * x;
    second_squares += w * w * x * x.transpose();
  }
  /// V_p [Foam eq. 22], r^2.
  [[nodiscard]] Mat3 covariance() const {
    const Vec3 mean = first / sum;  // [Foam eq. 21]
    const Vec3 mean_squares = first_squares / sum_squares;
    return second_squares / sum_squares - mean * mean_squares.transpose() - mean_squares * mean.transpose() +
           mean * mean.transpose();
  }
  /// Sum of (w m)^2 (x - c)(x - c)^T about the c that makes it least.
  [[nodiscard]] Mat3 scatter() const {
    return second_squares - first_squares * first_squares.transpose() / sum_squares;
  }
};

/// Least and largest eigenvalue of the matrix's first `dimension` rows and columns.
std::array<double, 2> extreme_eigenvalues(const Mat3& m, int dimension) {
  if (dimension == 2) {
    const auto e =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(m.topLeftCorner<2, 2>(), Eigen::EigenvaluesOnly)
            .eigenvalues();
    return {e[0], e[1]};
  }
  const auto e = Eigen::SelfAdjointEigenSolver<Mat3>(m, Eigen::EigenvaluesOnly).eigenvalues();
  return {e[0], e[2]};
}

template <class Real>
class Finder {
 public:
  Finder(const PointBins& bins, const std::vector<ParticleSet<Real>>& sets, const SubgridSearch& search)
      : bins_(bins),
        sets_(sets),
        search_(search),
        cells_per_r_(static_cast<double>(kBlockWidth) / bins.lattice().width),
        reach_(search.reach / cells_per_r_) {
    double heaviest = 0;
    for (std::uint32_t p = 0; p < bins.size(); ++p) heaviest = std::max(heaviest, mass_of(p));
    largest_weight_ = heaviest * std::pow(kernel_at(search.weights, 0), bins.lattice().dimension);
  }

  [[nodiscard]] bool is_weak(std::uint32_t p) const {
    const BinnedPoint& point = bins_.point(p);
    const double threshold = search_.tear_threshold[point.set];
    return std::isfinite(threshold) && static_cast<double>(sets_[point.set].template values<Real>(
                                           point.slot.tile, Field::kPlasticity)[point.slot.lane]) > threshold;
  }

  /// Point p of block b.
  [[nodiscard]] bool is_unresolved(std::size_t b, std::uint32_t p) const {
    if (is_surely_resolved(b, p)) return false;
    const Mat3 v = moments(b, p, reach_).covariance();
    const auto [least, largest] = extreme_eigenvalues(v, bins_.lattice().dimension);
    const double h = 1 / cells_per_r_;
    return least < search_.thresholds.anisotropy * largest || largest < search_.thresholds.extent * h * h;
  }

 private:
  [[nodiscard]] double mass_of(std::uint32_t p) const {
    const BinnedPoint& point = bins_.point(p);
    return search_.mass[point.set] * sets_[point.set].share(point.slot.tile, point.slot.lane);
  }
  struct Box {
    std::array<int, 3> low;
    std::array<int, 3> high;
  };
  [[nodiscard]] Box cells_within(std::uint32_t p, double radius) const {
    Box box{};
    for (int a = 0; a < 3; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      box.low[axis] = static_cast<int>(std::floor(static_cast<double>(bins_.local(p, a)) - radius));
      box.high[axis] = static_cast<int>(std::floor(static_cast<double>(bins_.local(p, a)) + radius));
    }
    return box;
  }

  [[nodiscard]] Moments moments(std::size_t b, std::uint32_t p, double radius) const {
    const Box box = cells_within(p, radius);
    const Local here = bins_.local(p);
    const int dim = bins_.lattice().dimension;
    Moments m;
    bins_.for_points(b, box.low, box.high, [&](std::uint32_t q, const Local& at) {
      Vec3 x = Vec3::Zero();
      double w = 1;
      for (int a = 0; a < dim; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        x[a] = static_cast<double>(at[axis]) - static_cast<double>(here[axis]);
        w *= kernel_at(search_.weights, x[a] * cells_per_r_);
      }
      if (w > 0) m.add(w * mass_of(q), x);
    });
    return m;
  }

  /// A bound that only looks at the points nearby, for the many that are well inside: their scatter is not
  /// more than that of all points about p_p, each of all n points weighs (w m)^2 <= (w(0) m_max)^2, and none
  /// of them is further than 2 reach from p_p along an axis.
  [[nodiscard]] bool is_surely_resolved(std::size_t b, std::uint32_t p) const {
    const Mat3 scatter = moments(b, p, 1).scatter();
    const Box box = cells_within(p, reach_);
    const double weights = largest_weight_ * largest_weight_ * bins_.count_points(b, box.low, box.high);
    const int dim = bins_.lattice().dimension;
    const double h = 1 / cells_per_r_;
    const double most = 4 * dim * reach_ * reach_;
    return extreme_eigenvalues(scatter, dim)[0] >
           weights * std::max(search_.thresholds.anisotropy * most, search_.thresholds.extent * h * h);
  }

  const PointBins& bins_;
  const std::vector<ParticleSet<Real>>& sets_;
  const SubgridSearch& search_;
  double cells_per_r_;
  double reach_;               // r
  double largest_weight_ = 0;  // w(0) times the largest mass of any point
};

}  // namespace

template <class Real>
std::vector<std::uint32_t> find_subgrid_points(const PointBins& bins,
                                               const std::vector<ParticleSet<Real>>& sets,
                                               const SubgridSearch& search, int threads) {
  const Finder<Real> finder(bins, sets, search);
  std::vector<std::vector<std::uint32_t>> found(bins.blocks().size());
  parallel_for(threads, static_cast<std::int64_t>(found.size()), 4, [&](std::int64_t index) {
    const auto b = static_cast<std::size_t>(index);
    const std::uint32_t end = bins.last(b, bins.lattice().cells() - 1);
    for (std::uint32_t p = bins.first(b, 0); p < end; ++p)
      if (finder.is_weak(p) && finder.is_unresolved(b, p)) found[b].push_back(p);
  });
  std::vector<std::uint32_t> all;
  for (const auto& list : found) all.insert(all.end(), list.begin(), list.end());
  return all;
}

template <class Real>
double remove_points(const std::vector<std::uint32_t>& points, const PointBins& bins,
                     std::vector<ParticleSet<Real>>& sets, const std::vector<double>& mass) {
  double removed = 0;
  for (const std::uint32_t p : points) {
    const BinnedPoint& point = bins.point(p);
    removed += mass[point.set] * sets[point.set].share(point.slot.tile, point.slot.lane);
    sets[point.set].remove(point.slot);
  }
  return removed;
}

template std::vector<std::uint32_t> find_subgrid_points(const PointBins&,
                                                        const std::vector<ParticleSet<float>>&,
                                                        const SubgridSearch&, int);
template std::vector<std::uint32_t> find_subgrid_points(const PointBins&,
                                                        const std::vector<ParticleSet<double>>&,
                                                        const SubgridSearch&, int);
template double remove_points(const std::vector<std::uint32_t>&, const PointBins&,
                              std::vector<ParticleSet<float>>&, const std::vector<double>&);
template double remove_points(const std::vector<std::uint32_t>&, const PointBins&,
                              std::vector<ParticleSet<double>>&, const std::vector<double>&);

}  // namespace lather::mpm::resample
