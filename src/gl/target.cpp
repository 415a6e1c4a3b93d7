#include "gl/target.h"

#include <epoxy/gl.h>

#include <string>

#include "base/error.h"

namespace penumbra::gl {
namespace {

unsigned new_texture(int width, int height, unsigned format) {
  unsigned id = 0;
  glGenTextures(1, &id);
  glBindTexture(GL_TEXTURE_2D, id);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
  return id;
}

}  // namespace

Texture::Texture(int width, int height, Kind kind)
    : width_(width),
      height_(height),
      id_(new_texture(width, height, kind == Kind::bytes ? GL_RGBA8 : GL_RGBA32F)) {}

Texture::~Texture() { glDeleteTextures(1, &id_); }

void Texture::write(int width, int height, std::span<const float> texels) {
  glBindTexture(GL_TEXTURE_2D, id_);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, texels.data());
}

void Texture::write(int width, int height, std::span<const std::uint8_t> texels) {
  glBindTexture(GL_TEXTURE_2D, id_);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
}

void Texture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<unsigned>(unit));
  glBindTexture(GL_TEXTURE_2D, id_);
  glActiveTexture(GL_TEXTURE0);
}

Target::Target(int width, int height, int count) : width_(width), height_(height) {
  glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  std::vector<unsigned> buffers;
  for (int i = 0; i < count; ++i) {
    layers_.push_back(new_texture(width, height, GL_RGBA32F));
    buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<unsigned>(i));
    glFramebufferTexture2D(GL_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, layers_.back(), 0);
  }
  glDrawBuffers(count, buffers.data());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw WorkError("the OpenGL driver cannot draw into " + std::to_string(width) + "x" +
                        std::to_string(height) + " pixels of floats",
                    "use another driver or --device cpu");
}

Target::~Target() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(static_cast<int>(layers_.size()), layers_.data());
}

void Target::use() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }

std::vector<float> Target::read(int layer, int width, int height) const {
  std::vector<float> texels(static_cast<std::size_t>(width) * height * 4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<unsigned>(layer));
  glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, texels.data());
  return texels;
}

}  // namespace penumbra::gl
