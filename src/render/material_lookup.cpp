#include "render/material_lookup.h"

#include "base/parallel.h"
#include "shadow/shadows.h"

namespace penumbra {
namespace {

constexpr float dielectric_f0 = 0.04f;
constexpr float least_alpha = 0.002f;  ///< below it the lobe's peak is lost in float rounding

/// Linear, green roughness and blue metallic.
void mix_metal(const Material& material, const Vec3& metallic_roughness, ShadingPoint& point) {
  const Vec3 base = point.diffuse;
  const float metallic = std::clamp(material.metallic * metallic_roughness.z, 0.0f, 1.0f);
  point.diffuse = base * ((1 - metallic) * (1 - dielectric_f0));
  point.specular = Vec3(dielectric_f0 * (1 - metallic)) + base * metallic;
}

}  // namespace

MaterialLookup::MaterialLookup(const Scene& scene) : scene_(scene) {
  for (auto& samplers : samplers_) samplers.resize(scene.textures.size());
  std::vector<std::uint8_t> used[2];
  for (auto& flags : used) flags.resize(scene.textures.size());
  const auto mark = [&](const TextureSlot& slot, bool srgb) {
    if (slot.used()) used[srgb][static_cast<std::size_t>(slot.image)] = 1;
  };
  for (const Material& m : scene.materials)
    mark(m.diffuse_map, true), mark(m.emission_map, true), mark(m.metallic_roughness_map, false);
  parallel_for(2 * scene.textures.size(), [&](std::size_t i) {
    const std::size_t image = i / 2, srgb = i % 2;
    if (used[srgb][image])
      samplers_[srgb][image] = std::make_unique<TextureSampler>(scene.textures[image], srgb == 1);
  });
}

Vec3 MaterialLookup::color(const TextureSlot& slot, const Surface& surface, float width,
                           bool srgb) const {
  if (!slot.used()) return Vec3(1.0f);
  const float per_metre = slot.uv_set == 0 ? surface.uv_per_metre.x : surface.uv_per_metre.y;
  return samplers_[srgb][static_cast<std::size_t>(slot.image)]
      ->sample(slot, surface.uv[slot.uv_set], width * per_metre)
      .color;
}

ShadingPoint MaterialLookup::at(const Surface& surface, const Vec3& to_viewer, float width) const {
  if (surface.blend.empty()) return of_material(surface.material, surface, to_viewer, width);
  ShadingPoint sum = of_material(surface.blend.front().material, surface, to_viewer, width);
  sum.diffuse = sum.specular = sum.mirror = sum.emission = {}, sum.alpha = 0;
  for (const Surface::Share& share : surface.blend) {
    const ShadingPoint part = of_material(share.material, surface, to_viewer, width);
    sum.diffuse += part.diffuse * share.weight, sum.specular += part.specular * share.weight;
    sum.mirror += part.mirror * share.weight, sum.emission += part.emission * share.weight;
    sum.alpha += part.alpha * share.weight;
  }
  return sum;
}

ShadingPoint MaterialLookup::of_material(std::uint32_t material, const Surface& surface,
                                         const Vec3& to_viewer, float width) const {
  const Material& m = scene_.materials[material];
  // The beam covers width × width / cos; a square of that area neither blurs nor aliases most.
  const float facing = std::max(std::abs(dot(surface.normal, to_viewer)), 0.01f);
  const float side = width / std::sqrt(facing);
  ShadingPoint point;
  point.position = receiver_of(surface).position;
  point.normal = surface.shading_normal;
  point.to_viewer = to_viewer;
  point.diffuse = m.diffuse * surface.color * color(m.diffuse_map, surface, side, true);
  if (m.unlit > 0) {
    if (surface.front || m.double_sided) point.emission = point.diffuse * m.unlit;
    point.diffuse = {};
    return point;
  }
  point.specular = m.specular;
  point.mirror = m.mirror;
  if (surface.front || m.double_sided)
    point.emission = m.emission * color(m.emission_map, surface, side, true);
  const Vec3 mr = color(m.metallic_roughness_map, surface, side, false);
  if (m.is_metallic_roughness) mix_metal(m, mr, point);
  const float roughness = m.roughness * mr.y;
  point.alpha = std::clamp(roughness * roughness, least_alpha, 1.0f);
  return point;
}

}  // namespace penumbra
