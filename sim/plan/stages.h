#pragma once

#include <array>

/// The parts of a step, in the order in which they run. One name each in the plan, the report, the profile
/// and the docs. Numbers are the procedures of "Continuum Foam", section 4.
namespace lather {

enum class Stage : int {
  kSort,                ///< points by block, and the grid's blocks; only when points have drifted
  kRasterize,           ///< 1, 3: mass, momentum and internal forces to block buffers
  kReduce,              ///< block buffers to the grid
  kGridVelocities,      ///< 5
  kSolveVelocities,     ///< 5, semi-implicit: velocities at the end of the step
  kGridCollisions,      ///< 6
  kCollect,             ///< grid to block buffers
  kUpdateParticles,     ///< 7, 9, 10: deformation, velocities, plastic flow
  kParticleCollisions,  ///< 13
  kPositions,           ///< 14
  kAvoidVoid,           ///< 15: resampling; only once an interval
};
inline constexpr int kStageCount = 11;

inline constexpr std::array<const char*, kStageCount> kStageNames = {"sort",
                                                                     "rasterize",
                                                                     "reduce",
                                                                     "grid velocities",
                                                                     "solve velocities",
                                                                     "grid collisions",
                                                                     "collect",
                                                                     "update particles",
                                                                     "particle collisions",
                                                                     "positions",
                                                                     "avoid a void"};

}  // namespace lather
