#include "sim/mpm/semi_implicit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/math/parallel.h"
#include "sim/mpm/grid_contact.h"
#include "sim/plan/step_bound.h"

namespace lather::mpm {
namespace {

constexpr std::int64_t kChunk = 4;  // grid blocks to a partial sum
constexpr int kContactRounds = 4;   // solves of one step, with the contact found in the last one

}  // namespace

template <class Real>
struct VelocitySolver<Real>::Run {
  VelocitySolver& s;
  State<Real>& state;
  BlockGrid<Real>& grid;
  const StepConstants<Real>& step;
  const Obstacles& obstacles;
  StageClock& clock;
  int dim = s.model_.scene.dimension;
  std::size_t reals = static_cast<std::size_t>(block_reals(dim));

  /// The nodes of grid block g in `vector`.
  Real* at(std::vector<Real>& vector, std::size_t g) const { return vector.data() + g * reals; }

  /// Calls body(index into active_, grid block) for all blocks with mass.
  template <class Body>
  void for_active(const Body& body) const {
    const auto count = static_cast<std::int64_t>(s.active_.size());
    parallel_for(s.threads_, (count + kChunk - 1) / kChunk, 1, [&](std::int64_t chunk) {
      clock.time(Stage::kSolveVelocities, [&] {
        for (std::int64_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, count); ++i)
          body(static_cast<std::size_t>(i), static_cast<std::size_t>(s.active_[static_cast<std::size_t>(i)]));
      });
    });
  }

  /// Sum of part(index into active_, grid block) over all blocks with mass, in a fixed order.
  template <class Part>
  double sum_active(const Part& part) const {
    const auto count = static_cast<std::int64_t>(s.active_.size());
    const auto sum_chunk = [&](std::int64_t chunk) {
      double sum = 0;
      clock.time(Stage::kSolveVelocities, [&] {
        for (std::int64_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, count); ++i)
          sum += part(static_cast<std::size_t>(i),
                      static_cast<std::size_t>(s.active_[static_cast<std::size_t>(i)]));
      });
      return sum;
    };
    return parallel_fold(s.threads_, (count + kChunk - 1) / kChunk, 0.0, sum_chunk,
                         [](double& sum, double next) { sum += next; });
  }

  void prepare() const;
  void impulses(const Real* velocity, const StiffnessTerms<Real>& terms) const;
  double start() const;
  void hold_contacts(std::size_t index, std::size_t g) const;
  double free_energy_of_residual() const;
  void turn_direction(double keep) const;
  double multiply(const StiffnessTerms<Real>& terms) const;
  void add_product_to_residual() const { add_product_to_residual(1); }
  void take_product_from_residual() const { add_product_to_residual(-1); }
  void add_product_to_residual(Real factor) const;
  double advance(double length) const;
  void accept_change() const;
  void iterate(double enough, StiffnessTerms<Real>& terms, SolveFigures& figures) const;
  bool settle_contacts() const;
  void finish() const;
  Real* free_velocity(std::size_t index, std::size_t g, Real* out) const;
};

template <class Real>
VelocitySolver<Real>::VelocitySolver(const Model<Real>& model, int threads)
    : model_(model),
      threads_(threads),
      scratch_(static_cast<std::size_t>(threads)),
      near_(static_cast<std::size_t>(threads)) {
  for (auto& b : scratch_) b.resize(static_cast<std::size_t>(buffer_reals(model.scene.dimension)));
}

template <class Real>
SolveFigures VelocitySolver<Real>::solve(State<Real>& state, BlockGrid<Real>& grid,
                                         const StepConstants<Real>& step, const Obstacles& obstacles,
                                         StageClock& clock) {
  const Numerics& n = model_.scene.numerics;
  const auto share = static_cast<Real>(n.implicit_share);
  const Run run{*this, state, grid, step, obstacles, clock};
  const auto diffusion = static_cast<Real>(missing_diffusion(model_.scene, static_cast<double>(step.dt)));
  StiffnessTerms<Real> terms{0, share, share, diffusion};
  SolveFigures figures;

  run.prepare();
  run.impulses(grid.node(0), {1, 0, 0, 0});
  const double noise = run.start();
  run.impulses(grid.node(0), terms);
  run.add_product_to_residual();
  const double enough =
      std::max(n.solver_tolerance * n.solver_tolerance * run.free_energy_of_residual(), noise);
  for (int round = 1;; ++round) {
    run.iterate(enough, terms, figures);
    run.accept_change();
    if (round == kContactRounds || !run.settle_contacts()) break;
    run.multiply(terms);  // by the velocity that sticking took
    run.take_product_from_residual();
  }
  run.finish();
  return figures;
}

/// Conjugate gradients on what the residual leaves, until its energy is at most `enough`.
template <class Real>
void VelocitySolver<Real>::Run::iterate(double enough, StiffnessTerms<Real>& terms,
                                        SolveFigures& figures) const {
  double rest = free_energy_of_residual();
  turn_direction(0);
  while (rest > enough && figures.iterations < s.model_.scene.numerics.solver_iterations) {
    const double curvature = multiply(terms);
    ++figures.iterations;
    if (!(curvature > 0)) {
      if (figures.convex || !std::isfinite(curvature)) break;
      // Go on with the part of K that is never negative, from the velocities reached so far.
      figures.convex = true;
      accept_change();
      impulses(grid.node(0), {0, 0, -terms.geometric, 0});
      add_product_to_residual();
      terms.geometric = 0;
      rest = free_energy_of_residual();
      turn_direction(0);
      continue;
    }
    const double next = advance(rest / curvature);
    turn_direction(next / rest);
    rest = next;
  }
  figures.converged = rest <= enough;
}

/// Blocks with mass; all vectors zero.
template <class Real>
void VelocitySolver<Real>::Run::prepare() const {
  const std::size_t size = grid.grid_blocks().size() * reals;
  for (std::vector<Real>* v : {&s.residual_, &s.change_, &s.direction_, &s.product_})
    v->assign(size, Real(0));
  s.active_.clear();
  for (std::size_t g = 0; g < grid.grid_blocks().size(); ++g) {
    Real* q = grid.node(g);
    bool mass = false;
    for (std::size_t k = 0; k < reals; k += kQuad) {
      if (!(q[k] > kLeastMass<Real>)) q[k] = 0;
      mass = mass || q[k] != Real(0);
    }
    if (mass) s.active_.push_back(static_cast<std::int32_t>(g));
  }
  s.held_.resize(s.active_.size());
}

/// product = impulses of internal forces while the grid moves with `velocity`, laid out as the grid's nodes.
template <class Real>
void VelocitySolver<Real>::Run::impulses(const Real* velocity, const StiffnessTerms<Real>& terms) const {
  const int around = neighbours(dim);
  parallel_for(s.threads_, static_cast<std::int64_t>(grid.point_blocks().size()), 1, [&](std::int64_t i) {
    clock.time(Stage::kSolveVelocities, [&] {
      const auto b = static_cast<std::size_t>(i);
      const PointBlock& block = grid.point_blocks()[b];
      Real* buffer = s.scratch_[static_cast<std::size_t>(thread_index())].data();
      const Real* nodes[27];
      for (int n = 0; n < around; ++n)
        nodes[n] = velocity + static_cast<std::size_t>(block.grid[static_cast<std::size_t>(n)]) * reals;
      s.model_.kernels.collect(nodes, buffer);
      std::fill_n(grid.momentum_buffer(b), buffer_reals(dim), Real(0));
      const BlockPlace place = BlockGrid<Real>::place(block.block);
      for (std::size_t set = 0; set < state.sets.size(); ++set)
        if (const std::int32_t range = grid.range_of(set, b); range >= 0)
          s.model_.kernels.stiffness(block_points(state.sets[set], range, s.model_.materials[set]), place,
                                     step, terms, buffer, grid.momentum_buffer(b));
    });
  });
  for_active([&](std::size_t, std::size_t g) {
    const Real* buffers[27];
    for (int n = 0; n < around; ++n) {
      const std::int32_t b = grid.grid_blocks()[g].points[static_cast<std::size_t>(n)];
      buffers[n] = b < 0 ? nullptr : grid.momentum_buffer(static_cast<std::size_t>(b));
    }
    s.model_.kernels.reduce(buffers, at(s.product_, g));
  });
}

/// From (m, v) and product = dt f: contacts, the first guess u = v + dt g as contact allows it (exact in free
/// fall), and the residual without stiffness, M (v + dt g - u) + dt f. Returns what rounding leaves of the
/// residual's energy.
template <class Real>
double VelocitySolver<Real>::Run::start() const {
  const double energy = sum_active([&](std::size_t index, std::size_t g) {
    hold_contacts(index, g);
    Real* q = grid.node(g);
    Real* increment = grid.increment(g);
    Real* r = at(s.residual_, g);
    const Real* f = at(s.product_, g);
    double sum = 0;
    auto held = s.held_[index].begin();
    for (std::size_t k = 0; k < reals; k += kQuad) {
      const Real mass = q[k];
      if (mass == Real(0)) continue;
      const bool is_held = held != s.held_[index].end() && held->node * kQuad == static_cast<int>(k);
      Real u[3] = {};
      for (int a = 0; a < dim; ++a) u[a] = q[k + 1 + static_cast<std::size_t>(a)] + step.dt * step.gravity[a];
      Vec3 start = Vec3::Zero();
      for (int a = 0; a < dim; ++a) start[a] = static_cast<double>(u[a]);
      if (is_held) start = held->hold.meet(start);
      for (int a = 0; a < dim; ++a) {
        const std::size_t c = k + 1 + static_cast<std::size_t>(a);
        const auto first = is_held ? static_cast<Real>(start[a]) : u[a];
        if (increment != nullptr) increment[c] = -q[c];
        q[c] = first;
        r[c] = mass * (u[a] - first) + f[c];
      }
      sum += static_cast<double>(mass) * start.squaredNorm();
      if (is_held) ++held;
    }
    return sum;
  });
  // An operator of norm 1 + (dt omega)^2, omega up to 2 c/h, rounds a uniform motion, which it should not
  // see, to a few epsilon times that norm.
  const double stiff = static_cast<double>(step.dt / step.cell);
  double fastest = 0;
  for (const Material& m : s.model_.scene.materials) fastest = std::max(fastest, wave_speed(m.law));
  const double rounding = 4 * static_cast<double>(std::numeric_limits<Real>::epsilon()) *
                          (1 + 4 * stiff * stiff * fastest * fastest);
  return rounding * rounding * energy;
}

/// Which nodes of a block the contact holds: those that the explicit step would send against it.
template <class Real>
void VelocitySolver<Real>::Run::hold_contacts(std::size_t index, std::size_t g) const {
  std::vector<HeldNode>& held = s.held_[index];
  held.clear();
  const Real* nodes = grid.node(g);
  const Real* f = at(s.product_, g);
  auto& near = s.near_[static_cast<std::size_t>(thread_index())];
  for_nodes_near_contact(s.model_, obstacles, grid.grid_blocks()[g].block, nodes, near,
                         [&](int i, const Vec3& x, bool walls) {
                           Vec3 v = quad_vector(nodes + i * kQuad, dim) +
                                    quad_vector(f + i * kQuad, dim) / static_cast<double>(nodes[i * kQuad]);
                           for (int a = 0; a < dim; ++a)
                             v[a] += static_cast<double>(step.dt * step.gravity[a]);
                           HeldNode node{i, {}};
                           obstacles.hold(near, x, v, node.hold);
                           if (walls) s.model_.walls.hold(x, v, node.hold);
                           if (node.hold.any()) held.push_back(node);
                         });
}

/// The free part of residual / m of a block, (0, z) a node.
template <class Real>
Real* VelocitySolver<Real>::Run::free_velocity(std::size_t index, std::size_t g, Real* out) const {
  const Real* q = grid.node(g);
  const Real* r = at(s.residual_, g);
  for (std::size_t k = 0; k < reals; k += kQuad) {
    const Real per_mass = q[k] != Real(0) ? Real(1) / q[k] : Real(0);
    out[k] = 0;
    for (std::size_t a = 1; a < kQuad; ++a) out[k + a] = r[k + a] * per_mass;
  }
  for (const HeldNode& h : s.held_[index])
    put_quad_vector(out + h.node * kQuad, dim, h.hold.project(quad_vector(out + h.node * kQuad, dim)));
  return out;
}

/// z . r = r^T M^-1 r of the free part, kg m^2/s^2.
template <class Real>
double VelocitySolver<Real>::Run::free_energy_of_residual() const {
  return sum_active([&](std::size_t index, std::size_t g) {
    Real z[block_reals(3)];
    free_velocity(index, g, z);
    const Real* r = at(s.residual_, g);
    double sum = 0;
    for (std::size_t k = 0; k < reals; ++k) sum += static_cast<double>(z[k]) * static_cast<double>(r[k]);
    return sum;
  });
}

/// direction = z + keep direction
template <class Real>
void VelocitySolver<Real>::Run::turn_direction(double keep) const {
  const auto factor = static_cast<Real>(keep);
  for_active([&](std::size_t index, std::size_t g) {
    Real z[block_reals(3)];
    free_velocity(index, g, z);
    Real* p = at(s.direction_, g);
    for (std::size_t k = 0; k < reals; ++k) p[k] = z[k] + factor * p[k];
  });
}

/// product = (M + beta dt^2 K) direction; returns direction . product.
template <class Real>
double VelocitySolver<Real>::Run::multiply(const StiffnessTerms<Real>& terms) const {
  impulses(s.direction_.data(), terms);
  return sum_active([&](std::size_t, std::size_t g) {
    const Real* q = grid.node(g);
    const Real* p = at(s.direction_, g);
    Real* a_p = at(s.product_, g);
    double sum = 0;
    for (std::size_t k = 0; k < reals; k += kQuad)
      for (std::size_t a = k + 1; a < k + kQuad; ++a) {
        a_p[a] = q[k] * p[a] - a_p[a];
        sum += static_cast<double>(p[a]) * static_cast<double>(a_p[a]);
      }
    return sum;
  });
}

template <class Real>
void VelocitySolver<Real>::Run::add_product_to_residual(Real factor) const {
  for_active([&](std::size_t, std::size_t g) {
    Real* r = at(s.residual_, g);
    const Real* f = at(s.product_, g);
    for (std::size_t k = 0; k < reals; ++k) r[k] += factor * f[k];
  });
}

/// Goes `length` along the direction; returns the energy of the residual that is left.
template <class Real>
double VelocitySolver<Real>::Run::advance(double length) const {
  const auto factor = static_cast<Real>(length);
  for_active([&](std::size_t, std::size_t g) {
    Real* x = at(s.change_, g);
    Real* r = at(s.residual_, g);
    const Real* p = at(s.direction_, g);
    const Real* a_p = at(s.product_, g);
    for (std::size_t k = 0; k < reals; ++k) {
      x[k] += factor * p[k];
      r[k] -= factor * a_p[k];
    }
  });
  return free_energy_of_residual();
}

/// Adds the change solved so far to the nodes' velocities.
template <class Real>
void VelocitySolver<Real>::Run::accept_change() const {
  for_active([&](std::size_t, std::size_t g) {
    Real* q = grid.node(g);
    Real* x = at(s.change_, g);
    for (std::size_t k = 0; k < reals; k += kQuad)
      for (std::size_t a = k + 1; a < k + kQuad; ++a) q[a] += x[a];
    std::fill_n(x, reals, Real(0));
  });
}

/// Lets held nodes stick or slip as their contacts' impulses ask; direction = the velocity that sticking
/// takes. False where nothing changes.
template <class Real>
bool VelocitySolver<Real>::Run::settle_contacts() const {
  const double changes = sum_active([&](std::size_t index, std::size_t g) {
    Real* q = grid.node(g);
    Real* r = at(s.residual_, g);
    Real* p = at(s.direction_, g);
    std::fill_n(p, reals, Real(0));
    double changed = 0;
    for (HeldNode& h : s.held_[index]) {
      const int k = h.node * kQuad;
      const auto mass = static_cast<double>(q[k]);
      // What the equations lack, M (v + dt g) + dt f - (M + beta dt^2 K) u, the contact must take.
      const Vec3 left = quad_vector(r + k, dim);
      const Vec3 v = quad_vector(q + k, dim);
      const std::optional<Hold::Change> change = h.hold.settle(v, -left / mass);
      if (!change) continue;
      changed += 1;
      put_quad_vector(r + k, dim, left + mass * change->friction);
      put_quad_vector(q + k, dim, v + change->velocity);
      put_quad_vector(p + k, dim, change->velocity);
    }
    return changed;
  });
  return changes > 0;
}

/// The increments u - v.
template <class Real>
void VelocitySolver<Real>::Run::finish() const {
  for_active([&](std::size_t, std::size_t g) {
    const Real* q = grid.node(g);
    if (Real* increment = grid.increment(g); increment != nullptr)
      for (std::size_t k = 0; k < reals; k += kQuad)
        for (std::size_t a = k + 1; a < k + kQuad; ++a) increment[a] += q[a];
  });
}

template <class Real>
std::size_t VelocitySolver<Real>::bytes() const {
  return (residual_.capacity() + change_.capacity() + direction_.capacity() + product_.capacity()) *
         sizeof(Real);
}

template class VelocitySolver<float>;
template class VelocitySolver<double>;

}  // namespace lather::mpm
