#include "sim/collide/contact_sink.h"

namespace lather {

ContactLoad& ContactLoad::operator+=(const ContactLoad& other) {
  impulse += other.impulse;
  moment += other.moment;
  return *this;
}

void ContactSink::take(std::size_t which, const Vec3& x, const Vec3& lost, double mass) const {
  if (loads_ == nullptr || watched_.slot[which] < 0) return;
  const Vec3 impulse = mass * lost;
  loads_[watched_.slot[which]] += {impulse, x.cross(impulse)};
}

}  // namespace lather
