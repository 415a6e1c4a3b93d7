// Rays and what they meet.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/vec.h"

namespace penumbra {

/// Origin, unit direction, and how far it reaches.
struct Ray {
  Vec3 origin;
  Vec3 direction;
  float t_max = INFINITY;
};

/// A triangle of an instance, a sphere, or the distance fields.
struct PrimitiveId {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t instance =
      none;                    ///< into Scene::instances; or instances.size() + sphere index; the
                               ///< number after the last sphere's stands for all distance fields
  std::uint32_t triangle = 0;  ///< of the mesh; 0 for the others
};

struct Hit {
  float t = 0;
  float b1 = 0, b2 = 0;  ///< barycentric weights of the triangle's second and third vertex
  PrimitiveId primitive;
};

}  // namespace penumbra
