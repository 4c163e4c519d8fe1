// The quick cases of `lather verify`, through the same functions; the long ones run in the shard long-verify.

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/study/verify/case.h"

namespace lather::study {

/// For GoogleTest, which would print the case's bytes.
inline void PrintTo(const VerificationCase& verification, std::ostream* out) {
  *out << verification.name;
}

namespace {

std::vector<VerificationCase> quick_cases() {
  std::vector<VerificationCase> cases;
  for (const VerificationCase& c : verification_cases())
    if (c.quick) cases.push_back(c);
  return cases;
}

class Verify : public testing::TestWithParam<VerificationCase> {};

TEST_P(Verify, KeepsItsBounds) {
  const CaseResult result = run_case(GetParam(), 1);
  EXPECT_EQ(result.error, "");
  EXPECT_FALSE(result.findings.empty());
  for (const Finding& f : result.findings)
    EXPECT_TRUE(f.passed()) << f.what << ": " << f.error << ", bound " << f.bound << ", order "
                            << f.order.value_or(0);
}

INSTANTIATE_TEST_SUITE_P(Cases, Verify, testing::ValuesIn(quick_cases()), [](const auto& test) {
  std::string name = test.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace lather::study
