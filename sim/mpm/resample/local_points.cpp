#include "sim/mpm/resample/local_points.h"

namespace lather::mpm::resample {

LocalPoints::LocalPoints(const Lattice& lattice)
    : lattice_(lattice), margin_(lattice.dimension == 3 ? 1 : 0) {}

void LocalPoints::copy(const PointBins& bins, std::size_t block) {
  x_.clear();
  start_.clear();
  const int w = lattice_.width;
  const auto side = [](int cell, int n) { return cell < 0 ? -1 : cell >= n ? 1 : 0; };
  for (int i = -1; i <= w; ++i)
    for (int j = -1; j <= w; ++j)
      for (int oz = -margin_; oz <= margin_; ++oz) {  // a row of cells, piece by piece
        const std::array<int, 3> o = {side(i, w), side(j, w), oz};
        const std::int32_t found = bins.neighbour(block, o);
        const int first = oz < 0 ? lattice_.depth - 1 : 0;
        const int last = oz > 0 ? 0 : lattice_.depth - 1;
        const auto here = static_cast<std::uint32_t>(x_.size());
        if (found < 0) {
          start_.insert(start_.end(), static_cast<std::size_t>(last - first + 1), here);
          continue;
        }
        const auto from = static_cast<std::size_t>(found);
        const int cell = lattice_.index(i - o[0] * w, j - o[1] * w, 0);
        const std::uint32_t begin = bins.first(from, cell + first);
        const std::uint32_t end = bins.last(from, cell + last);
        for (int k = first; k <= last; ++k) start_.push_back(here + bins.first(from, cell + k) - begin);
        for (std::uint32_t p = begin; p < end; ++p) {
          const Local x = bins.local(p);
          x_.push_back({x[0] + static_cast<float>(o[0] * w), x[1] + static_cast<float>(o[1] * w),
                        x[2] + static_cast<float>(o[2] * w)});
        }
      }
  start_.push_back(static_cast<std::uint32_t>(x_.size()));
}

}  // namespace lather::mpm::resample
