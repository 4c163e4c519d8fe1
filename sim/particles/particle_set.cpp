#include "sim/particles/particle_set.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "sim/math/determinant.h"

namespace lather {

template <class Real>
ParticleSet<Real>::ParticleSet(int dimension, const std::vector<Field>& fields, const Vec3& origin,
                               double cell)
    : dimension_(dimension), origin_(origin), cell_(cell), layout_(make_layout<Real>(dimension, fields)) {}

template <class Real>
PointSlot ParticleSet<Real>::add(const Vec3& position, const Vec3& velocity, const Mat3& velocity_gradient,
                                 std::uint32_t id) {
  const PointSlot slot = {next_ / kTile, static_cast<int>(next_ % kTile)};
  const auto [t, lane] = slot;
  if (lane == 0) {
    lines_.resize(lines_.size() + static_cast<std::size_t>(layout_.stride) / sizeof(Line));
    std::fill_n(values<std::uint32_t>(t, Field::kId), kTile, kNoPoint);
  }
  place(slot, position);
  for (int a = 0; a < dimension_; ++a) {
    values<Real>(t, Field::kVelocity, a)[lane] = static_cast<Real>(velocity[a]);
    if (layout_.has(Field::kAffine))
      for (int b = 0; b < dimension_; ++b)
        values<Real>(t, Field::kAffine, a * dimension_ + b)[lane] =
            static_cast<Real>(velocity_gradient(a, b));
  }
  if (layout_.has(Field::kShare)) values<Real>(t, Field::kShare)[lane] = Real(1);
  values<std::uint32_t>(t, Field::kId)[lane] = id;
  ++next_;
  ++size_;
  return slot;
}

template <class Real>
void ParticleSet<Real>::remove(const PointSlot& slot) {
  values<std::uint32_t>(slot.tile, Field::kId)[slot.lane] = kNoPoint;
  --size_;
  ranges_.clear();
}

template <class Real>
void ParticleSet<Real>::place(const PointSlot& slot, const Vec3& position) {
  constexpr std::int64_t kQuanta = std::int64_t{1} << FixedPoint<Real>::kBits;
  for (int a = 0; a < dimension_; ++a) {
    const double x = (position[a] - origin_[a]) / cell_;
    const double whole = std::floor(x);
    const auto quanta = static_cast<std::int64_t>((x - whole) * static_cast<double>(kQuanta));
    values<Word>(slot.tile, Field::kFraction, a)[slot.lane] =
        static_cast<Word>(std::min(quanta, kQuanta - 1));
    values<std::int16_t>(slot.tile, Field::kCell, a)[slot.lane] = static_cast<std::int16_t>(whole);
  }
  ranges_.clear();
}

template <class Real>
Vec3 ParticleSet<Real>::position(std::size_t t, int lane) const {
  constexpr double kQuantum = 1.0 / static_cast<double>(std::int64_t{1} << FixedPoint<Real>::kBits);
  Vec3 x = Vec3::Zero();
  for (int a = 0; a < dimension_; ++a) {
    const double fraction = static_cast<double>(values<Word>(t, Field::kFraction, a)[lane]) * kQuantum;
    x[a] = origin_[a] + (values<std::int16_t>(t, Field::kCell, a)[lane] + fraction) * cell_;
  }
  return x;
}

template <class Real>
Vec3 ParticleSet<Real>::velocity(std::size_t t, int lane) const {
  Vec3 v = Vec3::Zero();
  for (int a = 0; a < dimension_; ++a) v[a] = static_cast<double>(values<Real>(t, Field::kVelocity, a)[lane]);
  return v;
}

template <class Real>
Mat3 ParticleSet<Real>::deformation_change(std::size_t t, int lane) const {
  Mat3 G = Mat3::Zero();
  if (!layout_.has(Field::kDeformation)) return G;
  const auto at = [&](int c) { return static_cast<double>(values<Real>(t, Field::kDeformation, c)[lane]); };
  const int d = dimension_;
  for (int a = 0; a < d; ++a)
    for (int b = 0; b < d; ++b) G(a, b) = at(d * a + b);
  if (d == 2) G(2, 2) = at(4);
  return G;
}

template <class Real>
double ParticleSet<Real>::volume_change(std::size_t t, int lane) const {
  if (layout_.has(Field::kVolumeChange))
    return static_cast<double>(values<Real>(t, Field::kVolumeChange)[lane]);
  const double elastic = determinant_change(deformation_change(t, lane));
  const double plastic = plastic_volume_change(t, lane);
  return elastic + plastic + elastic * plastic;
}

template <class Real>
void ParticleSet<Real>::save(std::string& to) const {
  const auto put = [&to](const void* from, std::size_t n) { to.append(static_cast<const char*>(from), n); };
  const std::uint64_t head[5] = {size_, lines_.size(), ranges_.size(),
                                 static_cast<std::uint64_t>(layout_.stride), next_};
  put(head, sizeof head);
  put(ranges_.data(), ranges_.size() * sizeof(BlockRange));
  put(lines_.data(), bytes());
}

template <class Real>
void ParticleSet<Real>::restore(const char*& from, const char* end) {
  const auto get = [&](void* to, std::size_t n) {
    if (static_cast<std::size_t>(end - from) < n) throw std::runtime_error("The checkpoint ends too early.");
    if (n > 0) std::memcpy(to, from, n);  // an empty set has no memory to copy to
    from += n;
  };
  std::uint64_t head[5];
  get(head, sizeof head);
  const auto left = static_cast<std::uint64_t>(end - from);
  if (head[3] != static_cast<std::uint64_t>(layout_.stride) || head[1] > left / sizeof(Line) ||
      head[2] > left / sizeof(BlockRange))
    throw std::runtime_error("The checkpoint was written for other particle fields.");
  size_ = head[0];
  next_ = head[4];
  lines_.resize(head[1]);
  ranges_.resize(head[2]);
  get(ranges_.data(), ranges_.size() * sizeof(BlockRange));
  get(lines_.data(), bytes());
}

template class ParticleSet<float>;
template class ParticleSet<double>;

}  // namespace lather
