#include "scene/mesh/weld.h"

#include <bit>
#include <cassert>

namespace penumbra {
namespace {

constexpr std::uint32_t kEmpty = 0xffffffffu;

std::uint64_t bits_of(float f) { return std::bit_cast<std::uint32_t>(f + 0.0f); }  // −0 + 0 is 0

/// The finaliser of splitmix64 (Steele, Lea and Flood 2014), chained over the components.
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::uint64_t hash(const Vec3& p) {
  return mix(mix(bits_of(p.x) << 32 | bits_of(p.y)) + 0x9e3779b97f4a7c15u + bits_of(p.z));
}

bool same(const Vec3& a, const Vec3& b) {
  return bits_of(a.x) == bits_of(b.x) && bits_of(a.y) == bits_of(b.y) &&
         bits_of(a.z) == bits_of(b.z);
}

}  // namespace

Weld weld_positions(std::span<const Vec3> positions) {
  assert(positions.size() < (std::size_t{1} << 31));
  Weld weld;
  weld.id.resize(positions.size());
  std::vector<std::uint32_t> table(std::bit_ceil(2 * positions.size() + 2), kEmpty);
  const std::size_t mask = table.size() - 1;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    std::size_t slot = hash(positions[i]) & mask;
    while (table[slot] != kEmpty && !same(positions[weld.first[table[slot]]], positions[i]))
      slot = (slot + 1) & mask;
    if (table[slot] == kEmpty) {
      table[slot] = static_cast<std::uint32_t>(weld.first.size());
      weld.first.push_back(static_cast<std::uint32_t>(i));
    }
    weld.id[i] = table[slot];
  }
  return weld;
}

}  // namespace penumbra
