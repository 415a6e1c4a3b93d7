// Typed access to the elements of a glTF accessor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/gltf/document.h"

namespace penumbra::gltf {

/// Throws InputError unless every element lies within the accessor's bufferViews (those of its
/// sparse part included). Overflow-safe: all counts are below 2^53, strides below 253.
void check_accessor(const Document& document, std::size_t accessor);

/// The elements of one accessor: strided in their buffer, or a packed copy where the accessor is
/// sparse or has no bufferView (zeros, then). Refers to the document's bytes.
class Elements {
 public:
  /// Throws InputError for a sparse part that refers to elements that are not there, and for
  /// copies beyond the document's budget.
  Elements(Document& document, int accessor);
  Elements(Elements&&) = default;
  Elements(const Elements&) = delete;

  std::size_t count() const { return count_; }
  int components() const { return components_; }
  int component_type() const { return component_type_; }

  /// The components of element i as numbers; integers are mapped to [0, 1] or [−1, 1] if the
  /// accessor is normalised (glTF 2.0, section 3.6.2.2). i is not checked.
  void get(std::size_t i, float* out) const;
  /// The first component of element i, of an unsigned integer type.
  std::uint32_t get_index(std::size_t i) const;

 private:
  void copy_dense(const tinygltf::Accessor& accessor, std::size_t size);
  void apply_sparse(const Document& document, const tinygltf::Accessor& accessor,
                    const std::string& path, std::size_t size);

  std::size_t count_ = 0, stride_ = 0;
  int components_ = 0, component_type_ = 0;
  bool normalized_ = false;
  const char* data_ = nullptr;
  std::vector<char> owned_;
};

}  // namespace penumbra::gltf
