#include "sim/error.h"

#include <utility>

namespace lather {
namespace {

std::string summary(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) {
    if (!text.empty()) text += '\n';
    text += (p.pointer.empty() ? std::string("(document)") : p.pointer) + ": " + p.message;
    if (!p.value.empty()) text += " Got " + p.value + ".";
    if (!p.allowed.empty()) text += " Allowed: " + p.allowed + ".";
  }
  return text;
}

std::string summary(const SimulationError::Details& d) {
  return d.kind + " state at step " + std::to_string(d.step) + " (t = " + std::to_string(d.time) +
         " s): " + d.quantity + " is " + d.value + ". " + d.advice;
}

}  // namespace

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(summary(problems)), problems_(std::move(problems)) {}

SimulationError::SimulationError(Details details)
    : std::runtime_error(summary(details)), details_(std::move(details)) {}

}  // namespace lather
