// What a cone is asked for.
#pragma once

#include <cmath>

#include "base/vec.h"

namespace penumbra {

struct ConeQuery {
  Vec3 origin;
  Vec3 direction;             ///< unit
  float distance = INFINITY;  ///< to the light; occluders beyond do not count
  float outer = 0;            ///< clearance from which on nothing matters, > 0: D / A
  Vec3 horizon;       ///< unit normal at the origin: what is not above this plane is no occluder
  float epsilon = 0;  ///< metres above the plane that still lie on it
  bool has_plane = false;      ///< a flat light's plane: what is not in front of it is no occluder
  Vec3 plane_normal;           ///< unit, towards the origin
  float plane_distance = 0;    ///< of the origin in front of it, metres
  float plane_epsilon = 0;     ///< metres in front of it that still lie on it
  int excluded_instance = -1;  ///< a mesh light's: no occluder
  bool lower_bound = false;    ///< never more than the true clearance, where the answer otherwise
                               ///< is: spheres by their tangents, cut-outs without their holes
};

}  // namespace penumbra
