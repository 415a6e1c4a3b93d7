// What leaves a surface, from the irradiance that reaches it.
#pragma once

#include "bake/texel_map.h"
#include "render/material_lookup.h"

namespace penumbra::bake {

/// A point of an instance's triangle, on one of its sides.
struct MeshPoint {
  std::uint32_t triangle = 0;
  float b1 = 0, b2 = 0;  ///< weights of corners 1 and 2
  bool back = false;
};

/// For Irradiance::of_points. The shading normal is the triangle's where vertex normals contradict
/// it or one another.
SurfacePoint surface_point(const WorldMesh& mesh, const MeshPoint& at);

/// Equation (2) of Heckbert and Herf (1997) with the visible light already summed: diffuse / π ·
/// irradiance + ambient term + own emission, W·sr⁻¹·m⁻², seen along the normal. Mirrors and
/// highlights, which depend on the viewer, are left out; the ambient term has their reflectance, as
/// in the ray tracer's. Immutable; thread-safe; keeps references.
class SurfaceLight {
 public:
  SurfaceLight(const Scene& scene, const MaterialLookup& materials, const Vec3& ambient)
      : scene_(scene), materials_(materials), ambient_(ambient) {}

  /// `width`: of the texel, metres; textures are filtered over it.
  Vec3 radiance(const WorldMesh& mesh, const MeshPoint& at, const Vec3& irradiance,
                float width) const;
  bool is_masked(const WorldMesh& mesh) const {
    return scene_.materials[mesh.instance().material].alpha_cutoff.has_value();
  }
  /// Coverage of a material with holes, in [0, 1]; 1 for others.
  float alpha(const WorldMesh& mesh, const MeshPoint& at) const;

 private:
  Surface surface(const WorldMesh& mesh, const MeshPoint& at) const;

  const Scene& scene_;
  const MaterialLookup& materials_;
  Vec3 ambient_;
};

}  // namespace penumbra::bake
