#include "bake/glb_buffer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace penumbra::bake {
namespace {

// glTF 2.0, section 3.6.2.2 and 5.1.
constexpr int unsigned_short = 5123, unsigned_int = 5125, float_type = 5126;
constexpr int array_buffer = 34962, element_array_buffer = 34963;

Json::Value array_of(const Vec3& v) {
  Json::Value a(Json::arrayValue);
  for (int i = 0; i < 3; ++i) a.append(static_cast<double>(v[i]));
  return a;
}

}  // namespace

int GlbBuffer::view(const void* data, std::size_t size, Use use, int stride) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  Json::Value view;
  view["buffer"] = 0;
  view["byteOffset"] = static_cast<Json::UInt64>(bytes_.size());
  view["byteLength"] = static_cast<Json::UInt64>(size);
  if (use != Use::none) view["target"] = use == Use::indices ? element_array_buffer : array_buffer;
  if (stride > 0) view["byteStride"] = stride;
  bytes_.append(static_cast<const char*>(data), size);
  views_.append(view);
  return static_cast<int>(views_.size()) - 1;
}

int GlbBuffer::accessor(int view, int component_type, const char* type, std::size_t count) {
  Json::Value a;
  a["bufferView"] = view;
  a["componentType"] = component_type;
  a["type"] = type;
  a["count"] = static_cast<Json::UInt64>(count);
  accessors_.append(a);
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbBuffer::add_vectors(std::span<const Vec3> values) {
  return accessor(view(values.data(), values.size_bytes(), Use::vertices), float_type, "VEC3",
                  values.size());
}

int GlbBuffer::add_positions(std::span<const Vec3> values) {
  const int index = add_vectors(values);
  Bounds box;
  for (const Vec3& p : values) box.grow(p);
  Json::Value& a = accessors_[static_cast<Json::ArrayIndex>(index)];
  a["min"] = array_of(box.lo), a["max"] = array_of(box.hi);
  return index;
}

int GlbBuffer::add_uvs(std::span<const Vec2> values) {
  return accessor(view(values.data(), values.size_bytes(), Use::vertices), float_type, "VEC2",
                  values.size());
}

int GlbBuffer::add_colors(std::span<const Vec3> values) {
  std::vector<std::uint16_t> codes;
  for (const Vec3& color : values) {
    for (int c = 0; c < 3; ++c)
      codes.push_back(static_cast<std::uint16_t>(std::clamp(color[c], 0.0f, 1.0f) * 65535 + 0.5f));
    codes.push_back(65535);
  }
  const int index = accessor(view(codes.data(), 2 * codes.size(), Use::vertices), unsigned_short,
                             "VEC4", values.size());
  accessors_[static_cast<Json::ArrayIndex>(index)]["normalized"] = true;
  return index;
}

int GlbBuffer::add_indices(std::span<const std::uint32_t> values, std::size_t vertices) {
  // 65535 itself restarts primitives.
  if (vertices > 65535)
    return accessor(view(values.data(), values.size_bytes(), Use::indices), unsigned_int, "SCALAR",
                    values.size());
  const std::vector<std::uint16_t> narrow(values.begin(), values.end());
  return accessor(view(narrow.data(), 2 * narrow.size(), Use::indices), unsigned_short, "SCALAR",
                  values.size());
}

int GlbBuffer::add_view(std::string_view bytes) {
  return view(bytes.data(), bytes.size(), Use::none);
}

}  // namespace penumbra::bake
