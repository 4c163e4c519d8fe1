#include "tests/scenes/snowball.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>

#include "tests/scenes/clusters.h"
#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

const Body& body_of(const Scene& scene, const std::string& name) {
  return *std::find_if(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& body) { return body.name == name; });
}

/// The ball, followed by its points, and the snow that it picks up.
class Ball {
 public:
  Ball(const Scene& scene, const Simulation& at_start)
      : spacing_(scene.spacing), layer_(body_of(scene, "layer")) {
    const Body& ball = body_of(scene, "ball");
    const Box3 box = bounds(*ball.shape, scene.domain.box);
    radius_ = 0.5 * box.extent().x();
    const auto& slope = std::get<PlacedShape>(layer_.shape->kind);
    up_ = slope.rotation * Vec3::UnitY();
    end_ = bounds(*layer_.shape, scene.domain.box).max.x() - radius_;
    // Jitter takes points out of the form by less than a spacing, and the stack is further off.
    at_start.visit_points([&](const PointState& p) {
      if (scene.materials[p.material].name == ball.material &&
          distance(*ball.shape, p.position) < scene.spacing)
        own_.insert(p.id);
    });
    bonds_ = bonds_of(own_, at_start);
    for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
      if (scene.materials[m].name == layer_.material) fresh_ = m;
  }

  void follow(const Simulation& simulation) {
    middle_ = Vec3::Zero();
    simulation.visit_points([&](const PointState& p) {
      if (is_own(p)) middle_ += p.position / static_cast<double>(own_.size());
    });
  }
  [[nodiscard]] bool on_slope() const { return middle_.x() < end_; }

  /// Over the ball's own mass, as all snow has one density.
  [[nodiscard]] double grown(const Simulation& simulation) const {
    double count = 0;
    simulation.visit_points([&](const PointState& p) { count += rides(p, 0) ? 1 : 0; });
    return count / static_cast<double>(own_.size());
  }
  [[nodiscard]] double whole(const Simulation& simulation) const {
    return pieces(simulation, bonds_).share(0);
  }
  /// Ball and the snow around it, without what lies under it.
  [[nodiscard]] Bonds rolling(const Simulation& simulation) const {
    std::set<std::uint32_t> ids = own_;
    simulation.visit_points([&](const PointState& p) {
      if (rides(p, -radius_)) ids.insert(p.id);
    });
    return bonds_of(ids, simulation);
  }
  [[nodiscard]] Clusters pieces(const Simulation& simulation, const Bonds& bonds) const {
    return find_pieces(simulation, 2 * spacing_, bonds);
  }

 private:
  [[nodiscard]] Bonds bonds_of(const std::set<std::uint32_t>& ids, const Simulation& simulation) const {
    return find_bonds(simulation, 1.5 * spacing_, [&](const PointState& p) { return ids.count(p.id) != 0; });
  }
  [[nodiscard]] bool is_own(const PointState& p) const { return own_.count(p.id) != 0; }
  [[nodiscard]] bool rides(const PointState& p, double above) const {
    const Vec3 from = p.position - middle_;
    return p.material == fresh_ && from.norm() < 2.2 * radius_ && from.dot(up_) > above;
  }

  double spacing_;
  const Body& layer_;
  std::uint32_t fresh_ = 0;
  double radius_ = 0;
  double end_ = 0;
  Vec3 up_ = Vec3::UnitY();
  Vec3 middle_ = Vec3::Zero();
  std::set<std::uint32_t> own_;
  Bonds bonds_;
};

}  // namespace

Roll run_roll(const std::string& size, const std::vector<Override>& overrides, int threads) {
  const Scene scene = scene_file("snowball", size, overrides);
  std::optional<Ball> ball;
  std::vector<double> grown;
  Bonds rolled;
  Roll roll;
  run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    if (frame == 0) ball.emplace(scene, simulation);
    ball->follow(simulation);
    if (ball->on_slope()) {
      grown.push_back(ball->grown(simulation));
      roll.whole = ball->whole(simulation);
      rolled = ball->rolling(simulation);
    }
    if (frame < scene.last_frame()) return;
    const Clusters left = ball->pieces(simulation, rolled);
    while (left.share(roll.pieces) >= 0.02) ++roll.pieces;
    roll.largest = left.share(0);
  });
  for (std::size_t third = 0; third < 3; ++third)
    roll.grown[third] = grown[(grown.size() - 1) * (third + 1) / 3];
  std::printf("  picked up %.3f, %.3f, %.3f of the ball's mass; of the ball in one piece %.3f\n",
              roll.grown[0], roll.grown[1], roll.grown[2], roll.whole);
  std::printf("  %zu pieces after the crash, the largest %.3f\n", roll.pieces, roll.largest);
  return roll;
}

}  // namespace lather::testing_support
