#include "sim/mpm/emission.h"

#include <algorithm>
#include <cmath>

#include "sim/plan/seed.h"

namespace lather::mpm {
namespace {

/// Part of an interval that a due time may lie after the state's time: times are sums of steps.
constexpr double kRounding = 1e-9;

/// True when occupies(x) holds for some point inside the box, which reaches `margin` beyond the shape.
template <class Real, class Occupies>
bool any_point(const State<Real>& state, const Scene& scene, const Shape& shape, double margin,
               const Occupies& occupies) {
  Box3 box = bounds(shape, scene.domain.box);
  box.min.array() -= margin;
  box.max.array() += margin;
  for (const ParticleSet<Real>& set : state.sets)
    for (std::size_t t = 0; t < set.tiles(); ++t)
      for (int lane = 0; lane < kTile; ++lane) {
        if (set.template values<std::uint32_t>(t, Field::kId)[lane] == kNoPoint) continue;
        const Vec3 x = set.position(t, lane);
        const auto d = static_cast<Eigen::Index>(scene.dimension);
        const bool inside = (x.head(d).array() >= box.min.head(d).array()).all() &&
                            (x.head(d).array() <= box.max.head(d).array()).all();
        if (inside && occupies(x)) return true;
      }
  return false;
}

/// True when some point is where the release's points would be, or closer than half their distance.
template <class Real>
bool occupied(const State<Real>& state, const Scene& scene, const Release& release) {
  const Shape& shape = *scene.emitters[release.emitter].shape;
  const double half = 0.5 * point_distance(scene);
  return any_point(state, scene, shape, half, [&](const Vec3& x) {
    // The stream itself stands one sweep ahead of its new layer; half a distance of lag is free.
    return distance(shape, x) < (release.layer ? 0 : half) &&
           (!release.layer || distance(shape, x - release.sweep) >= half);
  });
}

template <class Real>
void add_points(State<Real>& state, const Scene& scene, const Release& release) {
  EmitterState& own = state.emitters[release.emitter];
  seed_release(scene, release, [&](const Seed& s) {
    state.sets[s.material].add(s.position, s.velocity, s.velocity_gradient, state.next_id++);
    state.max_speed = std::max(state.max_speed, s.velocity.norm());
    ++state.points_emitted[s.material];
    ++own.points;
  });
  ++own.releases;
  state.sorted = false;
}

/// Releases now, or waits; `since` is how long the release has been due, s.
template <class Real>
bool release_or_wait(State<Real>& state, const Scene& scene, const Release& release, double since) {
  EmitterState& own = state.emitters[release.emitter];
  if (occupied(state, scene, release)) {
    if (!own.waiting) ++own.delayed;
    own.waiting = true;
    return false;
  }
  if (own.waiting) own.waited += since;
  own.waiting = false;
  add_points(state, scene, release);
  return true;
}

template <class Real>
void emit_copies(State<Real>& state, const Scene& scene, std::size_t e) {
  const Emitter& emitter = scene.emitters[e];
  const std::uint64_t number = state.emitters[e].releases;
  const double due = emitter.start + static_cast<double>(number) * emitter.interval;
  if (number >= static_cast<std::uint64_t>(emitter.count) || state.time < due - kRounding * emitter.interval)
    return;
  // One release a step: the next would find its place occupied by this one.
  release_or_wait(state, scene, Release::copy_of(e, number), state.time - due);
}

/// The shape's own fill first, then a layer each time the stream has moved by a distance of points. While its
/// place is occupied the stream's lattice stands still.
template <class Real>
void emit_stream(State<Real>& state, const Scene& scene, std::size_t e) {
  const Emitter& emitter = scene.emitters[e];
  EmitterState& own = state.emitters[e];
  if (state.time < emitter.start || state.time > emitter.end) return;
  if (own.releases == 0) {
    if (release_or_wait(state, scene, Release::copy_of(e, 0), state.time - emitter.start))
      own.last = state.time;
    return;
  }
  const double interval = layer_interval(scene, emitter);
  const double since = state.time - own.last;
  if (since < interval * (1 - kRounding)) return;
  const Release layer = {e, own.releases, emitter.velocity * (own.travelled + since),
                         emitter.velocity * since, true};
  if (release_or_wait(state, scene, layer, 0)) {
    own.travelled += since;
    own.last = state.time;
  } else {
    own.waited += since - interval;
    own.last = state.time - interval;
  }
}

}  // namespace

template <class Real>
void emit_due(State<Real>& state, const Scene& scene) {
  for (std::size_t e = 0; e < scene.emitters.size(); ++e) {
    if (scene.emitters[e].stream)
      emit_stream(state, scene, e);
    else
      emit_copies(state, scene, e);
  }
}

template void emit_due(State<float>&, const Scene&);
template void emit_due(State<double>&, const Scene&);

}  // namespace lather::mpm
