#include "sim/scene/quality.h"

#include <stdexcept>
#include <string>

#include "sim/scene/tables.h"

namespace lather {
namespace {

/// Reads the keys of `json`, an object, into `numerics`; they were read before, or are our own.
void read_numerics(std::string_view json, int dimension, Numerics& numerics) {
  descriptor::Reading reading;
  reading.dimension = dimension;
  tables::numerics().read(parse_json(json), numerics, descriptor::Place(reading));
  if (!reading.problems.empty()) throw InputError(std::move(reading.problems));
}

}  // namespace

const std::array<QualityPoint, 4>& quality_points(Solver solver) {
  // Written by docs/tradeoff-figures.
  // clang-format off
  static constexpr std::array<QualityPoint, 4> kMpm = {{
      {Quality::kDraft, "draft",
       R"({"kernel": "cubic", "transfer": "apic", "precision": "float", "safety_factor": 0.65})",
       0.09614, 0.7751, 0.6522},
      {Quality::kStandard, "standard",
       R"({"kernel": "quadratic", "transfer": "apic", "precision": "float", "safety_factor": 0.4})",
       0.07134, 0.5534, 0.8853},
      {Quality::kFine, "fine",
       R"({"kernel": "quadratic", "transfer": "apic", "precision": "float", "safety_factor": 0.2})",
       0.1263, 0.3183, 1.662},
      {Quality::kReference, "reference",
       R"({"kernel": "quadratic", "transfer": "apic", "precision": "float", "safety_factor": 0.2})",
       0.1263, 0.3183, 1.662},
  }};
  static constexpr std::array<QualityPoint, 4> kMlsrk = {{
      {Quality::kDraft, "draft",
       R"({"mlsrk": {"kernel_shape": "tensor", "support_radius": 2}, "precision": "float", "safety_factor": 0.6})",
       0.1248, 0.618, 0.6328},
      {Quality::kStandard, "standard",
       R"({"mlsrk": {"kernel_shape": "radial", "support_radius": 2}, "precision": "float", "safety_factor": 0.4})",
       0.08588, 0.4934, 0.9245},
      {Quality::kFine, "fine",
       R"({"mlsrk": {"kernel_shape": "radial", "support_radius": 2}, "precision": "float", "safety_factor": 0.2})",
       0.08787, 0.4288, 1.79},
      {Quality::kReference, "reference",
       R"({"mlsrk": {"kernel_shape": "radial", "support_radius": 2}, "precision": "float", "safety_factor": 0.1})",
       0.08856, 0.3781, 3.537},
  }};
  // clang-format on
  // End of what it writes.
  return solver == Solver::kMpm ? kMpm : kMlsrk;
}

const QualityPoint& quality_point(Solver solver, Quality quality) {
  for (const QualityPoint& point : quality_points(solver))
    if (point.quality == quality) return point;
  throw std::logic_error("no quality has these numerics");
}

Numerics numerics_of(Solver solver, Quality quality) {
  Numerics numerics;
  read_numerics(quality_point(solver, quality).numerics, 3, numerics);
  return numerics;
}

Scene with_quality(const Scene& scene, Quality quality) {
  Scene out = scene;
  out.quality = quality;
  out.numerics = numerics_of(scene.solver, quality);
  if (!scene.given_numerics.empty()) read_numerics(scene.given_numerics, scene.dimension, out.numerics);
  return out;
}

}  // namespace lather
