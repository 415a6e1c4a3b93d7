#include "scene/gltf/textures.h"

#include <fmt/format.h>

#include <memory>

#include "base/parallel.h"
#include "scene/gltf/encoded_image.h"
#include "scene/gltf/values.h"

namespace penumbra::gltf {
namespace {

/// Images are decoded in parallel within a batch; between batches their sum is looked at.
constexpr std::size_t kBatch = 4;

/// Compressed formats can blow up some ten thousand times; no picture that means something does.
std::uint64_t most_pixel_bytes(const Document& document) {
  return (std::uint64_t{1} << 30) + 64 * document.bytes_held();
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
  std::vector<TextureImage> images(used_.size());
  std::uint64_t bytes = 0;
  for (std::size_t begin = 0; begin < used_.size(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, used_.size());
    if (bytes > most_pixel_bytes(document_))
      throw document_.json().error(fmt::format("images[{}]", used_[begin]),
                                   "the images before it hold far more pixels than a file of this "
                                   "size should",
                                   "use smaller textures");
    decode_batch(begin, end, images);
    for (std::size_t k = begin; k < end; ++k) bytes += images[k].rgba.size();
  }
  return images;
}

void Textures::decode_batch(std::size_t begin, std::size_t end, std::vector<TextureImage>& images) {
  const Json::Value& list = document_.json().root()["images"];
  std::vector<Encoded> sources;
  for (std::size_t k = begin; k < end; ++k)
    sources.push_back(encoded(document_, list[static_cast<Json::ArrayIndex>(used_[k])]));
  std::vector<char> good(end - begin, 0);
  parallel_for(end - begin, [&](std::size_t i) {
    const std::string_view bytes = sources[i].bytes;
    good[i] = decode_texture(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                             images[begin + i]);
  });
  for (std::size_t i = 0; i < good.size(); ++i) {
    const int image = used_[begin + i];
    images[begin + i].name = list[static_cast<Json::ArrayIndex>(image)].get("name", "").asString();
    if (!good[i])
      document_.warnings().add(sources[i].bytes.empty()
                                   ? "an image cannot be found and is shown white"
                                   : "an image cannot be decoded and is shown white",
                               fmt::format("images[{}]", image));
  }
}

}  // namespace penumbra::gltf
