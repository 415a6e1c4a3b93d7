// What every loaded scene goes through before it is rendered.
#pragma once

#include "scene/scene.h"

namespace penumbra {

/// In this order: refuses vertices, spheres and transforms that are not finite or reach beyond 1e9
/// m, and singular transforms (InputError with `file`); gives emissive instances a mesh of their
/// own; applies the transform of meshes used once to their vertices, so that the instances left
/// with a transform are true instances; drops triangles without area (counted in the report), then
/// instances and meshes that have none left; refuses a scene without any triangle or sphere; splits
/// instances whose material emits (factor, not texture alone) into connected parts and adds a mesh
/// light for each, named after the mesh.
///
/// Afterwards indices of meshes, instances and materials agree, every mesh is used, normals are
/// unit vectors and texture coordinates finite. Where a transform that mirrors is applied, the
/// winding is turned so that the front stays the front. An instance that keeps one (determinant <
/// 0) has its front where the winding in the mesh frame says: cross(M e, M f) points to the back
/// there.
void finish_scene(Scene& scene, const std::string& file);

/// True for a triangle without area, as far as float coordinates can tell: the rounding of the
/// corners could have made all of it, or its square is too small for a float.
bool has_no_area(const Vec3& p, const Vec3& q, const Vec3& r);

/// What shows a scene that has no end: from (3.2, 2.6, 4.4) to (0, 0.4, 0), 40 degrees high.
Camera default_view();
/// A sun of 6 degrees for it, irradiance π.
Light default_sun();

/// Adds a framing camera if there is none and a soft key light near the camera's side if there is
/// no light (nor only unlit surfaces), placed by the scene's bounds and, if the file has a camera,
/// beside that one; says so in the report. Call after finish_scene. Light on what faces it at the
/// scene's centre: irradiance π. What has no end is framed by its finite parts; without any it gets
/// default_view and default_sun.
void add_missing_camera_and_light(Scene& scene);

/// Groups triangles by shared vertex positions: for each triangle the number of its connected part,
/// parts numbered from 0 in order of first triangle. Expected time linear in the mesh's size.
std::vector<std::uint32_t> connected_parts(const Mesh& mesh);

}  // namespace penumbra
