#include "sim/mpm/probe_tally.h"

#include <algorithm>
#include <cmath>

#include "sim/math/parallel.h"

namespace lather::mpm {

PlaneFrame::PlaneFrame(const PlaneProbe& probe, int dimension) : probe_(probe), normal_(probe.normal) {
  if (dimension == 2) normal_.z() = 0;
  normal_.normalize();
  if (!probe.along) return;
  along_ = *probe.along - normal_ * normal_.dot(*probe.along);
  along_.normalize();
  across_ = normal_.cross(along_);
}

bool PlaneFrame::covers(const Vec3& x) const {
  const Vec3 r = x - probe_.point;
  const Vec3 flat = r - normal_ * normal_.dot(r);
  if (probe_.radius > 0) return flat.squaredNorm() <= probe_.radius * probe_.radius;
  if (probe_.size.x() <= 0) return true;
  return std::abs(flat.dot(along_)) <= 0.5 * probe_.size.x() &&
         std::abs(flat.dot(across_)) <= 0.5 * probe_.size.y();
}

std::size_t obstacle_index(const Scene& scene, const std::string& name) {
  std::size_t i = 0;
  while (scene.obstacles[i].name != name) ++i;
  return i;
}

Vec3 torque_point(const ForceProbe& probe, const Obstacle& obstacle, double t) {
  const auto* placed = std::get_if<PlacedShape>(&obstacle.shape->kind);
  const Vec3 origin = placed != nullptr ? placed->translate : Vec3(Vec3::Zero());
  const Pose pose = pose_at(obstacle.motion, t);
  return pose.rotation * probe.about.value_or(origin) + pose.translation;
}

ProbeTally::ProbeTally(const Scene& scene, int threads)
    : scene_(scene), places_before_(static_cast<std::size_t>(threads)) {
  watched_.slot.assign(scene.obstacles.size() + 1, -1);
  for (const Probe& p : scene.probes) {
    std::int32_t* slot = nullptr;
    if (const auto* force = std::get_if<ForceProbe>(&p.kind))
      slot = &watched_.slot[obstacle_index(scene, force->obstacle)];
    if (std::holds_alternative<WallProbe>(p.kind)) slot = &watched_.slot.back();
    if (slot != nullptr && *slot < 0) *slot = static_cast<std::int32_t>(watched_.count++);
    if (const auto* plane = std::get_if<PlaneProbe>(&p.kind)) planes_.emplace_back(*plane, scene.dimension);
  }
}

void ProbeTally::begin_step(std::size_t grid_blocks, std::size_t point_blocks) {
  grid_loads_.assign(grid_blocks * watched_.count, {});
  point_loads_.assign(point_blocks * watched_.count, {});
  crossed_.assign(point_blocks * planes_.size(), 0);
}

template <class Real>
void ProbeTally::before_move(const ParticleSet<Real>& set, const BlockRange& range) {
  std::vector<Vec3>& places = places_before_[static_cast<std::size_t>(thread_index())];
  places.clear();
  // Points may be a cell and a half outside their block's cells, and move by one more.
  const double h = scene_.spacing;
  Vec3 middle = Vec3::Zero();
  Vec3 half = Vec3::Zero();
  for (int a = 0; a < scene_.dimension; ++a) {
    middle[a] = scene_.domain.box.min[a] + (range.block[static_cast<std::size_t>(a)] * 4 + 2) * h;
    half[a] = 4.5 * h;
  }
  const bool near = std::any_of(planes_.begin(), planes_.end(), [&](const PlaneFrame& plane) {
    return std::abs(plane.height(middle)) <= plane.reach(half);
  });
  if (!near) return;
  for (int i = 0; i < range.count; ++i) places.push_back(set.position(range.tile_of(i), i % kTile));
}

template <class Real>
void ProbeTally::after_move(const ParticleSet<Real>& set, const BlockRange& range, double mass,
                            std::size_t block) {
  const std::vector<Vec3>& places = places_before_[static_cast<std::size_t>(thread_index())];
  if (places.empty()) return;
  for (int i = 0; i < range.count; ++i) {
    const Vec3& from = places[static_cast<std::size_t>(i)];
    const Vec3 to = set.position(range.tile_of(i), i % kTile);
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      const double before = planes_[p].height(from);
      const double after = planes_[p].height(to);
      if ((before > 0) == (after > 0)) continue;
      const double part = before / (before - after);  // of the way to the plane
      if (planes_[p].covers(from + part * (to - from)))
        crossed_[block * planes_.size() + p] +=
            (after > 0 ? mass : -mass) * set.share(range.tile_of(i), i % kTile);
    }
  }
}

ContactLoad ProbeTally::total(std::size_t slot) const {
  ContactLoad sum;
  for (const std::vector<ContactLoad>* loads : {&grid_loads_, &point_loads_})
    for (std::size_t i = slot; i < loads->size(); i += watched_.count) sum += (*loads)[i];
  return sum;
}

void ProbeTally::end_step(double time, std::vector<ProbeState>& probes) const {
  const auto add = [&](std::size_t contact, const Vec3& about, ProbeState& to) {
    const ContactLoad load = total(static_cast<std::size_t>(watched_.slot[contact]));
    to.load += {load.impulse, load.moment_about(about)};
  };
  std::size_t plane = 0;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const auto& kind = scene_.probes[p].kind;
    if (const auto* force = std::get_if<ForceProbe>(&kind)) {
      const std::size_t which = obstacle_index(scene_, force->obstacle);
      add(which, torque_point(*force, scene_.obstacles[which], time), probes[p]);
    } else if (const auto* walls = std::get_if<WallProbe>(&kind)) {
      add(scene_.obstacles.size(), walls->about, probes[p]);
    } else if (std::holds_alternative<PlaneProbe>(kind)) {
      for (std::size_t i = plane; i < crossed_.size(); i += planes_.size()) probes[p].passed += crossed_[i];
      ++plane;
    }
  }
}

template void ProbeTally::before_move(const ParticleSet<float>&, const BlockRange&);
template void ProbeTally::before_move(const ParticleSet<double>&, const BlockRange&);
template void ProbeTally::after_move(const ParticleSet<float>&, const BlockRange&, double, std::size_t);
template void ProbeTally::after_move(const ParticleSet<double>&, const BlockRange&, double, std::size_t);

}  // namespace lather::mpm
