#include "sim/study/verify/case.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sim/error.h"
#include "sim/scene/value.h"

namespace lather::study {
namespace {

Value json_of(const Finding& finding) {
  // JSON has no infinity or NaN; what cannot be written is null, and has not passed.
  const auto number = [](double x) { return std::isfinite(x) ? Value(x) : Value(); };
  Object out = {{"what", finding.what}, {"error", number(finding.error)}, {"bound", finding.bound}};
  if (finding.order) out.emplace_back("order", number(*finding.order));
  if (finding.least_order) out.emplace_back("least_order", *finding.least_order);
  out.emplace_back("passed", finding.passed());
  return Value(std::move(out));
}

Value json_of(const CaseResult& result) {
  Array findings;
  for (const Finding& f : result.findings) findings.push_back(json_of(f));
  Object out = {{"name", result.source->name},
                {"claim", result.source->claim},
                {"seconds", result.seconds},
                {"passed", result.passed()}};
  if (!result.error.empty()) out.emplace_back("error", result.error);
  out.emplace_back("findings", std::move(findings));
  return Value(std::move(out));
}

}  // namespace

bool Finding::passed() const {
  return error <= bound && (!least_order || (order && *order >= *least_order));
}

bool CaseResult::passed() const {
  return error.empty() && !findings.empty() &&
         std::all_of(findings.begin(), findings.end(), [](const Finding& f) { return f.passed(); });
}

CaseResult run_case(const VerificationCase& verification, int threads) {
  CaseResult result;
  result.source = &verification;
  const auto start = std::chrono::steady_clock::now();
  try {
    result.findings = verification.run(threads);
  } catch (const SimulationError& error) {
    result.error = error.what();
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  result.seconds = took.count();
  return result;
}

double observed_order(const std::vector<double>& spacing, const std::vector<double>& error) {
  double x = 0;
  double y = 0;
  double xx = 0;
  double xy = 0;
  const auto n = static_cast<double>(spacing.size());
  for (std::size_t i = 0; i < spacing.size(); ++i) {
    const double lx = std::log(spacing[i]);
    const double ly = std::log(error[i]);
    x += lx / n;
    y += ly / n;
    xx += lx * lx / n;
    xy += lx * ly / n;
  }
  return (xy - x * y) / (xx - x * x);
}

std::string to_json(const std::vector<CaseResult>& results) {
  Array cases;
  bool passed = true;
  for (const CaseResult& r : results) {
    cases.push_back(json_of(r));
    passed = passed && r.passed();
  }
  return write_json(Object{{"passed", passed}, {"cases", std::move(cases)}}, 2);
}

}  // namespace lather::study
