#include "render/glsl/mask_text.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/alpha_mask.h"
#include "render/glsl/shader_text.h"
#include "sdf/glsl/numbers.h"

namespace penumbra {
namespace {

using sdf::number;

/// Returns the number of the first value.
std::size_t add_mask(const AlphaMask& mask, std::vector<float>& texels) {
  const std::size_t first = texels.size();
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      texels.push_back(
          mask.distance((static_cast<float>(x) + 0.5f) / static_cast<float>(mask.width()),
                        (static_cast<float>(y) + 0.5f) / static_cast<float>(mask.height())));
  return first;
}

std::string choice_of(std::size_t material, const TextureSlot& slot, const AlphaMask& mask,
                      std::size_t first) {
  const double c = std::cos(slot.rotation), s = std::sin(slot.rotation);
  return fmt::format(
      "  if (material == {})\n    return pnb_mask({}, ivec2({}, {}), ivec2({}, {}), vec2({}, {}) + "
      "mat2({}, {}, {}, {}) * ({} * vec2({}, {}))) > 0.0;\n",
      material, first, mask.width(), mask.height(), static_cast<int>(slot.wrap_s),
      static_cast<int>(slot.wrap_t), number(slot.offset.x), number(slot.offset.y), number(c),
      number(-s), number(s), number(c), slot.uv_set == 1 ? "f.uv.zw" : "f.uv.xy",
      number(slot.scale.x), number(slot.scale.y));
}

}  // namespace

std::string mask_functions(const Scene& scene, std::vector<float>& texels) {
  const AlphaMasks masks(scene);
  std::vector<bool> done(scene.materials.size());
  std::string choice;
  for (const Instance& instance : scene.instances) {
    const AlphaMask* mask = masks.find(instance.material);
    if (!mask || done[instance.material]) continue;
    done[instance.material] = true;
    choice += choice_of(instance.material, scene.materials[instance.material].diffuse_map, *mask,
                        add_mask(*mask, texels));
  }
  if (choice.empty()) return "";
  texels.resize((texels.size() + 3) / 4 * 4);
  return "\n#define PNB_MASKS\n" + std::string(shader_text("mask_lookup.glsl")) +
         "\n// True in the holes of its texture.\nbool pnb_is_cut_out(pnb_Facet f) {\n"
         "  if (pnb_texel(f.record + 12).z < 2.0) return false;\n"
         "  int material = int(pnb_texel(f.record + 7).w);\n" +
         choice + "  return false;\n}\n";
}

}  // namespace penumbra
