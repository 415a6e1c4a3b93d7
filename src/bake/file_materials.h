// The materials of baked files, as glTF has them.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "bake/glb.h"
#include "scene/gltf_materials.h"

namespace penumbra::bake {

/// Unlit materials that show pages of radiance (KHR_materials_unlit).
class UnlitMaterials {
 public:
  explicit UnlitMaterials(GlbModel& model) : model_(model) {}
  /// The material for a page, −1 for vertex colours; with holes if there is a cutoff. Texture and
  /// image of page i have the number i.
  int find(int page, std::optional<float> alpha_cutoff);

 private:
  GlbModel& model_;
  std::map<std::pair<int, float>, int> known_;
};

/// The scene's own materials, each with the lightmap of a page (MOZ_lightmap). Those of a glTF file
/// are its own to the letter, extensions, textures and samplers included, but for what TEXCOORD_1
/// held: that is TEXCOORD_2 here, and textures on higher sets are left out.
class LightmapMaterials {
 public:
  /// Textures and images 0 to pages − 1 are the lightmaps; the scene's own follow. `source` may be
  /// null.
  LightmapMaterials(const Scene& scene, int pages, const GltfMaterials* source, GlbModel& model);
  /// `page` −1: without a lightmap. `one_sided`: written once for each side.
  int find(std::uint32_t material, int page, bool one_sided);
  /// Once the pages are known: what a texel of 1 stands for, W/m².
  void set_intensities(const std::vector<float>& by_page);

 private:
  struct Use {
    std::uint32_t material;
    int page;
    bool one_sided;
    auto operator<=>(const Use&) const = default;
  };
  Json::Value material(const Material& in);
  Json::Value texture(const TextureSlot& slot);
  Json::Value source_material(const std::string& text);
  void adapt(Json::Value& part);
  bool adapt_use(Json::Value& use);
  int source_texture(int index);
  int source_image(int index);

  const Scene& scene_;
  int pages_;
  const GltfMaterials* source_;
  GlbModel& model_;
  std::map<Use, int> known_;
  std::map<std::pair<int, int>, int> textures_;  ///< by image and wrap
  std::map<int, int> images_;
  std::map<int, int> source_textures_, source_images_;  ///< by number in the source
  int source_samplers_ = -1;                            ///< the first; −1: not yet written
};

}  // namespace penumbra::bake
