// How far a scene reaches, also where it has no end.
#pragma once

#include <optional>

#include "scene/scene.h"

namespace penumbra {

/// False if a distance field goes on for ever, or there is a shader: nobody knows how far that
/// goes.
bool is_bounded(const Scene& scene);

/// The scene's bounding box. What has no end counts as far as cameras look: with a cube about each
/// camera's look_at whose faces are as far from it as the camera; without cameras ±4 m.
Bounds extent_of(const Scene& scene);

/// Where published marches to a sun end, once it is enlarged on every side by its diagonal: the
/// box of all that has an end; the extent where nothing has.
Bounds sun_bounds(const Scene& scene);

/// Rays that meet nothing end where they leave the extent; in a scene without end after this many
/// of its diagonals.
inline constexpr float sight_in_diagonals = 1000;

/// Where a distance-field tree loses its end: the shape that has none, or the operator whose
/// children have one. Nothing if it is bounded.
std::optional<std::uint32_t> unbounded_node(const SdfTree& tree);

}  // namespace penumbra
