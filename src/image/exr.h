// OpenEXR files: linear floats in named layers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "image/image.h"

namespace penumbra {

/// Channels of one file. Channel k of the image is called "NAME.CHANNEL", or "CHANNEL" alone for a
/// layer without a name.
struct ExrLayer {
  std::string name;
  std::vector<std::string> channels;  ///< one a channel of the image
  const Image* image = nullptr;
  bool half_precision = false;  ///< 16-bit floats; 32 otherwise
};

using ExrAttributes = std::map<std::string, std::string>;

/// Writes scanlines, ZIP-compressed. All images must have the same size. Attributes are written as
/// text. Throws WorkError and leaves no file if that fails.
void write_exr(const std::string& path, const std::vector<ExrLayer>& layers,
               const ExrAttributes& attributes = {});

struct ExrFile {
  std::map<std::string, Image> channels;  ///< by full name; each of one channel
  ExrAttributes attributes;               ///< those that are text
};

/// Reads every channel of a scanline or tiled file as floats. Throws InputError.
ExrFile read_exr(const std::string& path);

}  // namespace penumbra
