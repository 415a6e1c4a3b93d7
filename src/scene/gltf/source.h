// The bytes of a glTF 2.0 file, text or binary, cut into JSON and binary chunk.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/error.h"

namespace penumbra::gltf {

class Source {
 public:
  /// Reads `path`. What it is decides its beginning, not its name. Throws InputError with the byte
  /// where a binary file is cut off or contradicts itself (glTF 2.0, section 4.4).
  explicit Source(const std::string& path);

  const std::string& file() const { return file_; }
  bool binary() const { return binary_; }
  std::size_t size() const { return bytes_.size(); }
  std::string_view json() const { return view(json_); }
  /// The first BIN chunk; empty if there is none.
  std::string_view bin() const { return view(bin_); }

  /// Where a byte of json() is in the file: line and column of a text, byte of a binary.
  Place place(std::size_t offset_in_json) const;

 private:
  struct Range {
    std::size_t begin = 0, length = 0;
  };

  std::string_view view(Range r) const {
    return std::string_view(bytes_).substr(r.begin, r.length);
  }
  std::uint32_t word(std::size_t at) const;
  [[noreturn]] void fail(std::size_t at, const std::string& what, const std::string& remedy) const;
  void cut_text();
  void cut_binary();
  std::size_t checked_length() const;
  void take_chunk(std::size_t at, std::size_t length);

  std::string file_, bytes_;
  bool binary_ = false;
  Range json_, bin_;
};

}  // namespace penumbra::gltf
