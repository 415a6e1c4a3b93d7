// What is seen of the lights instead of the light itself (Heckbert and Herf 1997, section 4), so
// that lights may change their colours and surfaces may shine.
#pragma once

#include "bake/bake.h"
#include "bake/store.h"

namespace penumbra::bake {

/// The scene's materials and lights as glTF has them, surfaces with their texels in TEXCOORD_1, and
/// what `store` says under `asset.extras.penumbra.store` (docs/baking.md). Surfaces of mesh lights
/// hold nothing. input.irradiance is not asked, `sight` is.
///
/// Throws InputError for lights that glTF has no word for, for what needs more than
/// options.most_bytes, and for samples with supersampling or by OpenGL. The result depends on its
/// arguments alone, not on threads.
Baked bake_store(const BakeInput& input, const BakedIrradiance& sight, const Plan& plan,
                 const TextureOptions& options, Store store, Progress& progress);

}  // namespace penumbra::bake
