#include "scene/gltf/textures.h"

#include <fmt/format.h>

#include <memory>

#include "base/parallel.h"
#include "scene/gltf/uri.h"
#include "scene/gltf/values.h"

namespace penumbra::gltf {
namespace {

/// The encoded bytes of an image, and what keeps them alive.
struct Encoded {
  std::shared_ptr<const std::string> owner;
  std::string_view bytes;
};

Encoded owned(std::shared_ptr<const std::string> bytes) {
  if (!bytes) return {};
  const std::string_view view = *bytes;
  return {std::move(bytes), view};
}

/// Empty if the image is nowhere to be found.
Encoded encoded(Document& document, const Json::Value& image) {
  if (image.isMember("bufferView"))
    return {nullptr, document.bytes_of_view(image["bufferView"].asInt())};
  const std::string uri = image.get("uri", "").asString();
  if (!is_data_uri(uri)) return owned(document.external_file(uri));
  auto bytes = decode_data_uri(uri);
  return bytes ? owned(std::make_shared<const std::string>(std::move(*bytes))) : Encoded{};
}

Wrap wrap(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

void apply_sampler(const tinygltf::Model& model, int sampler, TextureSlot& slot) {
  if (sampler < 0) return;
  const tinygltf::Sampler& s = model.samplers[static_cast<std::size_t>(sampler)];
  slot.wrap_s = wrap(s.wrapS);
  slot.wrap_t = wrap(s.wrapT);
  slot.nearest = s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
}

void apply_transform(const tinygltf::TextureInfo& use, TextureSlot& slot) {
  const tinygltf::Value* t = extension(use.extensions, "KHR_texture_transform");
  if (!t) return;
  slot.offset = {to_float(number(*t, "offset", 0).value_or(0)),
                 to_float(number(*t, "offset", 1).value_or(0))};
  slot.scale = {to_float(number(*t, "scale", 0).value_or(1)),
                to_float(number(*t, "scale", 1).value_or(1))};
  slot.rotation = to_float(number(*t, "rotation").value_or(0));
  slot.uv_set = static_cast<int>(number(*t, "texCoord").value_or(slot.uv_set));
}

}  // namespace

Textures::Textures(Document& document)
    : document_(document), slot_image_(document.json().count("images"), -1) {}

int Textures::image_of(int texture) {
  const int image = document_.model().textures[static_cast<std::size_t>(texture)].source;
  if (image < 0) {
    document_.warnings().add("a texture without an image is left out",
                             fmt::format("textures[{}]", texture));
    return -1;
  }
  int& number = slot_image_[static_cast<std::size_t>(image)];
  if (number < 0) {
    number = static_cast<int>(used_.size());
    used_.push_back(image);
  }
  return number;
}

TextureSlot Textures::slot(const tinygltf::TextureInfo& use) {
  TextureSlot slot;
  if (use.index < 0) return slot;
  slot.uv_set = use.texCoord;
  apply_transform(use, slot);
  if (slot.uv_set > 1) {
    document_.warnings().add("textures on TEXCOORD_2 and beyond are left out",
                             fmt::format("textures[{}]", use.index));
    return {};
  }
  apply_sampler(document_.model(),
                document_.model().textures[static_cast<std::size_t>(use.index)].sampler, slot);
  slot.image = image_of(use.index);
  return slot;
}

std::vector<TextureImage> Textures::decode() {
  const Json::Value& images = document_.json().root()["images"];
  std::vector<Encoded> sources;
  for (const int i : used_)
    sources.push_back(encoded(document_, images[static_cast<Json::ArrayIndex>(i)]));
  std::vector<TextureImage> result(used_.size());
  std::vector<char> good(used_.size(), 0);
  parallel_for(used_.size(), [&](std::size_t k) {
    const std::string_view bytes = sources[k].bytes;
    good[k] = decode_texture(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                             result[k]);
  });
  for (std::size_t k = 0; k < used_.size(); ++k) {
    const Json::Value& image = images[static_cast<Json::ArrayIndex>(used_[k])];
    result[k].name = image.get("name", "").asString();
    if (!good[k])
      document_.warnings().add(sources[k].bytes.empty()
                                   ? "an image cannot be found and is shown white"
                                   : "an image cannot be decoded and is shown white",
                               fmt::format("images[{}]", used_[k]));
  }
  return result;
}

}  // namespace penumbra::gltf
