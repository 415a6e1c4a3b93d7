// What a bake keeps.
#pragma once

#include <cstdint>

namespace penumbra::bake {

enum class Store : std::uint8_t {
  radiance,    ///< bake()
  visibility,  ///< a texture of visible fractions for each light, weighted as equation (1) has them
  samples      ///< one bit for each texel and sample of a light
};

}  // namespace penumbra::bake
