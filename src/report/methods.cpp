#include "report/methods.h"

#include <algorithm>
#include <array>

namespace penumbra::report {
namespace {

constexpr const char* quilez = "https://iquilezles.org/articles/rmshadows/";

constexpr std::array<MethodText, 7> texts{{
    {ShadowKind::hard, "hard", "One ray to the light's centre (Whitted 1980)",
     "A point is lit if the light's centre is seen from it, and dark if not. "
     "The cheapest of all, with edges as sharp as under a point light.",
     "https://doi.org/10.1145/358876.358882"},
    {ShadowKind::area, "area", "Many points of the light (Cook, Porter and Carpenter 1984)",
     "Rays go to many points of the light, and the share of those that arrive is the visible "
     "fraction. With enough of them it is the truth; with few it is noisy.",
     "https://doi.org/10.1145/800031.808590"},
    {ShadowKind::parker, "parker", "Single-sample soft shadows (Parker, Shirley and Smits 1998)",
     "The nearest miss of the ray to the light's centre, measured in sizes of the light, says how "
     "far into the penumbra a point is. Free of noise, but it knows the outer half of the penumbra "
     "alone, so that the umbra is too large.",
     "http://www.cs.utah.edu/~bes/papers/coneShadow/"},
    {ShadowKind::heckbert_herf, "heckbert-herf", "Averaged hard shadows (Heckbert and Herf 1997)",
     "Hard shadows from many points of the light are averaged into textures on the surfaces, from "
     "which pictures are then drawn. The bake is paid once for all pictures of a scene; texels "
     "blur what is finer than they are.",
     "http://www.cs.cmu.edu/~ph/shadow.html"},
    {ShadowKind::sdf_classic, "sdf-classic", "The closest miss of a march (Quilez 2010)",
     "A march through the distance field towards the light keeps the least ratio of distance to "
     "way. It has the outer half of the penumbra alone, and bands where steps are long.",
     quilez},
    {ShadowKind::sdf_improved, "sdf-improved", "The closest miss between samples (Aaltonen 2018)",
     "As sdf-classic, but the nearest point is estimated between two samples of the march too. "
     "That removes most of the bands; the umbra stays too large.",
     quilez},
    {ShadowKind::sdf_inner, "sdf-inner", "On through the solid (nurof3n, Quilez)",
     "The march goes on inside what it meets, so that the inner half of the penumbra is found as "
     "well. Close to the truth for one thick occluder; light leaks through walls thinner than the "
     "penumbra.",
     quilez},
}};

}  // namespace

std::span<const MethodText> methods() { return texts; }

const MethodText& method_of(ShadowKind kind) {
  return *std::find_if(texts.begin(), texts.end(),
                       [&](const MethodText& text) { return text.kind == kind; });
}

}  // namespace penumbra::report
