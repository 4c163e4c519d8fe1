#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "sim/math/vec.h"
#include "sim/mlsrk/kernels.h"

namespace lather::mlsrk {

/// Points put by hand, to call kernels with: one block, in the order in which they came. Lengths over a,
/// volumes over a^dim.
template <class Real>
class LooseCloud {
 public:
  void add(const Vec3& x, double volume) {
    const std::size_t lane = size_++ % kTile;
    if (lane == 0) {
      constexpr Real kMost = std::numeric_limits<Real>::max();
      place_.resize(place_.size() + 3 * kTile, static_cast<Real>(kNowhere));
      place_.resize(place_.size() + kTile, Real(0));
      extents_.push_back({{kMost, kMost, kMost}, {-kMost, -kMost, -kMost}});
    }
    Real* place = place_.data() + place_.size() - 4 * kTile + lane;
    for (int a = 0; a < 3; ++a) {
      const auto c = static_cast<Real>(x[a]);
      place[a * kTile] = c;
      extents_.back().low[a] = std::min(extents_.back().low[a], c);
      extents_.back().high[a] = std::max(extents_.back().high[a], c);
    }
    place[3 * kTile] = static_cast<Real>(volume);
    block_ = {0, static_cast<std::int32_t>(extents_.size()), {0, 0, 0}};
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t tiles() const { return extents_.size(); }

  /// The result holds until the next call.
  [[nodiscard]] Surroundings<Real> around(std::size_t tile) {
    reals_.resize(scratch_reals(tiles() * kTile));
    slots_.resize(scratch_stride(tiles() * kTile));
    const std::size_t count = std::min<std::size_t>(kTile, size_ - tile * kTile);
    return {static_cast<std::uint32_t>(tile),
            static_cast<std::int32_t>(count),
            place_.data(),
            extents_.data(),
            &block_,
            1,
            reals_.data(),
            slots_.data()};
  }

 private:
  std::size_t size_ = 0;
  std::vector<Real> place_;
  std::vector<Extent<Real>> extents_;
  NearBlock<Real> block_{};
  std::vector<Real> reals_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace lather::mlsrk
