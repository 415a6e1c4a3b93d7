#include "render/glsl/fraction_text.h"

namespace penumbra {
namespace {

// The published function of a method.
std::string march(const ShadowOptions& shadows) {
  if (shadows.kind == ShadowKind::sdf_improved) return "improved";
  if (shadows.kind == ShadowKind::sdf_inner)
    return shadows.variant == SdfVariant::abs ? "abs" : "inner";
  return shadows.variant == SdfVariant::blog ? "blog" : "classic";
}

std::string body(const ShadowOptions& shadows) {
  if (shadows.kind == ShadowKind::hard && !shadows.marches_field())
    return "  reach = pnb_centre_reach(l, p, direction, reach);\n"
           "  return dot(direction, n) > 0.0 ? pnb_visible(p, n, direction, reach, l.own) : 0.0;\n";
  const std::string reach = "  if (l.type == 5) reach = max(pnb_span(p, direction).y, 0.0);\n";
  if (shadows.kind == ShadowKind::hard)
    return reach + "  return penumbra_shadow_hard(p, direction, pnb_mint, reach);\n";
  return "  if (pnb_k > 0.0) w = 1.0 / pnb_k;\n" + reach + "  return penumbra_shadow_" +
         march(shadows) + "(p, direction, pnb_mint, reach, w);\n";
}

}  // namespace

std::string fraction_function(const ShadowOptions& shadows) {
  if (shadows.kind == ShadowKind::none || shadows.kind == ShadowKind::area)
    return "\nfloat pnb_fraction(pnb_Light l, vec3 p, vec3 n) { return 1.0; }\n\n";
  return "\n"
         "// What part of the light is seen from p.\n"
         "float pnb_fraction(pnb_Light l, vec3 p, vec3 n) {\n"
         "  vec3 direction;\n"
         "  float reach, w;\n"
         "  if (!pnb_view(l, p, direction, reach, w)) return 0.0;\n" +
         body(shadows) + "}\n\n";
}

}  // namespace penumbra
