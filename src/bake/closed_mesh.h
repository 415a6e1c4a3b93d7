// Meshes that have an inside.
#pragma once

#include "scene/scene.h"

namespace penumbra::bake {

/// 1 if the mesh is closed and its triangles wind counter-clockwise seen from outside, −1 if
/// clockwise, 0 if it is open. Vertices in the same place are the same. An edge is closed if as
/// many triangles pass it one way as the other; all are looked at in one sum of signed hashes,
/// which is zero by accident once in 2⁶⁴.
int outer_side(const Mesh& mesh);

}  // namespace penumbra::bake
