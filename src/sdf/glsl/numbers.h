// Numbers as GLSL. Internal to the room.
#pragma once

#include <span>
#include <string>

#include "base/vec.h"

namespace penumbra::sdf {

/// The shortest digits that give the float back, with a point.
std::string number(double value);
/// "vec3(x, y, z)" of the first three.
std::string vector(std::span<const double> v);
std::string vector(const Vec3d& v);

}  // namespace penumbra::sdf
