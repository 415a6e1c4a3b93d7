// Numbers that look random and are not: the same pixel and seed give the same picture.
#pragma once

#include <cstdint>

namespace penumbra {

/// A bijective scrambling of 64 bits: the finaliser of SplitMix64
/// (Steele, Lea, Flood 2014, Fast Splittable Pseudorandom Number Generators, figure 16).
constexpr std::uint64_t mix64(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// One number for two.
constexpr std::uint64_t mix64(std::uint64_t a, std::uint64_t b) { return mix64(mix64(a) ^ b); }

/// In [0, 1), from the upper 24 bits: every float of that spacing, never 1.
constexpr float unit_float(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

}  // namespace penumbra
