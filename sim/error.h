#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace lather {

/// One thing that is wrong with what the user wrote.
struct Problem {
  std::string pointer;  ///< JSON pointer (RFC 6901) to the offending value, "" for the whole document
  std::string value;    ///< the value as it stands there, shortened; "" where there is none
  std::string allowed;  ///< what is allowed there: a range with its unit, a list of names
  std::string message;  ///< one sentence: what is wrong and what to do
};

/// The scene, or another document of the user's, cannot be used. Holds every problem found, at least one.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// A run that cannot go on: what went wrong, when and where, and one thing to change.
/// Frames made before it stay.
class SimulationError : public std::runtime_error {
 public:
  struct Details {
    std::string kind;      ///< "non-finite", "runaway", "energy", "grip", "capacity"
    long long step = 0;    ///< index of the step that failed, from 0
    double time = 0;       ///< simulated time at its start, s
    std::string quantity;  ///< e.g. "particle velocity"
    std::string value;     ///< e.g. "nan", "1.2e+05 m/s"
    std::string advice;    ///< one thing to change
  };
  explicit SimulationError(Details details);
  [[nodiscard]] const Details& details() const { return details_; }

 private:
  Details details_;
};

}  // namespace lather
