#include "gl/buffer.h"

#include <epoxy/gl.h>

namespace penumbra::gl {

Buffer::Buffer() { glGenBuffers(1, &id_); }

Buffer::~Buffer() { glDeleteBuffers(1, &id_); }

void Buffer::write(std::span<const std::byte> bytes) {
  glBindBuffer(GL_ARRAY_BUFFER, id_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(bytes.size()), bytes.data(),
               GL_STREAM_DRAW);
}

void Buffer::bind_uniforms(unsigned binding) const {
  glBindBufferBase(GL_UNIFORM_BUFFER, binding, id_);
}

}  // namespace penumbra::gl
