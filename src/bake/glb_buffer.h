// The buffer of a glTF file and the accessors into it.
#pragma once

#include <json/value.h>

#include <span>
#include <string>

#include "base/vec.h"

namespace penumbra::bake {

/// Collects bytes, bufferViews and accessors; each call that adds returns an index.
class GlbBuffer {
 public:
  int add_positions(std::span<const Vec3> values);  ///< with min and max
  int add_vectors(std::span<const Vec3> values);
  int add_uvs(std::span<const Vec2> values);
  int add_colors(std::span<const Vec3> values);  ///< normalised, 16 bits, with alpha 1
  int add_indices(std::span<const std::uint32_t> values, std::size_t vertices);
  int add_view(std::string_view bytes);  ///< of an image: a bufferView

  const std::string& bytes() const { return bytes_; }
  const Json::Value& views() const { return views_; }
  const Json::Value& accessors() const { return accessors_; }

 private:
  enum class Use { none, vertices, indices };
  int view(const void* data, std::size_t size, Use use, int stride = 0);
  int accessor(int view, int component_type, const char* type, std::size_t count);

  std::string bytes_;
  Json::Value views_{Json::arrayValue}, accessors_{Json::arrayValue};
};

}  // namespace penumbra::bake
