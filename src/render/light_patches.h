// A few fixed points that stand for a light where the closed forms end: in glossy reflections, and
// for the irradiance of finely tessellated mesh lights. The same points for every pixel, so that
// they bring no noise.
#pragma once

#include <span>
#include <vector>

#include "base/vec.h"
#include "scene/scene.h"
#include "shadow/light_view.h"

namespace penumbra {

/// Points that stand for a light in glossy reflections; for the irradiance of a mesh light of more
/// than few_faces faces; of one with a texture.
inline constexpr int glossy_points = 32, mesh_points = 128, textured_points = 256;
inline constexpr std::size_t few_faces = 64;

/// A piece of a light's surface.
struct LightPatch {
  Vec3 position;
  Vec3 normal;     ///< unit, the side that emits; a segment: the unit direction along it
  float area = 0;  ///< a segment: of the strip 2 r Δl
};

/// Points of a disk on a Vogel spiral, of a rect on a grid of about square cells, of a segment
/// evenly along it, of equal area each.
std::vector<LightPatch> disk_patches(const Light& light, int count);
std::vector<LightPatch> rect_patches(const Light& light, int count);
std::vector<LightPatch> segment_patches(const Light& light, int count);
/// `count` points spread over the faces evenly by area.
std::vector<LightPatch> mesh_patches(std::span<const LightFace> faces, int count);

/// Points of the unit disk on a Vogel spiral, equal in area; a cone's directions by equal-area
/// projection.
std::vector<Vec2> vogel_spiral(int count);

}  // namespace penumbra
