// A sheet of paper is hit by a ball of water and pulled at both ends [MLSRK Figure 1] at preview: 20 mm.

#include "tests/scenes/wet_paper.h"

#include <gtest/gtest.h>

namespace lather::testing_support {
namespace {

TEST(WetPaper, TearsWhereItIsWetAndNotWhenItStaysDry) {
  const TornPaper wet = run_wet_paper("preview", {}, 1);
  EXPECT_GT(wet.second_part, 0.3);
  EXPECT_GT(wet.wetness, 0.1);
  const TornPaper dry = run_wet_paper(
      "preview", {{"/materials/0/phase/mobility", "0"}, {"/materials/1/phase/mobility", "0"}}, 1);
  EXPECT_LT(dry.second_part, 0.01);
}

}  // namespace
}  // namespace lather::testing_support
