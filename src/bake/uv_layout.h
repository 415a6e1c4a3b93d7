// Charts where the meshes' own texture coordinates say.
#pragma once

#include "bake/plan.h"

namespace penumbra::bake {

/// Lays out the plan's receivers by TEXCOORD_1 if all meshes of an object have it, else by
/// TEXCOORD_0. Each side of an object gets a page of its own, on which [0, 1]² is the whole page,
/// so that coordinates stay as they are; where an object's meshes overlap one another, each mesh
/// does. Sets the charts, their places and pages.
///
/// Flat parts whose layout is an affine image of the surface become flat charts.
///
/// Throws InputError, naming the object, for coordinates that are missing, beyond [0, 1], without
/// area, or that overlap within a mesh on more than 0.2 % of its texels.
void lay_out_by_uv(const Scene& scene, const std::vector<std::unique_ptr<Adjacency>>& adjacencies,
                   const ChartOptions& options, bool power_of_two, Plan& plan);

}  // namespace penumbra::bake
