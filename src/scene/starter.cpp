#include "scene/starter.h"

namespace penumbra {

std::string_view starter_scene() {
  return R"json(// A Penumbra scene: right-handed frame, Y up, metres, linear colours.
// Render it: penumbra render THIS.json -o picture.png
{
  "camera": {
    "position": [2.7, 2.5, 5.4],
    "look_at": [0.20, 0.50, 0],
    "up": [0, 1, 0],            // [0, 1, 0] if left out
    "vertical_fov_deg": 24      // 40 if left out
  },

  // Materials by name; every key of a material may be left out.
  "materials": {
    "floor":  {"diffuse": [0.78, 0.76, 0.72]},
    "clay":   {"diffuse": [0.72, 0.28, 0.16]},
    "glazed": {"diffuse": [0.05, 0.22, 0.34], "specular": [0.04, 0.04, 0.04], "roughness": 0.2},
    "chrome": {"diffuse": [0.03, 0.03, 0.03], "mirror": 0.85},   // mirror: number or [r, g, b]
    "stone":  {"diffuse": [0.58, 0.56, 0.50]}
    // also: "emission": [r, g, b] makes a surface a light, "texture": "picture.png" colours it
  },

  "objects": [
    // A quad spans edge_u and edge_v from a corner; its front faces along edge_u × edge_v.
    {"type": "quad", "name": "floor", "corner": [-40, 0, 40], "edge_u": [80, 0, 0],
     "edge_v": [0, 0, -80], "material": "floor"},
    {"type": "sphere", "center": [-0.95, 0.60, -0.25], "radius": 0.60, "material": "clay"},
    {"type": "sphere", "center": [0.20, 0.35, 0.80], "radius": 0.35, "material": "glazed"},
    {"type": "sphere", "center": [1.00, 1.02, -0.45], "radius": 0.42, "material": "chrome"},
    {"type": "box", "min": [0.50, 0, -0.95], "max": [1.50, 0.60, 0.05], "material": "stone"}
    // also: {"type": "polygon", "vertices": [[x, y, z], ...], "material": "stone"}
    //       {"type": "mesh", "file": "bunny.obj", "material": "clay",
    //        "transform": {"translate": [0, 0, 0], "rotate_deg": [0, 90, 0], "scale": 2}}
  ],

  "lights": [
    // The larger the radius, the softer the shadows. Also: disk, rect, segment, point, sun.
    {"type": "sphere", "name": "key", "position": [-4.5, 7.0, 3.5], "radius": 0.9,
     "radiance": [75, 68, 58]}
  ],

  "ambient": [0.16, 0.19, 0.24],      // from everywhere, unshadowed
  "background": [0.45, 0.55, 0.68]    // where nothing is seen
}
)json";
}

}  // namespace penumbra
