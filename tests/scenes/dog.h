#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace lather::testing_support {

/// What becomes of water and hairs of the pseudo-dog.
struct ShakeOff {
  double wettest = 0;    ///< largest share of the water, over all frames, that is where the hairs reach
  double wet = 0;        ///< the same at the end
  std::size_t lost = 0;  ///< points of hairs at the end that no chain of points joins to the body
};

/// Hairs reach everywhere in the cylinder about the axis that holds them at the start. Chains have links of
/// at most 2 spacings: the kernel reaches over 3.
[[nodiscard]] ShakeOff run_shake_off(const std::string& size, const std::vector<Override>& overrides,
                                     int threads);

}  // namespace lather::testing_support
