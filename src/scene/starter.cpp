#include "scene/starter.h"

namespace penumbra {

std::string_view starter_scene() {
  return R"json(// A Penumbra scene: right-handed frame, Y up, metres, linear colours.
// Render it: penumbra render THIS.json -o picture.png
{
  "camera": {
    "position": [2.6, 1.9, 5.2],
    "look_at": [0.1, 0.45, 0],
    "up": [0, 1, 0],            // optional, as is every key said to be
    "vertical_fov_deg": 32      // optional, 40 if left out
  },

  // Materials by name; every key of a material is optional.
  "materials": {
    "floor":  {"diffuse": [0.75, 0.73, 0.70]},
    "clay":   {"diffuse": [0.72, 0.32, 0.20]},
    "glazed": {"diffuse": [0.10, 0.30, 0.42], "specular": [0.04, 0.04, 0.04], "roughness": 0.15},
    "chrome": {"diffuse": [0.02, 0.02, 0.02], "mirror": 0.85},   // mirror: number or [r, g, b]
    "stone":  {"diffuse": [0.55, 0.55, 0.50]}
    // also: "emission": [r, g, b] makes a surface a light, "texture": "picture.png" colours it
  },

  "objects": [
    // A quad spans edge_u and edge_v from a corner; its front faces along edge_u × edge_v.
    {"type": "quad", "name": "floor", "corner": [-12, 0, 12], "edge_u": [24, 0, 0],
     "edge_v": [0, 0, -24], "material": "floor"},
    {"type": "sphere", "center": [-1.05, 0.55, -0.35], "radius": 0.55, "material": "clay"},
    {"type": "sphere", "center": [0.20, 0.40, 0.65], "radius": 0.40, "material": "glazed"},
    {"type": "sphere", "center": [1.05, 1.00, -0.45], "radius": 0.40, "material": "chrome"},
    {"type": "box", "min": [0.55, 0, -0.95], "max": [1.55, 0.60, 0.05], "material": "stone"}
    // also: {"type": "polygon", "vertices": [[x, y, z], ...], "material": "stone"}
    //       {"type": "mesh", "file": "bunny.obj", "material": "clay",
    //        "transform": {"translate": [0, 0, 0], "rotate_deg": [0, 90, 0], "scale": 2}}
  ],

  "lights": [
    // The larger the radius, the softer the shadows. Also: disk, rect, segment, point, sun.
    {"type": "sphere", "name": "key", "position": [-2.2, 4.2, 2.6], "radius": 0.45,
     "radiance": [40, 37, 32]}
  ],

  "ambient": [0.10, 0.11, 0.13],      // from everywhere, unshadowed
  "background": [0.42, 0.50, 0.60]    // where nothing is seen
}
)json";
}

}  // namespace penumbra
