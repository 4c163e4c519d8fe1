#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/math/vec.h"

namespace lather {

/// What contact gave to an obstacle; in 2D per metre of depth.
struct ContactLoad {
  Vec3 impulse = Vec3::Zero();  ///< N s
  Vec3 moment = Vec3::Zero();   ///< N m s, about the world's origin

  ContactLoad& operator+=(const ContactLoad& other);
  /// The moment about `point` instead.
  [[nodiscard]] Vec3 moment_about(const Vec3& point) const { return moment - point.cross(impulse); }
};

/// Which obstacles' loads are asked for: `slot[i]` is obstacle i's place in a row of loads, -1 for none; the
/// last entry is that of the domain's walls.
struct WatchedContacts {
  std::vector<std::int32_t> slot;
  std::size_t count = 0;  ///< loads in a row
};

/// Takes the changes of velocity that contact makes, for the obstacles that are watched. One block's alone.
class ContactSink {
 public:
  /// `loads`: a row for `watched`; null: nothing is taken.
  ContactSink(const WatchedContacts& watched, ContactLoad* loads) : watched_(watched), loads_(loads) {}

  /// The contact with obstacle `which` at `x` takes `lost` (m/s) from `mass` (kg).
  void take(std::size_t which, const Vec3& x, const Vec3& lost, double mass) const;

 private:
  const WatchedContacts& watched_;
  ContactLoad* loads_;
};

}  // namespace lather
