#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/collide/contact_sink.h"
#include "sim/collide/hold.h"
#include "sim/frame.h"
#include "sim/scene/scene.h"

/// Contact with obstacles and with the walls of the domain, on velocities [Foam E.3 steps 6 and 13,
/// Algorithms 10 and 16; Stomakhin et al. 2013, section 8].
namespace lather {

/// All obstacles of a scene at one step. Const after place(): safe to share between threads.
class Obstacles {
 public:
  /// `spacing`: the grid's cell width, m; normals are differences over a hundredth of it.
  Obstacles(const Scene& scene, double spacing);

  /// Puts the obstacles where they are at `time`, with the mean velocity of the step that follows, `dt` long
  /// (s).
  void place(double time, double dt);

  [[nodiscard]] bool none() const { return all_.empty(); }

  /// Indices of the obstacles that reach into the ball of `radius` around `center`, into `near` (cleared
  /// first).
  void find_near(const Vec3& center, double radius, std::vector<std::uint32_t>& near) const;

  /// Signed distance of `x` from an obstacle of find_near(), m; negative inside.
  [[nodiscard]] double distance_from(std::uint32_t obstacle, const Vec3& x) const;

  /// Velocity of a node or point at `x` after contact with the obstacles `near`; true if it was changed.
  ///
  /// Inside an adhesive obstacle the velocity becomes the obstacle's. Else, with v_rel = v - v_co and outward
  /// normal n: separating (v_rel . n >= 0) stays; the normal part is removed; the tangential part loses mu_f
  /// |v_n|, or all. What `mass` (kg) loses goes to `sink`. A ball of `radius` (m) around `x` counts as inside
  /// as soon as it touches.
  bool resolve(const std::vector<std::uint32_t>& near, const Vec3& x, Vec3& velocity, double mass,
               const ContactSink& sink, double radius = 0) const;

  /// Adds to `hold` what contact with the obstacles `near` prescribes of the velocity at `x`, for a node that
  /// would move with `velocity` without them: the same contacts as resolve() finds.
  void hold(const std::vector<std::uint32_t>& near, const Vec3& x, const Vec3& velocity, Hold& hold) const;

 private:
  /// An obstacle that holds a place inside it.
  struct Touch {
    const Obstacle* source;
    Vec3 velocity;  // of the obstacle there
    Vec3 normal;    // outward; not set for adhesive obstacles
  };
  [[nodiscard]] std::optional<Touch> touch(std::uint32_t obstacle, const Vec3& x, double radius) const;
  /// The velocity after contact; none where the two separate.
  [[nodiscard]] static std::optional<Vec3> after_contact(const Touch& t, const Vec3& velocity);

  struct Placed {
    const Obstacle* source;
    Vec3 middle;                // of a ball around the shape, in its own frame
    double reach;               // m, radius of that ball; infinite for a shape without bounds
    Vec3 place = Vec3::Zero();  // of the ball's middle at the present time
    Pose pose;
    Vec3 velocity_at_origin = Vec3::Zero();
    Mat3 velocity_gradient = Mat3::Zero();
  };
  [[nodiscard]] static Vec3 to_local(const Placed& o, const Vec3& x) {
    return o.pose.rotation.conjugate() * (x - o.pose.translation);
  }

  std::vector<Obstacle> scene_obstacles_;
  std::vector<Placed> all_;
  double normal_step_;
  bool flat_;  // 2D: normals lie in the plane
};

/// The faces of the domain that are neither periodic nor open.
class Walls {
 public:
  explicit Walls(const Scene& scene);

  /// True when some face lies within `margin` of the box [low, high].
  [[nodiscard]] bool near(const Vec3& low, const Vec3& high, double margin) const;

  /// Calls visit(distance) for each face: how far `x` lies before it, m; negative beyond.
  template <class Visit>
  void for_faces(const Vec3& x, const Visit& visit) const {
    for (int a = 0; a < dimension_; ++a) {
      if (!closed_[static_cast<std::size_t>(a)]) continue;
      visit(x[a] - box_.min[a]);
      visit(box_.max[a] - x[a]);
    }
  }

  /// False beyond a face that is not periodic.
  [[nodiscard]] bool inside(const Vec3& x) const;

  /// Velocity at `x` after contact: beyond a slip face nothing goes on outward, beyond a stick face nothing
  /// moves. A ball of `radius` (m) around `x` counts as beyond as soon as it touches. What would touch a face
  /// within `ahead` (s) comes to it just then, so that a point that moves for so long never leaves the
  /// domain.
  bool resolve(const Vec3& x, Vec3& velocity, double mass, const ContactSink& sink, double radius = 0,
               double ahead = 0) const;

  /// The same for a step that solves for velocities; see Obstacles::hold().
  void hold(const Vec3& x, const Vec3& velocity, Hold& hold) const;

 private:
  bool touch(const Vec3& x, Vec3& velocity, double radius, double ahead) const;

  Box3 box_;
  int dimension_;
  std::size_t index_;  // behind the obstacles', in a sink
  bool stick_;
  std::array<bool, 3> closed_{};
  std::array<bool, 3> periodic_{};
  double tolerance_;  // a node on the face counts as beyond it
};

}  // namespace lather
