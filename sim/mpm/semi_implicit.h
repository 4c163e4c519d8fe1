#pragma once

#include <cstdint>
#include <vector>

#include "sim/collide/obstacles.h"
#include "sim/mpm/step.h"

namespace lather::mpm {

/// The semi-implicit step: grid velocities at the end of the step, with the forces' change over it.
/// [Foam section 8; Stomakhin et al. 2013, section 9]
///
/// With positions x + dt u the force is f - beta dt K u, K the second derivative of the elastic energy
/// (sim/material/elastic_tangent.h); so the velocities u of the step's end solve
///
///   (M + beta dt^2 K) u = M (v + dt g) + dt f,
///
/// one linear system (no Newton iteration), with M the nodes' masses. It is symmetric and solved by conjugate
/// gradients, preconditioned by M. That is the choice which keeps momentum to rounding however early the
/// iteration ends: K takes nothing from a translation, so that every residual, and thus every change M z of
/// momentum, sums to zero. The stiffness' own diagonal is nearly a multiple of M inside the material, and
/// gains little there.
///
/// K is not always positive (a body under pressure wants to turn and buckle). Where a direction of negative
/// curvature turns up, the iteration goes on from where it stands with K's part that is never negative.
///
/// Contact holds the velocity of nodes inside obstacles and walls if the explicit step's velocity
/// v + dt (f/m + g) would meet them: in whole where friction stops the node, else along the normal; the
/// solver works in what is left free. After a solve the impulses with which the contact held its nodes say
/// which of them stick and what friction the others feel, and it is solved on with that, a few rounds at
/// most. (Friction applied to velocities afterwards, as in an explicit step, can take no more than a node's
/// own momentum per step; the nodes that touch are light, so a body would slide ever longer as steps grow.)
///
/// Sums are taken block by block in a fixed order: same bits for any number of threads.
template <class Real>
class VelocitySolver {
 public:
  VelocitySolver(const Model<Real>& model, int threads);

  /// `grid` holds (m, v) at the step's start and, with FLIP, increments; leaves (m, u) and (0, u - v). Block
  /// buffers are used as scratch memory. Obstacles must be placed.
  SolveFigures solve(State<Real>& state, BlockGrid<Real>& grid, const StepConstants<Real>& step,
                     const Obstacles& obstacles, StageClock& clock);

  [[nodiscard]] std::size_t bytes() const;

 private:
  struct HeldNode {
    int node;
    Hold hold;
  };
  struct Run;  // one solve: the grid and what it works with

  const Model<Real>& model_;
  int threads_;
  std::vector<std::int32_t> active_;         // grid blocks that hold mass
  std::vector<std::vector<HeldNode>> held_;  // per active block, nodes ascending
  std::vector<Real> residual_;               // per grid block, as its nodes: (0, p), contact's pull included
  std::vector<Real> change_;                 // … of the velocity, as solved so far
  std::vector<Real> direction_;
  std::vector<Real> product_;                     // operator times direction
  std::vector<std::vector<Real>> scratch_;        // per thread: a block buffer
  std::vector<std::vector<std::uint32_t>> near_;  // per thread
};

}  // namespace lather::mpm
