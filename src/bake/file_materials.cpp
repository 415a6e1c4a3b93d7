#include "bake/file_materials.h"

#include <json/reader.h>

#include <algorithm>
#include <memory>

#include "image/png_bytes.h"

namespace penumbra::bake {
namespace {

Json::Value array_of(const Vec3& v) {
  Json::Value a(Json::arrayValue);
  for (int i = 0; i < 3; ++i) a.append(static_cast<double>(v[i]));
  return a;
}

constexpr int own_samplers = 2;  // see GlbModel

Json::Value parsed(const std::string& text) {
  Json::Value value;
  const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
  reader->parse(text.data(), text.data() + text.size(), &value, nullptr);
  return value;
}

void set_cutoff(Json::Value& material, float cutoff) {
  material["alphaMode"] = "MASK";
  material["alphaCutoff"] = static_cast<double>(cutoff);
}

/// Factors above 1 go into the strength.
void set_emission(const Vec3& emission, Json::Value& out) {
  const float most = max_component(emission);
  if (!(most > 0)) return;
  out["emissiveFactor"] = array_of(emission / std::max(most, 1.0f));
  if (most > 1)
    out["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] =
        static_cast<double>(most);
}

}  // namespace

int UnlitMaterials::find(int page, std::optional<float> alpha_cutoff) {
  const auto [it, is_new] =
      known_.try_emplace({page, alpha_cutoff.value_or(-1.0f)}, model_.materials.size());
  if (!is_new) return it->second;
  Json::Value material;
  material["name"] = page < 0 ? "vertex radiance" : "radiance " + std::to_string(page);
  material["extensions"]["KHR_materials_unlit"] = Json::objectValue;
  Json::Value& pbr = material["pbrMetallicRoughness"];
  // For viewers that do not know unlit surfaces.
  pbr["metallicFactor"] = 0.0, pbr["roughnessFactor"] = 1.0;
  if (page >= 0) pbr["baseColorTexture"]["index"] = page;
  if (alpha_cutoff) set_cutoff(material, *alpha_cutoff);
  model_.materials.append(material);
  return it->second;
}

LightmapMaterials::LightmapMaterials(const Scene& scene, int pages, const GltfMaterials* source,
                                     GlbModel& model)
    : scene_(scene), pages_(pages), source_(source), model_(model) {
  for (int i = 0; i < pages; ++i) {
    Json::Value texture;
    texture["source"] = i, texture["sampler"] = 0;
    model_.textures.append(texture);
    model_.images.push_back({"lightmap " + std::to_string(i), {}});
  }
}

Json::Value LightmapMaterials::texture(const TextureSlot& slot) {
  const int sampler = slot.wrap_s == Wrap::clamp && slot.wrap_t == Wrap::clamp ? 0 : 1;
  const auto [image, new_image] =
      images_.try_emplace(slot.image, static_cast<int>(model_.images.size()));
  if (new_image) {
    const TextureImage& in = scene_.textures[static_cast<std::size_t>(slot.image)];
    model_.images.push_back({in.name, encode_png(in.width, in.height, in.rgba.data())});
  }
  const auto [number, is_new] =
      textures_.try_emplace({slot.image, sampler}, static_cast<int>(model_.textures.size()));
  if (is_new) {
    Json::Value texture;
    texture["source"] = image->second, texture["sampler"] = sampler;
    model_.textures.append(texture);
  }
  Json::Value use;
  use["index"] = number->second;
  // The lightmap has taken TEXCOORD_1.
  if (slot.uv_set == 1) use["texCoord"] = 2;
  Json::Value& transform = use["extensions"]["KHR_texture_transform"];
  for (const float x : {slot.offset.x, slot.offset.y}) transform["offset"].append(double{x});
  for (const float x : {slot.scale.x, slot.scale.y}) transform["scale"].append(double{x});
  transform["rotation"] = static_cast<double>(slot.rotation);
  const bool plain = slot.offset.x == 0 && slot.offset.y == 0 && slot.scale.x == 1 &&
                     slot.scale.y == 1 && slot.rotation == 0;
  if (plain) use.removeMember("extensions");
  return use;
}

Json::Value LightmapMaterials::material(const Material& in) {
  Json::Value out;
  if (!in.name.empty()) out["name"] = in.name;
  Json::Value& pbr = out["pbrMetallicRoughness"];
  // A matte base colour reflects 4 % less of it than our own materials' diffuse.
  pbr["baseColorFactor"] = array_of(in.diffuse);
  pbr["baseColorFactor"].append(static_cast<double>(in.alpha));
  pbr["metallicFactor"] = static_cast<double>(in.is_metallic_roughness ? in.metallic : 0.0f);
  pbr["roughnessFactor"] = static_cast<double>(in.is_metallic_roughness ? in.roughness : 1.0f);
  if (in.diffuse_map.used()) pbr["baseColorTexture"] = texture(in.diffuse_map);
  if (in.metallic_roughness_map.used())
    pbr["metallicRoughnessTexture"] = texture(in.metallic_roughness_map);
  set_emission(in.emission, out);
  if (in.emission_map.used()) out["emissiveTexture"] = texture(in.emission_map);
  if (in.alpha_cutoff) set_cutoff(out, *in.alpha_cutoff);
  if (in.double_sided) out["doubleSided"] = true;
  return out;
}

int LightmapMaterials::source_image(int index) {
  const auto [it, is_new] = source_images_.try_emplace(index, -1);
  if (!is_new) return it->second;
  const GltfMaterials::Image& in = source_->images[static_cast<std::size_t>(index)];
  if (in.bytes.empty() || in.mime_type.empty()) return -1;
  it->second = static_cast<int>(model_.images.size());
  model_.images.push_back({in.name, in.bytes, in.mime_type});
  return it->second;
}

int LightmapMaterials::source_texture(int index) {
  const auto [it, is_new] = source_textures_.try_emplace(index, -1);
  if (!is_new) return it->second;
  Json::Value texture = parsed(source_->textures[static_cast<std::size_t>(index)]);
  if (source_samplers_ < 0) {
    source_samplers_ = own_samplers;
    for (const std::string& text : source_->samplers) model_.samplers.append(parsed(text));
  }
  if (texture.isMember("sampler"))
    texture["sampler"] = source_samplers_ + texture["sampler"].asInt();
  const auto move_source = [&](Json::Value& in) {
    if (!in.isMember("source")) return;
    const int image = source_image(in["source"].asInt());
    if (image < 0)
      in.removeMember("source");
    else
      in["source"] = image;
  };
  move_source(texture);
  if (texture.isMember("extensions"))
    for (const std::string& name : texture["extensions"].getMemberNames())
      move_source(texture["extensions"][name]);
  it->second = static_cast<int>(model_.textures.size());
  model_.textures.append(texture);
  return it->second;
}

/// False for a texture on TEXCOORD_2 or beyond.
bool LightmapMaterials::adapt_use(Json::Value& use) {
  Json::Value* where[] = {&use, nullptr};
  if (use.isMember("extensions") && use["extensions"].isMember("KHR_texture_transform"))
    where[1] = &use["extensions"]["KHR_texture_transform"];
  int set = use.get("texCoord", 0).asInt();
  if (where[1]) set = where[1]->get("texCoord", set).asInt();
  if (set > 1) return false;
  for (Json::Value* at : where)
    if (at && at->isMember("texCoord") && (*at)["texCoord"].asInt() == 1) (*at)["texCoord"] = 2;
  use["index"] = source_texture(use["index"].asInt());
  return true;
}

void LightmapMaterials::adapt(Json::Value& part) {
  if (!part.isObject()) return;
  for (const std::string& key : part.getMemberNames()) {
    if (key == "extras") continue;
    Json::Value& value = part[key];
    if (key.ends_with("Texture") && value.isObject() && value.isMember("index")) {
      if (!adapt_use(value)) part.removeMember(key);
    } else {
      adapt(value);
    }
  }
}

Json::Value LightmapMaterials::source_material(const std::string& text) {
  Json::Value out = parsed(text);
  if (out.isMember("extensions")) out["extensions"].removeMember("MOZ_lightmap");
  adapt(out);
  return out;
}

int LightmapMaterials::find(std::uint32_t material_index, int page, bool one_sided) {
  const Use use{material_index, page, one_sided};
  const auto [it, is_new] = known_.try_emplace(use, model_.materials.size());
  if (!is_new) return it->second;
  const bool is_source = source_ && material_index < source_->materials.size();
  Json::Value out = is_source ? source_material(source_->materials[material_index])
                              : material(scene_.materials[material_index]);
  if (one_sided) out.removeMember("doubleSided");
  if (page >= 0) {
    Json::Value& lightmap = out["extensions"]["MOZ_lightmap"];
    lightmap["index"] = page, lightmap["texCoord"] = 1, lightmap["intensity"] = 1.0;
  }
  model_.materials.append(out);
  return it->second;
}

void LightmapMaterials::set_intensities(const std::vector<float>& by_page) {
  for (const auto& [use, index] : known_)
    if (use.page >= 0)
      model_.materials[static_cast<Json::ArrayIndex>(index)]["extensions"]["MOZ_lightmap"]
                      ["intensity"] =
          static_cast<double>(by_page[static_cast<std::size_t>(use.page)]);
}

}  // namespace penumbra::bake
