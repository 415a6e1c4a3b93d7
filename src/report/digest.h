// Numbers that tell whether bytes are the same as before.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "render/hash.h"
#include "scene/scene.h"

namespace penumbra::report {

/// A running checksum of 64 bits. It finds damage and change; it is no defence against forgery.
class Digest {
 public:
  void add_bytes(const void* bytes, std::size_t size);
  void add(std::string_view text) { add_bytes(text.data(), text.size()); }
  template <class T, class = std::enable_if_t<std::is_arithmetic_v<T> || std::is_enum_v<T>>>
  void add(T value) {
    add_bytes(&value, sizeof value);
  }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  /// Elements without padding.
  template <class T>
  void add(const std::vector<T>& values) {
    add_bytes(values.data(), values.size() * sizeof(T));
  }

  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

/// Of what a picture of the scene depends on: surfaces, materials, textures, lights, cameras.
std::uint64_t digest_of(const Scene& scene);

}  // namespace penumbra::report
