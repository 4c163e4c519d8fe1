#pragma once

#include "sim/study/verify/case.h"

/// Verification of the MLSRK solver; each case argues its bounds where it stands.
namespace lather::study::mlsrk {

/// Frequency and decay of a small standing wave in a neo-Hookean bar.
[[nodiscard]] std::vector<Finding> verify_wave(int threads);
/// A free elastic disk that turns: angular momentum and energy.
[[nodiscard]] std::vector<Finding> verify_disk(int threads);
/// The viscosity of the velocity blend.
[[nodiscard]] std::vector<Finding> verify_blend(int threads);
/// Energy and both momenta of a closed elastic body without the blend.
[[nodiscard]] std::vector<Finding> verify_energy(int threads);

/// How fast a wave of concentration fades; the mass of a component.
[[nodiscard]] std::vector<Finding> verify_diffusion(int threads);
/// Pressure in a column of liquid at rest.
[[nodiscard]] std::vector<Finding> verify_column(int threads);
/// A beam under its own weight.
[[nodiscard]] std::vector<Finding> verify_cantilever(int threads);
/// Collapse of a column of water against measurements.
[[nodiscard]] std::vector<Finding> verify_dam_break(int threads);
/// Collapse of a column of sand against measurements.
[[nodiscard]] std::vector<Finding> verify_sand_column(int threads);

}  // namespace lather::study::mlsrk
