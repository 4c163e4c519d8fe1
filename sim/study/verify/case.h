#pragma once

#include <optional>
#include <string>
#include <vector>

/// Verification: whole simulations, or the law alone, against exact solutions.
namespace lather::study {

/// One figure of a case, with the bound that it must keep.
struct Finding {
  std::string what;  ///< the quantity, with its unit where it has one
  double error = 0;  ///< measured
  double bound = 0;  ///< largest error that passes
  // Where the case was run at several spacings or steps:
  std::optional<double> order = std::nullopt;        ///< observed order of convergence
  std::optional<double> least_order = std::nullopt;  ///< that passes

  /// False for an error or order that is not a number, too.
  [[nodiscard]] bool passed() const;
};

struct VerificationCase {
  std::string name;   ///< on the command line, e.g. "film"
  std::string claim;  ///< what holds if it passes, one line
  bool quick = true;  ///< seconds; else minutes
  std::vector<Finding> (*run)(int threads) = nullptr;
};

/// All cases, the quick ones first.
[[nodiscard]] const std::vector<VerificationCase>& verification_cases();

struct CaseResult {
  const VerificationCase* source = nullptr;
  std::vector<Finding> findings;
  std::string error;   ///< why the case could not be run to its end, "" if it was
  double seconds = 0;  ///< wall clock

  [[nodiscard]] bool passed() const;
};

/// Runs one case; `threads` = 0 takes all cores. A simulation that fails is a result, not an exception.
[[nodiscard]] CaseResult run_case(const VerificationCase& verification, int threads);

/// Observed order of convergence of errors at spacings h: the slope of ln(error) over ln(h) by least squares.
[[nodiscard]] double observed_order(const std::vector<double>& spacing, const std::vector<double>& error);

/// {"passed": …, "cases": [{"name", "claim", "seconds", "passed", "error"?, "findings": [{"what", "error",
/// "bound", "order"?, "least_order"?, "passed"}]}]}
[[nodiscard]] std::string to_json(const std::vector<CaseResult>& results);

}  // namespace lather::study
