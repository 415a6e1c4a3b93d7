// Textures of a glTF file: which images are used, how, and their pixels.
#pragma once

#include <vector>

#include "image/texture.h"
#include "scene/gltf/document.h"

namespace penumbra::gltf {

/// Collects the images that materials use, then decodes those and no others.
class Textures {
 public:
  explicit Textures(Document& document);

  /// The slot for one use of a texture, with sampler and KHR_texture_transform. Unused, with a
  /// warning, for a texture without an image and for TEXCOORD_2 and beyond.
  TextureSlot slot(const tinygltf::TextureInfo& use);

  /// The images in the order of first use, which slots count by. In parallel. An image that is
  /// missing or cannot be decoded becomes one white pixel, with a warning.
  /// Throws InputError before the pixels exceed 64 times the files' bytes by more than some GiB.
  std::vector<TextureImage> decode();

 private:
  int image_of(int texture);
  void decode_batch(std::size_t begin, std::size_t end, std::vector<TextureImage>& images);

  Document& document_;
  std::vector<int> slot_image_;  ///< per image of the file: its number in used_, −1 = not used
  std::vector<int> used_;
};

}  // namespace penumbra::gltf
