#include "scene/mesh/weld.h"

#include <bit>
#include <cassert>

namespace penumbra {
namespace {

using Triple = std::array<std::uint32_t, 3>;

/// The finaliser of splitmix64 (Steele, Lea and Flood 2014, Fast Splittable Pseudorandom Number
/// Generators).
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::uint64_t hash(const Triple& key) {
  return mix(mix(std::uint64_t{key[0]} << 32 | key[1]) + 0x9e3779b97f4a7c15u + key[2]);
}

std::uint32_t bits_of(float f) { return std::bit_cast<std::uint32_t>(f + 0.0f); }  // −0 + 0 is 0

/// `key_of(i)` is the value of item i.
template <class KeyOf>
Weld weld(std::size_t count, const KeyOf& key_of) {
  assert(count < (std::size_t{1} << 31));
  constexpr std::uint32_t empty = 0xffffffffu;
  Weld result;
  result.id.resize(count);
  std::vector<std::uint32_t> table(std::bit_ceil(2 * count + 2), empty);
  const std::size_t mask = table.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Triple key = key_of(i);
    std::size_t slot = hash(key) & mask;
    while (table[slot] != empty && key_of(result.first[table[slot]]) != key)
      slot = (slot + 1) & mask;
    if (table[slot] == empty) {
      table[slot] = static_cast<std::uint32_t>(result.first.size());
      result.first.push_back(static_cast<std::uint32_t>(i));
    }
    result.id[i] = table[slot];
  }
  return result;
}

}  // namespace

Weld weld_triples(std::span<const Triple> triples) {
  return weld(triples.size(), [&](std::size_t i) { return triples[i]; });
}

Weld weld_positions(std::span<const Vec3> positions) {
  return weld(positions.size(), [&](std::size_t i) {
    return Triple{bits_of(positions[i].x), bits_of(positions[i].y), bits_of(positions[i].z)};
  });
}

}  // namespace penumbra
