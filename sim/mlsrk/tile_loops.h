#pragma once

// The loops of a step's stages over tiles and points.

#include "sim/math/parallel.h"
#include "sim/mlsrk/step.h"

namespace lather::mlsrk {

template <class Real>
template <class Work>
void Stepper<Real>::for_set_tiles(Stage stage, const Work& work) {
  parallel_for(threads_, static_cast<std::int64_t>(set_tiles_.size()), 64, [&](std::int64_t index) {
    clock_.time(stage, [&] { work(set_tiles_[static_cast<std::size_t>(index)]); });
  });
}

template <class Real>
template <class Kernel>
void Stepper<Real>::on_tiles(Stage stage, const Kernel& kernel) {
  parallel_for(threads_, static_cast<std::int64_t>(cloud_.tiles().size()), 4, [&](std::int64_t index) {
    const auto t = static_cast<std::size_t>(index);
    clock_.time(stage, [&] { kernel(t, cloud_.around(t, scratch().nearby)); });
  });
}

template <class Real>
template <class Visit>
void Stepper<Real>::for_points(const State<Real>& state, const TileOfSet& at, const Visit& visit) const {
  const std::uint32_t* ids = state.sets[at.set].template values<std::uint32_t>(at.tile, Field::kId);
  for (int lane = 0; lane < kTile; ++lane)
    if (ids[lane] != kNoPoint) visit(lane, cloud_.slot_of(at.set, at.tile, lane));
}

}  // namespace lather::mlsrk
