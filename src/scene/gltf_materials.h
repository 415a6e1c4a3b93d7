// What a glTF file says of its materials, as it says it: for files that are written from it.
#pragma once

#include <string>
#include <vector>

namespace penumbra {

/// JSON texts of the file's arrays, and the images' bytes. Indices in them are into these; a scene
/// that was read from the file has its materials in the same order.
struct GltfMaterials {
  struct Image {
    std::string name, mime_type, bytes;  ///< empty bytes: it could not be found
  };
  std::vector<std::string> materials, textures, samplers;
  std::vector<Image> images;
};

/// Throws InputError as read_gltf() does.
GltfMaterials read_gltf_materials(const std::string& path);

}  // namespace penumbra
