// glTF files made by tests.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "scene/scene.h"

namespace penumbra::test {

std::string base64(const std::string& bytes);

/// Collects data; the rest of the document is written as JSON.
class GltfFile {
 public:
  /// Appends numbers to the buffer; returns the bufferView. `more` as in R"(,"byteStride":16)".
  template <class T>
  int view(const std::vector<T>& numbers, const std::string& more = {}) {
    return view(
        std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)),
        more);
  }
  int view(const std::string& bytes, const std::string& more = {});

  /// An accessor of a bufferView, −1 for none; returns its number.
  int accessor(int view, int component_type, const char* type, std::size_t count,
               const std::string& more = {});

  int positions(const std::vector<float>& numbers);
  int indices(const std::vector<std::uint16_t>& numbers);

  /// The document with `members`, the buffer as a data URI.
  std::string text(const std::string& members) const;
  /// The same as a binary file.
  std::string binary(const std::string& members) const;

 private:
  std::string json(const std::string& members, const std::string& uri) const;

  std::string bytes_, views_, accessors_;
  int view_count_ = 0, accessor_count_ = 0;
};

/// R"("meshes":[{"primitives":[…]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])".
std::string one_node(const std::string& primitives);

/// One triangle with positions (0,0,0), (1,0,0), (0,1,0) and the given further members.
std::string triangle_with(const std::string& members, const std::string& primitive_members = {});

/// A document without geometry.
std::string bare(const std::string& members);

/// Writes a file, without the care of write_file, which waits for the disk.
void write(const std::string& path, const std::string& contents);

/// What read_gltf makes of a file with these contents.
Scene read(const std::string& contents, const std::string& name = "a.gltf");

/// The message of the Error that it throws, the folder left out; "no error" if it throws none.
std::string error_of(const std::string& contents, const std::string& name = "a.gltf");

}  // namespace penumbra::test
