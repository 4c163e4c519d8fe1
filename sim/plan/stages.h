#pragma once

#include <array>

/// The parts of a step, in the order in which they run. One name each in the plan, the report, the profile
/// and the docs. Numbers are the procedures of "Continuum Foam", section 4.
namespace lather {

enum class Stage : int {
  kEmit,                ///< points of the releases that are due; only with emitters
  kSort,                ///< points by block, and the grid's blocks; only when points have drifted
  kDetectTearing,       ///< 2
  kRasterize,           ///< 1, 3: mass, momentum and internal forces to block buffers
  kLimitForces,         ///< 4, within kRasterize
  kReduce,              ///< block buffers to the grid
  kGridVelocities,      ///< 5
  kSolveVelocities,     ///< 5, semi-implicit: velocities at the end of the step
  kGridCollisions,      ///< 6
  kCollect,             ///< grid to block buffers
  kUpdateParticles,     ///< 7, 9, 10: deformation, velocities, plastic flow
  kLimitDeformation,    ///< 8, within kUpdateParticles
  kRecovery,            ///< 11
  kParticleCollisions,  ///< 13
  kPositions,           ///< 14
  kRemoveSubgrid,       ///< 12: only once an interval, between steps
  kAvoidVoid,           ///< 15: resampling; only once an interval
  // Of the MLSRK solver, which also has kSort, kParticleCollisions and kPositions; see kMlsrkStages.
  kNeighbours,         ///< points by cell, and which tiles of them reach which
  kShapeFunctions,     ///< corrections b and their gradients [MLSRK eq. 8, Appendix A]
  kStress,             ///< [MLSRK eq. 22, 23]
  kMomentum,           ///< accelerations and velocities [MLSRK eq. 11]
  kVelocityGradients,  ///< and the velocities that they are blended with [MLSRK eq. 12, 18]
  kPhases,       ///< concentrations, and what swells with them; only with phases [MLSRK eq. 13-16, 30, 31]
  kDeformation,  ///< deformation, return mappings [MLSRK eq. 17, 19, 24-29]
};
inline constexpr int kStageCount = 24;
inline constexpr int kMpmStageCount = static_cast<int>(Stage::kNeighbours);  ///< they stand first

/// Those of the MLSRK solver, in the order in which they run.
inline constexpr std::array<Stage, 10> kMlsrkStages = {
    Stage::kSort,        Stage::kNeighbours,         Stage::kShapeFunctions,    Stage::kStress,
    Stage::kMomentum,    Stage::kParticleCollisions, Stage::kVelocityGradients, Stage::kPhases,
    Stage::kDeformation, Stage::kPositions};

inline constexpr std::array<const char*, kStageCount> kStageNames = {"emit",
                                                                     "sort",
                                                                     "detect tearing",
                                                                     "rasterize",
                                                                     "limit forces",
                                                                     "reduce",
                                                                     "grid velocities",
                                                                     "solve velocities",
                                                                     "grid collisions",
                                                                     "collect",
                                                                     "update particles",
                                                                     "limit deformation",
                                                                     "plastic recovery",
                                                                     "particle collisions",
                                                                     "positions",
                                                                     "remove subgrid geometry",
                                                                     "avoid a void",
                                                                     "neighbours",
                                                                     "shape functions",
                                                                     "stress",
                                                                     "momentum",
                                                                     "velocity gradients",
                                                                     "phases",
                                                                     "deformation"};

/// Whether the stage runs on its own and its time is known; else it is a part of the stage before it, whose
/// time holds its own.
constexpr bool timed(Stage stage) {
  return stage != Stage::kLimitForces && stage != Stage::kLimitDeformation;
}

}  // namespace lather
