// What every loaded scene goes through before it is rendered.
#pragma once

#include "scene/scene.h"

namespace penumbra {

/// In this order: drops zero-area triangles (counted in the report); refuses NaN or infinite
/// vertices, singular transforms and a scene without any triangle or sphere (InputError with
/// `file`); applies the transform of meshes used once to their vertices, so that the instances that
/// are left with a transform are true instances; splits instances whose material emits (factor, not
/// texture alone) into connected parts and adds a mesh light for each.
void finish_scene(Scene& scene, const std::string& file);

/// Adds a framing camera if there is none and a soft key light near the camera's side if there is
/// no light; says so in the report.
void add_missing_camera_and_light(Scene& scene);

/// Groups triangles by shared vertex positions: for each triangle the number of its connected part,
/// parts numbered from 0 in order of first triangle.
std::vector<std::uint32_t> connected_parts(const Mesh& mesh);

}  // namespace penumbra
