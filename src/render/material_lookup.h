// From a surface and its material to a shading point: textures filtered, glTF's metals mixed.
#pragma once

#include <memory>
#include <vector>

#include "geometry/world.h"
#include "image/texture_sampler.h"
#include "render/shading_point.h"
#include "scene/scene.h"

namespace penumbra {

/// The materials of a scene with the pyramids of their textures. Immutable; thread-safe; keeps a
/// reference to the scene.
///
/// Both sides of a surface reflect alike, whether its material is double-sided or not (a ray
/// tracer has no culling); a single-sided material emits from its front only. Metallic-roughness
/// materials follow glTF 2.0, appendix B.2, with the diffuse layer's (1 − F) taken at normal
/// incidence so that diffuse light stays in closed form.
class MaterialLookup {
 public:
  explicit MaterialLookup(const Scene& scene);

  /// `to_viewer`: unit, back along the ray that met the surface. `width`: of the pixel's beam
  /// there, across the ray, metres; textures are filtered over the area it covers.
  /// Where materials blend, so does what they say.
  ShadingPoint at(const Surface& surface, const Vec3& to_viewer, float width) const;

 private:
  ShadingPoint of_material(std::uint32_t material, const Surface& surface, const Vec3& to_viewer,
                           float width) const;
  Vec3 color(const TextureSlot& slot, const Surface& surface, float width, bool srgb) const;

  const Scene& scene_;
  std::vector<std::unique_ptr<TextureSampler>> samplers_[2];  ///< by image; [1] reads as sRGB
};

}  // namespace penumbra
