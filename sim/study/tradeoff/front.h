#pragma once

#include <optional>
#include <string>
#include <vector>

/// Speed against accuracy: which points of a measurement are worth taking.
namespace lather::study {

/// What a choice of settings costs and how far it is off. Costs vary from run to run, errors do not: runs
/// are bit-equal.
struct FrontPoint {
  double error = 0;
  double cost = 0;      ///< median of its runs
  double cheapest = 0;  ///< run
  double dearest = 0;   ///< run
};

/// Errors nearer than this, relative, count as equal: a lattice that lies a little otherwise, or another
/// rounding, changes them as much, and nobody sees it in a result.
inline constexpr double kEqualErrors = 0.02;

/// Whether `other` is better beyond noise: no less accurate (kEqualErrors) and cheaper in every run of both;
/// or clearly more accurate and no dearer. False where either error or cost is not a number.
[[nodiscard]] bool dominated(const FrontPoint& point, const FrontPoint& other);

/// Which points no other one dominates, from the cheapest to the dearest.
[[nodiscard]] std::vector<std::size_t> front_of(const std::vector<FrontPoint>& points);

/// Points by the name of a scene's "quality".
struct QualityPicks {
  std::size_t draft = 0;
  std::size_t standard = 0;
  std::size_t fine = 0;
  std::size_t reference = 0;
};

/// The rule that picks them from the front, `cost` over that of the scene format's defaults: draft is the
/// cheapest that errs at most kDraftError times as much as the defaults, standard the most accurate that
/// costs no more than they do within noise, fine the most accurate at up to kFineCost times their cost,
/// reference the most accurate of all. Of equally accurate points (kEqualErrors) the cheapest. None where no
/// point meets a limit.
inline constexpr double kDraftError = 4;
inline constexpr double kFineCost = 3;
[[nodiscard]] std::optional<QualityPicks> pick_qualities(const std::vector<FrontPoint>& points,
                                                         const FrontPoint& defaults);

}  // namespace lather::study
