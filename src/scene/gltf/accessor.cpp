#include "scene/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace penumbra::gltf {
namespace {

std::size_t component_size(int type) {
  return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(type)));
}

std::size_t element_size(const tinygltf::Accessor& a) {
  return component_size(a.componentType) *
         static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<unsigned>(a.type)));
}

/// `count` elements in a bufferView, from `offset`.
struct Span {
  int view;
  std::size_t offset, count, size, stride;
};

void check_span(const Document& document, const std::string& path, const Span& s) {
  if (s.stride < s.size)
    throw document.json().error(
        path,
        fmt::format("byteStride of bufferViews[{}] is {}, less than the {} bytes of an element",
                    s.view, s.stride, s.size));
  const std::size_t length = document.bytes_of_view(s.view).size();
  const std::size_t end = s.offset + (s.count == 0 ? 0 : (s.count - 1) * s.stride + s.size);
  if (end > length)
    throw document.json().error(
        path, fmt::format("{} elements end at byte {} of bufferViews[{}], which has {}", s.count,
                          end, s.view, length));
}

std::size_t stride_of(const Document& document, const tinygltf::Accessor& a) {
  const std::size_t stride =
      document.model().bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride;
  return stride == 0 ? element_size(a) : stride;
}

template <class T>
T load(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

std::uint32_t load_unsigned(const char* at, int type) {
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return load<std::uint8_t>(at);
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load<std::uint16_t>(at);
  return load<std::uint32_t>(at);
}

template <class T>
float load_integer(const char* at, bool normalized) {
  const T value = load<T>(at);
  if (!normalized) return static_cast<float>(value);
  return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()),
                  -1.0f);
}

float load_component(const char* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return load_integer<std::int8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load_integer<std::uint8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return load_integer<std::int16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load_integer<std::uint16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load_integer<std::uint32_t>(at, normalized);
    default:
      return load<float>(at);
  }
}

std::string path_of(std::size_t accessor) { return fmt::format("accessors[{}]", accessor); }

Span sparse_indices(const tinygltf::Accessor& a) {
  const std::size_t size = component_size(a.sparse.indices.componentType);
  return {a.sparse.indices.bufferView, static_cast<std::size_t>(a.sparse.indices.byteOffset),
          static_cast<std::size_t>(a.sparse.count), size, size};
}

Span sparse_values(const tinygltf::Accessor& a) {
  return {a.sparse.values.bufferView, static_cast<std::size_t>(a.sparse.values.byteOffset),
          static_cast<std::size_t>(a.sparse.count), element_size(a), element_size(a)};
}

}  // namespace

void check_accessor(const Document& document, std::size_t accessor) {
  const tinygltf::Accessor& a = document.model().accessors[accessor];
  const std::string path = path_of(accessor);
  if (a.bufferView >= 0)
    check_span(document, path,
               {a.bufferView, a.byteOffset, a.count, element_size(a), stride_of(document, a)});
  if (!a.sparse.isSparse) return;
  if (static_cast<std::size_t>(a.sparse.count) > a.count)
    throw document.json().error(path + ".sparse.count",
                                fmt::format("{} of {} elements", a.sparse.count, a.count));
  check_span(document, path + ".sparse.indices", sparse_indices(a));
  check_span(document, path + ".sparse.values", sparse_values(a));
}

Elements::Elements(Document& document, int accessor) {
  const auto index = static_cast<std::size_t>(accessor);
  const tinygltf::Accessor& a = document.model().accessors[index];
  const std::size_t size = element_size(a);
  count_ = a.count;
  components_ = tinygltf::GetNumComponentsInType(static_cast<unsigned>(a.type));
  component_type_ = a.componentType;
  normalized_ = a.normalized;
  stride_ = size;
  if (a.bufferView >= 0) {
    data_ = document.bytes_of_view(a.bufferView).data() + a.byteOffset;
    stride_ = stride_of(document, a);
  }
  if (a.bufferView >= 0 && !a.sparse.isSparse) return;
  document.spend(count_ * size, path_of(index));
  copy_dense(a, size);
  if (a.sparse.isSparse) apply_sparse(document, a, path_of(index), size);
}

void Elements::copy_dense(const tinygltf::Accessor& a, std::size_t size) {
  owned_.assign(count_ * size, 0);
  if (a.bufferView >= 0)
    for (std::size_t i = 0; i < count_; ++i)
      std::memcpy(&owned_[i * size], data_ + i * stride_, size);
  data_ = owned_.data();
  stride_ = size;
}

void Elements::apply_sparse(const Document& document, const tinygltf::Accessor& a,
                            const std::string& path, std::size_t size) {
  const Span from = sparse_indices(a), values = sparse_values(a);
  const char* index = document.bytes_of_view(from.view).data() + from.offset;
  const char* value = document.bytes_of_view(values.view).data() + values.offset;
  for (std::size_t i = 0; i < from.count; ++i, index += from.stride, value += size) {
    const std::size_t at = load_unsigned(index, a.sparse.indices.componentType);
    if (at >= count_)
      throw document.json().error(
          path + ".sparse.indices",
          fmt::format("index {} is outside the {} elements of the accessor", at, count_));
    std::memcpy(&owned_[at * size], value, size);
  }
}

void Elements::get(std::size_t i, float* out) const {
  const std::size_t step = component_size(component_type_);
  const char* at = data_ + i * stride_;
  for (int c = 0; c < components_; ++c, at += step)
    out[c] = load_component(at, component_type_, normalized_);
}

std::uint32_t Elements::get_index(std::size_t i) const {
  return load_unsigned(data_ + i * stride_, component_type_);
}

}  // namespace penumbra::gltf
