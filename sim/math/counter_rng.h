#pragma once

#include <cstdint>

namespace lather {

/// Counter-based random bits: the SplitMix64 finaliser (Steele, Lea and Flood 2014) chained over the key's
/// words. Depends on the key alone, never on the order or number of calls.
constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0) {
  std::uint64_t z = seed;
  for (const std::uint64_t word : {a, b}) {
    z += 0x9e3779b97f4a7c15U ^ word;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    z ^= z >> 31U;
  }
  return z;
}

/// Uniform in [0, 1).
constexpr double random_unit(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0) {
  return static_cast<double>(random_bits(seed, a, b) >> 11U) * 0x1p-53;
}

}  // namespace lather
