#include "scene/gltf/encoded_image.h"

#include "scene/gltf/uri.h"

namespace penumbra::gltf {
namespace {

Encoded owned(std::shared_ptr<const std::string> bytes) {
  if (!bytes) return {};
  const std::string_view view = *bytes;
  return {std::move(bytes), view};
}

}  // namespace

Encoded encoded(Document& document, const Json::Value& image) {
  if (image.isMember("bufferView"))
    return {nullptr, document.bytes_of_view(image["bufferView"].asInt())};
  const std::string uri = image.get("uri", "").asString();
  if (!is_data_uri(uri)) return owned(document.external_file(uri));
  auto bytes = decode_data_uri(uri);
  return bytes ? owned(std::make_shared<const std::string>(std::move(*bytes))) : Encoded{};
}

}  // namespace penumbra::gltf
