// The centre of one light as many receivers see it, side by side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cone_batch.h"
#include "geometry/embree_shim.h"
#include "shadow/shadows.h"

namespace penumbra {

/// Lights whose centre does not depend on the receiver: all but mesh lights.
struct CentreLight {
  bool endless = false;  ///< a sun: `at` is the unit direction to it
  Vec3 at;               ///< the centre
  float diameter = 0;    ///< D; of a sun D / A
  bool flat = false;     ///< `normal` is that of its plane
  Vec3 normal;
  float epsilon = 0;         ///< of the centre, see World::epsilon_at
  float roundings = 0;       ///< World::roundings
  float least_epsilon = 0;   ///< of receivers, see World::epsilon_at
  float least_on_plane = 0;  ///< the same, for distances from the light's plane
};

/// Queries of the receivers whose horizon the light's centre is above, and which they are, rising.
/// Values are those of LightViews::view() and cone_query() to the last bit. What `queries` and
/// `which` held is lost.
void find_centre_views(std::span<const Receiver> receivers, const CentreLight& light,
                       ConeBatch& queries, std::vector<std::uint32_t>& which);

/// The rays of up to eight queries from `first` on, those of Shadows::visibility() to the last bit:
/// valid[i] is −1, and 0 behind the last query. Both are aligned to 32 bytes; of `rays` tnear,
/// time, mask, id and flags are left as they are.
void write_centre_rays(const ConeBatch& queries, std::size_t first, RTCRay8& rays, int* valid);

}  // namespace penumbra
