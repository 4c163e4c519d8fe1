#pragma once

#include <array>

#include "sim/simulation.h"
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

inline constexpr int kWavePeriods = 4;  ///< from the standing wave's first frame to its last
/// The standing wave in a bar so many points long, without the blend; so many frames a period.
[[nodiscard]] Scene standing_wave(int points, int frames_per_period);

/// The rotating disk, two turns of it, so many points across, with the blend that it needs.
[[nodiscard]] Scene rotating_disk(int points_across);

/// The column of liquid, so many points high, on the domain's bare floor with volumes corrected, or on held
/// points with volumes as deformed; `jitter` as a scene's.
[[nodiscard]] Scene column(int points, double jitter, bool bare);

/// Errors of the mean pressure in eighths of the column's height, over the pressure at the floor.
struct ColumnError {
  double mean = 0;  ///< root of the mean square
  double largest = 0;
  double largest_above = 0;  ///< above the lowest eighth
};
inline constexpr int kColumnBins = 8;

/// Adds up the pressure over the second half of a column's frames.
class ColumnProfile {
 public:
  explicit ColumnProfile(const Scene& scene);
  void see(const Simulation& simulation);  ///< at every frame
  [[nodiscard]] ColumnError error() const;

 private:
  double floor_;
  std::array<double, kColumnBins> excess_ = {};
  std::array<double, kColumnBins> weight_ = {};
};

/// A wave of concentration so many points long, in one frame to when exp(-0.1) of it is left.
[[nodiscard]] Scene concentration_wave(int points);
/// 2 <c cos(k x)> of such a wave.
[[nodiscard]] double concentration_amplitude(const Simulation& simulation);

}  // namespace lather::study::mlsrk
