// Compiled once per kernel level and precision: LATHER_LEVEL (v2, v3, v4) names the namespace, LATHER_REAL
// the type, LATHER_TABLE the function that hands the table out.

#include "sim/study/bench/peak_kernels.h"

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {
namespace {

using Packet = Lane<LATHER_REAL>::Packet;
constexpr int kPacket = Lane<LATHER_REAL>::kPacket;
/// Two units with results after four cycles need eight chains; with factor and term ten fill the twelve of 16
/// registers.
constexpr int kChains = 10;

LATHER_REAL total(const Packet* packets, int count) {
  LATHER_REAL sum = 0;
  for (int i = 0; i < count; ++i) sum += Eigen::internal::predux(packets[i]);
  return sum;
}

LATHER_REAL multiply_add(std::int64_t repeats, LATHER_REAL factor, LATHER_REAL term) {
  const Packet a = Eigen::internal::pset1<Packet>(factor);
  const Packet b = Eigen::internal::pset1<Packet>(term);
  Packet chain[kChains];
  for (int i = 0; i < kChains; ++i) chain[i] = Eigen::internal::pset1<Packet>(LATHER_REAL(i));
  for (std::int64_t r = 0; r < repeats; ++r)
    for (Packet& c : chain) c = c * a + b;
  return total(chain, kChains);
}

LATHER_REAL sum(const LATHER_REAL* from, std::int64_t count) {
  constexpr int kSums = 8;
  Packet sums[kSums];
  for (Packet& s : sums) s = Eigen::internal::pset1<Packet>(LATHER_REAL(0));
  for (std::int64_t i = 0; i < count; i += kSums * kPacket)
    for (int k = 0; k < kSums; ++k)
      sums[k] = sums[k] + Eigen::internal::ploadu<Packet>(from + i + k * kPacket);
  return total(sums, kSums);
}

}  // namespace
}  // namespace lather::LATHER_LEVEL

namespace lather::study {

const PeakKernels<LATHER_REAL>& LATHER_TABLE();
const PeakKernels<LATHER_REAL>& LATHER_TABLE() {
  static const PeakKernels<LATHER_REAL> table = {2 * LATHER_LEVEL::kChains * LATHER_LEVEL::kPacket,
                                                 LATHER_LEVEL::multiply_add, LATHER_LEVEL::sum};
  return table;
}

}  // namespace lather::study
