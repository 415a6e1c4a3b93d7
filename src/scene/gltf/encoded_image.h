// The bytes of a glTF file's images, as they are.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "scene/gltf/document.h"

namespace penumbra::gltf {

/// The encoded bytes of an image, and what keeps them alive besides the document.
struct Encoded {
  std::shared_ptr<const std::string> owner;
  std::string_view bytes;
};

/// Empty if the image is nowhere to be found.
Encoded encoded(Document& document, const Json::Value& image);

}  // namespace penumbra::gltf
