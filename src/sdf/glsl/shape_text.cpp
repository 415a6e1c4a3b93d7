#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sdf/glsl/numbers.h"
#include "sdf/glsl/tree_text.h"

namespace penumbra::sdf {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

std::string moved(const std::string& point, std::span<const double> center) {
  if (center[0] == 0 && center[1] == 0 && center[2] == 0) return point;
  return point + " - " + vector(center);
}

// ", a, b" of the numbers from the fourth on.
std::string rest(std::span<const double> n) {
  std::string text;
  for (const double x : n.subspan(3)) text += ", " + number(x);
  return text;
}

}  // namespace

std::string TreeText::profile(const SdfNode& node, std::uint32_t index, const std::string& q) {
  const auto n = tree_.profile_numbers(node);
  if (node.profile == SdfProfile::circle)
    return fmt::format("pnb_sd_circle({}, {})", q, number(n[0]));
  if (node.profile == SdfProfile::box)
    return fmt::format("pnb_sd_rectangle({}, vec2({}, {}))", q, number(n[0]), number(n[1]));
  const std::string name = fmt::format("{}_outline{}", name_, index);
  if (!shade_) outlines_ += outline_function(name, n) + '\n';  // the other functions share it
  return name + '(' + q + ')';
}

std::string TreeText::shape(const SdfNode& node, std::uint32_t index, const std::string& p) {
  const auto n = tree_.numbers_of(node);
  const std::string name = std::string("pnb_sd_") + signature_of(node.op).name;
  if (node.op == SdfOp::plane)
    return fmt::format("{}({}, {}, {})", name, p, vector(n), number(n[3]));
  if (node.op == SdfOp::capsule)
    return fmt::format("{}({}, {}, {}, {})", name, p, vector(n), vector(n.subspan(3)),
                       number(n[6]));
  const std::string q = moved(p, n);
  switch (node.op) {
    case SdfOp::box:
    case SdfOp::ellipsoid:
      return fmt::format("{}({}, {})", name, q, vector(n.subspan(3)));
    case SdfOp::round_box:
      return fmt::format("{}({}, {}, {})", name, q, vector(n.subspan(3)), number(n[6]));
    case SdfOp::capped_torus:
      return fmt::format("{}({}, vec2({}, {}), {}, {})", name, q, number(std::sin(n[3] * kRadians)),
                         number(std::cos(n[3] * kRadians)), number(n[4]), number(n[5]));
    case SdfOp::cone:
      return fmt::format("{}({}, {}, {})", name, q, number(n[4] * std::tan(n[3] * kRadians)),
                         number(n[4]));
    case SdfOp::extrusion:
      return fmt::format("pnb_extruded({}, ({}).z, {})", profile(node, index, '(' + q + ").xy"), q,
                         number(n[3]));
    case SdfOp::revolution:
      return profile(node, index, fmt::format("pnb_revolved({}, {})", q, number(n[3])));
    default:
      return name + '(' + q + rest(n) + ')';
  }
}

std::string outline_function(const std::string& name, std::span<const double> vertices) {
  const std::size_t count = vertices.size() / 2;
  std::string list;
  for (std::size_t i = 0; i < count; ++i)
    list += fmt::format("{}vec2({}, {})", i == 0 ? "" : ", ", number(vertices[2 * i]),
                        number(vertices[2 * i + 1]));
  return fmt::format(R"(float {0}(vec2 p) {{
  const vec2 v[{1}] = vec2[{1}]({2});
  float d = 1e30;
  bool inside = false;
  for (int i = 0, j = {1} - 1; i < {1}; j = i, ++i) {{
    vec2 e = v[j] - v[i], w = p - v[i], b = w - e * clamp(dot(w, e) / dot(e, e), 0.0, 1.0);
    d = min(d, dot(b, b));
    bool above = p.y >= v[i].y, below = p.y < v[j].y, left = e.x * w.y < e.y * w.x;
    if ((above && below && !left) || (!above && !below && left)) inside = !inside;
  }}
  return inside ? -sqrt(d) : sqrt(d);
}}
)",
                     name, count, list);
}

}  // namespace penumbra::sdf
