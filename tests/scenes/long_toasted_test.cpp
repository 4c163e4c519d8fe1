// The toasted s'more [Foam Figure 11] with the paper's points: 1,001,864 at 1 mm. Only its first quarter of a
// second, in which the shell cracks and the core comes out, and with the preview's moduli (20 kPa against
// compression, the shell 15 kPa in shear, which still yields at a strain of a few per cent) at half the bound
// of the step, 18 us: so it ends within an hour. The shell is eight rows of points thick here, two at
// preview.

#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"
#include "tests/scenes/smore.h"

namespace lather::testing_support {
namespace {

TEST(ToastedSmore, TearsItsShellBeforeTheCoreFlowsOut) {
  expect_crust_tears_before_core_flows(scene_file("smore-toasted", "paper",
                                                  {{"/materials/0/bulk_modulus", "20000"},
                                                   {"/materials/1/bulk_modulus", "20000"},
                                                   {"/materials/1/shear_modulus", "15000"},
                                                   {"/numerics/time_step", "0"},
                                                   {"/numerics/safety_factor", "0.5"},
                                                   {"/duration", "0.25"}}),
                                       0);
}

}  // namespace
}  // namespace lather::testing_support
