// Lights for shaders: as numbers and as text.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace penumbra {

/// What shaders know of a light; the fields of pnb_Light in light.glsl.
struct ShaderLight {
  int type = 0;  ///< 0 point, 1 sphere, 2 disk, 3 rect, 4 segment, 5 sun, 6 mesh
  Vec3 position, normal, edge_u, edge_v, emission;
  float radius = 0, sin2 = 0, diameter = 0;
  Vec2 spot{0, 1};
  int mesh = -1, own = -1;  ///< mesh: its first texel, its instance

  static constexpr std::size_t packed_size = 24;
  std::array<float, packed_size> packed() const;
};

struct ShaderLights {
  std::vector<ShaderLight> list;
  std::vector<float> texels;  ///< of mesh lights, four floats each; see mesh_light.glsl
};

/// The scene's lights.
ShaderLights shader_lights(const Scene& scene);

/// pnb_Light, the irradiance of the types that are among the lights, and pnb_irradiance over them.
/// `horizon_by_centre`: see Horizon::centre.
std::string light_functions(std::span<const ShaderLight> lights, bool horizon_by_centre);

/// Lights come in a uniform array, this many at a time.
inline constexpr int lights_at_a_time = 4;
/// pnb_light_at by the uniform vec4 pnb_lights[…]; `textured`: pnb_light_texel by pnb_light_texels,
/// in rows of light_texel_row.
std::string lights_by_uniforms(bool textured);
inline constexpr int light_texel_row = 1024;

}  // namespace penumbra
