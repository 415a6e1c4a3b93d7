// What the scene's lights would give to a surface if nothing stood between.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/cone_irradiance.h"
#include "render/ggx.h"
#include "render/light_patches.h"
#include "render/shading_point.h"
#include "shadow/light_view.h"

namespace penumbra {

/// The lights of a scene, made ready for shading; immutable, thread-safe, no allocation per query.
/// Light is never infinite: a point on or inside a light gets at most what a half space of its
/// radiance gives, and a point light is at least a micrometre away.
///
/// One-sided: disk, rect and single-sided mesh lights give nothing behind them. The lights of a
/// mesh are its front faces; of a double-sided mesh both sides unless it is closed, since then its
/// inside is not seen.
class DirectLight {
 public:
  explicit DirectLight(const LightViews& views);

  std::size_t size() const { return lights_.size(); }
  /// Radiance; intensity of a point light; irradiance of a sun.
  const Vec3& emission(std::size_t light) const { return lights_[light].emission; }

  /// Irradiance on a surface through `position`, per unit of emission(). Exact to float precision
  /// for sphere, disk, rect, sun, point and for meshes of up to 64 triangles; finer meshes by 128
  /// points of their surface; segments as lines (segment_irradiance.h).
  float irradiance(std::size_t light, const Vec3& position, const Vec3& normal,
                   Horizon horizon) const;

  /// The glossy reflection towards the viewer per unit of emission(), from 32 fixed points of the
  /// light, each lobe widened by their spacing.
  Glossy glossy(std::size_t light, const ShadingPoint& point) const;

 private:
  struct Source {
    LightType type = LightType::point;
    Vec3 emission, position, normal;
    float radius = 0;
    float sin2 = 0;                         ///< sun: squared sine of half its angular diameter
    float per_radiance = 1;                 ///< sun: radiance per unit irradiance
    float spot_scale = 0, spot_offset = 1;  ///< point, sphere: cosine → [0, 1] between outer and
                                            ///< inner cone; no cone: 0 and 1
    std::array<Vec3, 4> corners;            ///< rect; segment: its ends in the first two
    float stretch = 1;                      ///< a patch's squared length over its area
    bool double_sided = false;              ///< mesh
    std::vector<LightFace> faces;           ///< mesh of few faces
    std::vector<LightPatch> patches;        ///< flat lights, segments, meshes
    std::vector<LightPatch> fine_patches;   ///< mesh of many faces
  };

  static Source source_of(const Light& light, const MeshLight& mesh);
  /// What the cone of a spot lets through to where the light's centre lies in direction `to_light`.
  static float spot_part(const Source& source, const Vec3& to_light);
  static void add_mesh(const MeshLight& mesh, Source& source);
  float mesh_irradiance(const Source& source, const Vec3& position, const Vec3& normal,
                        Horizon horizon) const;
  Glossy cone_glossy(const Source& source, const ShadingPoint& point, const Vec3& axis,
                     float sin2) const;
  static float seen_solid_angle(const Source& source, const LightPatch& patch, const Vec3& to,
                                float d2);
  static Glossy patch_glossy(const Source& source, const ShadingPoint& point);

  std::vector<Source> lights_;
  std::vector<Vec2> spiral_;
};

}  // namespace penumbra
