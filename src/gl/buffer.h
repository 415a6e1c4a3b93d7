// Memory that programs read.
#pragma once

#include <cstddef>
#include <span>

namespace penumbra::gl {

/// Bytes on the driver's side; needs the Context that it was made under.
class Buffer {
 public:
  Buffer();
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  unsigned id() const { return id_; }
  /// Replaces all that it holds.
  void write(std::span<const std::byte> bytes);
  /// Makes it the uniform block of a binding.
  void bind_uniforms(unsigned binding) const;

 private:
  unsigned id_ = 0;
};

}  // namespace penumbra::gl
