#include "bake/closed_mesh.h"

#include <bit>

#include "shadow/light_samples.h"

namespace penumbra::bake {
namespace {

std::uint64_t hash_of(const Vec3& p) {
  // Adding zero makes −0 into 0.
  const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x + 0.0f)}; };
  return hash(bits(p.x) | bits(p.y) << 32, bits(p.z));
}

}  // namespace

int outer_side(const Mesh& mesh) {
  thread_local std::vector<std::uint64_t> places;
  places.clear();
  for (const Vec3& p : mesh.positions) places.push_back(hash_of(p));
  std::uint64_t boundary = 0;
  double volume = 0;
  const Vec3d origin(mesh.positions.empty() ? Vec3() : mesh.positions.front());
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = places[mesh.indices[t + k]],
                          b = places[mesh.indices[t + (k + 1) % 3]];
      if (a != b) boundary += a < b ? hash(a, b) : -hash(b, a);
    }
    const auto corner = [&](std::size_t k) {
      return Vec3d(mesh.positions[mesh.indices[t + k]]) - origin;
    };
    volume += dot(corner(0), cross(corner(1), corner(2)));
  }
  if (boundary != 0 || volume == 0) return 0;
  return volume > 0 ? 1 : -1;
}

}  // namespace penumbra::bake
