#include "sdf/glsl/numbers.h"

#include <fmt/format.h>

namespace penumbra::sdf {

std::string number(double value) {
  std::string text = fmt::format("{}", static_cast<float>(value));
  if (text.find_first_of(".en") == text.npos) text += ".0";
  return text;
}

std::string vector(std::span<const double> v) {
  if (v[0] == v[1] && v[1] == v[2]) return "vec3(" + number(v[0]) + ')';
  return "vec3(" + number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]) + ')';
}

std::string vector(const Vec3d& v) {
  const double numbers[3] = {v.x, v.y, v.z};
  return vector(numbers);
}

}  // namespace penumbra::sdf
