// The rays of eight receivers to the centre of one light.
#pragma once

#include <span>

#include "geometry/embree_shim.h"
#include "shadow/shadows.h"

namespace penumbra {

/// Lights whose centre does not depend on the receiver: all but mesh lights.
struct CentreLight {
  bool endless = false;  ///< a sun: `at` is the unit direction to it
  Vec3 at;               ///< the centre
  bool flat = false;     ///< `normal` is that of its plane
  Vec3 normal;
  float epsilon = 0;        ///< of the centre, see World::epsilon_at
  float least_epsilon = 0;  ///< of receivers, see World::epsilon_at
  float roundings = 0;      ///< epsilon per metre of the greatest coordinate
};

/// Writes the rays of 1 to 8 receivers; valid[i] is −1 for those whose light is above the horizon
/// and 0 for the others and the unused. The same values as Shadows::visibility() computes.
void make_centre_rays(std::span<const Receiver> receivers, const CentreLight& light, RTCRay8& rays,
                      int* valid);

}  // namespace penumbra
