// How findings are judged and told.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/error.h"
#include "sim/scene/value.h"
#include "sim/study/verify/case.h"

namespace lather::study {
namespace {

const double kNan = std::nan("");

TEST(Finding, PassesUpToItsBoundAndFromItsOrder) {
  EXPECT_TRUE((Finding{"", 1, 1}).passed());
  EXPECT_FALSE((Finding{"", 1.1, 1}).passed());
  EXPECT_TRUE((Finding{"", 1, 1, 2, 2}).passed());
  EXPECT_FALSE((Finding{"", 1, 1, 1.9, 2}).passed());
}

TEST(Finding, NeverPassesWithoutANumber) {
  EXPECT_FALSE((Finding{"", kNan, 1}).passed());
  EXPECT_FALSE((Finding{"", 0, 1, kNan, 2}).passed());
}

TEST(ObservedOrder, IsThePowerOfTheSpacing) {
  EXPECT_NEAR(observed_order({0.1, 0.05, 0.025}, {4e-2, 1e-2, 2.5e-3}), 2, 1e-12);
}

std::vector<Finding> fails(int /*threads*/) {
  throw SimulationError({"runaway", 3, 0.1, "a point's speed", "fast", "Go slower."});
}
std::vector<Finding> misses(int /*threads*/) {
  return {{"good", 0, 1}, {"not a number", kNan, 1}};
}

TEST(Verification, AFailedSimulationIsAFailedCase) {
  const VerificationCase broken = {"broken", "", true, fails};
  const CaseResult result = run_case(broken, 1);
  EXPECT_FALSE(result.passed());
  EXPECT_NE(result.error.find("speed"), std::string::npos);
}

TEST(Verification, OneMissedBoundFailsTheWhole) {
  const VerificationCase missing = {"missing", "a claim", true, misses};
  const CaseResult result = run_case(missing, 1);
  EXPECT_FALSE(result.passed());
  const Value json = parse_json(to_json({result}));
  EXPECT_EQ(std::get<bool>(json.find("passed")->data), false);
  const Value& listed = (*json.find("cases")->array())[0];
  EXPECT_EQ(*listed.find("name")->text(), "missing");
  EXPECT_EQ(listed.find("findings")->array()->size(), 2U);
}

TEST(Verification, CasesHaveNamesOfTheirOwnAndClaims) {
  std::set<std::string> names;
  for (const VerificationCase& c : verification_cases()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    EXPECT_FALSE(c.claim.empty());
    EXPECT_NE(c.run, nullptr);
  }
}

}  // namespace
}  // namespace lather::study
