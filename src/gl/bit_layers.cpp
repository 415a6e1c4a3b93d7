#include "gl/bit_layers.h"

#include <epoxy/gl.h>

#include <array>
#include <string>

#include "base/error.h"

namespace penumbra::gl {

BitLayers::BitLayers(int width, int height, int count) : width_(width), height_(height) {
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture_);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_R32UI, width, height, count);
  glGenFramebuffers(1, &framebuffer_);
  use(0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw WorkError("the OpenGL driver cannot draw into " + std::to_string(width) + "x" +
                        std::to_string(height) + " pixels of whole numbers",
                    "use another driver or --device cpu");
}

BitLayers::~BitLayers() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &texture_);
}

void BitLayers::use(int layer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture_, 0, layer);
}

void BitLayers::clear(int layer, std::uint32_t word, int width, int height) const {
  use(layer);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, width, height);
  const std::array<unsigned, 4> words{word, 0, 0, 0};
  glClearBufferuiv(GL_COLOR, 0, words.data());
  glDisable(GL_SCISSOR_TEST);
}

void BitLayers::write(int layer, int width, int height,
                      std::span<const std::uint32_t> words) const {
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture_);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, width, height, 1, GL_RED_INTEGER,
                  GL_UNSIGNED_INT, words.data());
}

void BitLayers::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<unsigned>(unit));
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture_);
  glActiveTexture(GL_TEXTURE0);
}

}  // namespace penumbra::gl
