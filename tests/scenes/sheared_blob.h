#pragma once

#include <string>

namespace lather::testing_support {

/// The blob between plates with and without resampling, at a size that its file names: no interior voids
/// with it, some without; mass to rounding; momentum by both rules for the velocity of new points.
void expect_voids_only_without_resampling(const std::string& size, int threads);

}  // namespace lather::testing_support
