#include <json/writer.h>

#include "scene/gltf/encoded_image.h"
#include "scene/gltf_materials.h"

namespace penumbra {
namespace {

std::vector<std::string> texts_of(const Json::Value& list) {
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "";
  std::vector<std::string> texts;
  for (const Json::Value& entry : list) texts.push_back(Json::writeString(builder, entry));
  return texts;
}

/// By the file's first bytes, since few files with a URI name a type.
std::string mime_type_of(const Json::Value& image, std::string_view bytes) {
  if (image.isMember("mimeType")) return image["mimeType"].asString();
  if (bytes.starts_with("\x89PNG")) return "image/png";
  if (bytes.starts_with("\xff\xd8")) return "image/jpeg";
  return "";
}

}  // namespace

GltfMaterials read_gltf_materials(const std::string& path) {
  gltf::Document document(path);
  const Json::Value& root = document.json().root();
  GltfMaterials out;
  out.materials = texts_of(root["materials"]);
  out.textures = texts_of(root["textures"]);
  out.samplers = texts_of(root["samplers"]);
  for (const Json::Value& image : root["images"]) {
    const gltf::Encoded found = gltf::encoded(document, image);
    out.images.push_back({image.get("name", "").asString(), mime_type_of(image, found.bytes),
                          std::string(found.bytes)});
  }
  return out;
}

}  // namespace penumbra
