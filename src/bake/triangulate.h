// Everything that a scene shows, as triangles.
#pragma once

#include "scene/scene.h"
#include "sdf/convert.h"

namespace penumbra::bake {

/// The scene with spheres as icosahedra of four subdivisions (5,120 triangles within 0.1 % of the
/// radius) with smooth normals, and distance fields as triangles (sdf/mesher.h). Throws InputError
/// for fields without end.
Scene triangulated(const Scene& scene, const sdf::ConversionOptions& conversions);

}  // namespace penumbra::bake
