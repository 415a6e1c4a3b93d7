#include "scene/sdf_schema.h"
#include "scene/starter.h"

namespace penumbra {

namespace {

constexpr std::string_view before_sdf = R"json({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "Penumbra scene",
  "description": "Right-handed frame, Y up, metres, linear sRGB. Scene files may hold // and /* */ comments.",
  "type": "object",
  "additionalProperties": false,
  "required": ["objects"],
  "not": {"required": ["camera", "cameras"]},
  "properties": {
    "$schema": {"type": "string", "description": "Names this schema, for editors."},
    "camera": {"$ref": "#/$defs/camera"},
    "cameras": {
      "description": "Several cameras by name; the first is the default.",
      "type": "object",
      "additionalProperties": {"$ref": "#/$defs/camera"}
    },
    "materials": {
      "description": "Materials by name.",
      "type": "object",
      "additionalProperties": {"$ref": "#/$defs/material"}
    },
    "objects": {"type": "array", "items": {"$ref": "#/$defs/object"}},
    "lights": {"type": "array", "items": {"$ref": "#/$defs/light"}},
    "ambient": {
      "description": "Radiance from everywhere, unshadowed.",
      "$ref": "#/$defs/light_colour", "default": [0.05, 0.05, 0.05]
    },
    "background": {
      "description": "Radiance where nothing is seen.",
      "$ref": "#/$defs/light_colour", "default": [0, 0, 0]
    }
  },
  "$defs": {
    "coordinate": {"type": "number", "minimum": -1e9, "maximum": 1e9},
    "point": {"type": "array", "items": {"$ref": "#/$defs/coordinate"}, "minItems": 3, "maxItems": 3},
    "nonzero_vector": {
      "description": "Of any length but zero.",
      "$ref": "#/$defs/point",
      "not": {"items": {"const": 0}}
    },
    "positive": {"type": "number", "minimum": 1e-12, "maximum": 1e9},
    "unit_interval": {"type": "number", "minimum": 0, "maximum": 1},
    "albedo": {"type": "array", "items": {"$ref": "#/$defs/unit_interval"}, "minItems": 3, "maxItems": 3},
    "light_colour": {
      "type": "array", "items": {"type": "number", "minimum": 0, "maximum": 1e12},
      "minItems": 3, "maxItems": 3
    },
    "scale": {
      "type": "number", "minimum": -1e9, "maximum": 1e9,
      "not": {"exclusiveMinimum": -1e-12, "exclusiveMaximum": 1e-12}
    },
    "text": {"type": "string", "pattern": "^[^\\u0000-\\u001f]*$"},
    "file": {"type": "string", "pattern": "^[^\\u0000-\\u001f]+$", "description": "Relative to the scene file."},

    "camera": {
      "type": "object",
      "additionalProperties": false,
      "required": ["position", "look_at"],
      "properties": {
        "position": {"$ref": "#/$defs/point"},
        "look_at": {"$ref": "#/$defs/point"},
        "up": {"$ref": "#/$defs/nonzero_vector", "default": [0, 1, 0]},
        "vertical_fov_deg": {"type": "number", "minimum": 0.001, "maximum": 179.999, "default": 40},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"}
      }
    },

    "material": {
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "diffuse": {"$ref": "#/$defs/albedo", "default": [0.8, 0.8, 0.8]},
        "specular": {"$ref": "#/$defs/albedo", "default": [0, 0, 0]},
        "roughness": {"$ref": "#/$defs/unit_interval", "default": 0.5},
        "mirror": {"anyOf": [{"$ref": "#/$defs/unit_interval"}, {"$ref": "#/$defs/albedo"}], "default": 0},
        "emission": {"$ref": "#/$defs/light_colour", "default": [0, 0, 0]},
        "texture": {"$ref": "#/$defs/file"},
        "emission_texture": {"$ref": "#/$defs/file", "description": "Multiplies the emission; sampled where it is bright."}
      }
    },

    "object": {
      "type": "object",
      "required": ["type"],
      "properties": {"type": {"enum": ["quad", "sphere", "box", "polygon", "mesh", "sdf", "glsl"]}},
      "oneOf": [
        {"$ref": "#/$defs/quad_object"},
        {"$ref": "#/$defs/sphere_object"},
        {"$ref": "#/$defs/box_object"},
        {"$ref": "#/$defs/polygon_object"},
        {"$ref": "#/$defs/mesh_object"},
        {"$ref": "#/$defs/sdf_object"},
        {"$ref": "#/$defs/glsl_object"}
      ]
    },
    "keyframes": {
      "description": "Values of keys of the thing at moments, in the order of time; they move between.",
      "type": "array",
      "items": {
        "type": "object",
        "required": ["time"],
        "properties": {"time": {"type": "number", "minimum": -1e9, "maximum": 1e9, "description": "Seconds."}}
      },
      "minItems": 1
    },
    "interpolation": {
      "description": "Between keyframes: straight, or with eased ends.",
      "enum": ["linear", "smooth"], "default": "linear"
    },
    "receives": {
      "description": "Whether bake gives it textures of light and shadow.",
      "type": "boolean", "default": true
    },
    "samples_scale": {
      "description": "Multiplies the points that bake takes on each light for its surfaces.",
      "type": "number", "minimum": 0.001, "maximum": 1000, "default": 1
    },
    "quad_object": {
      "additionalProperties": false,
      "required": ["type", "corner", "edge_u", "edge_v", "material"],
      "properties": {
        "type": {"const": "quad"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "receives": {"$ref": "#/$defs/receives"},
        "samples_scale": {"$ref": "#/$defs/samples_scale"},
        "corner": {"$ref": "#/$defs/point"},
        "edge_u": {"$ref": "#/$defs/nonzero_vector"},
        "edge_v": {"$ref": "#/$defs/nonzero_vector"},
        "material": {"$ref": "#/$defs/text"}
      }
    },
    "sphere_object": {
      "additionalProperties": false,
      "required": ["type", "center", "radius", "material"],
      "properties": {
        "type": {"const": "sphere"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "receives": {"$ref": "#/$defs/receives"},
        "samples_scale": {"$ref": "#/$defs/samples_scale"},
        "center": {"$ref": "#/$defs/point"},
        "radius": {"$ref": "#/$defs/positive"},
        "material": {"$ref": "#/$defs/text"}
      }
    },
    "box_object": {
      "additionalProperties": false,
      "required": ["type", "min", "max", "material"],
      "properties": {
        "type": {"const": "box"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "receives": {"$ref": "#/$defs/receives"},
        "samples_scale": {"$ref": "#/$defs/samples_scale"},
        "min": {"$ref": "#/$defs/point"},
        "max": {"$ref": "#/$defs/point"},
        "material": {"$ref": "#/$defs/text"}
      }
    },
    "polygon_object": {
      "additionalProperties": false,
      "required": ["type", "vertices", "material"],
      "properties": {
        "type": {"const": "polygon"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "receives": {"$ref": "#/$defs/receives"},
        "samples_scale": {"$ref": "#/$defs/samples_scale"},
        "vertices": {"type": "array", "items": {"$ref": "#/$defs/point"}, "minItems": 3, "maxItems": 1000},
        "material": {"$ref": "#/$defs/text"}
      }
    },
    "mesh_object": {
      "additionalProperties": false,
      "required": ["type", "file"],
      "properties": {
        "type": {"const": "mesh"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "receives": {"$ref": "#/$defs/receives"},
        "samples_scale": {"$ref": "#/$defs/samples_scale"},
        "file": {"$ref": "#/$defs/file"},
        "transform": {"$ref": "#/$defs/transform"},
        "material": {"$ref": "#/$defs/text"}
      }
    },
    "sdf_object": {
      "additionalProperties": false,
      "required": ["type", "root", "material"],
      "properties": {
        "type": {"const": "sdf"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "receives": {"$ref": "#/$defs/receives"},
        "samples_scale": {"$ref": "#/$defs/samples_scale"},
        "root": {"$ref": "#/$defs/sdf_node"},
        "material": {"$ref": "#/$defs/text", "description": "Of nodes without their own."}
      }
    },
    "glsl_object": {
      "additionalProperties": false,
      "required": ["type", "file"],
      "properties": {
        "type": {"const": "glsl"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "receives": {"$ref": "#/$defs/receives"},
        "samples_scale": {"$ref": "#/$defs/samples_scale"},
        "file": {"$ref": "#/$defs/file"}
      }
    },
)json";

constexpr std::string_view after_sdf = R"json(
    "transform": {
      "description": "Scaled, then turned about x, y and z in this order, then moved.",
      "type": "object",
      "additionalProperties": false,
      "properties": {
        "translate": {"$ref": "#/$defs/point", "default": [0, 0, 0]},
        "rotate_deg": {
          "type": "array", "items": {"type": "number", "minimum": -1e6, "maximum": 1e6},
          "minItems": 3, "maxItems": 3, "default": [0, 0, 0]
        },
        "scale": {
          "anyOf": [
            {"$ref": "#/$defs/scale"},
            {"type": "array", "items": {"$ref": "#/$defs/scale"}, "minItems": 3, "maxItems": 3}
          ],
          "default": 1
        }
      }
    },

    "light": {
      "type": "object",
      "required": ["type"],
      "properties": {"type": {"enum": ["sphere", "disk", "rect", "segment", "point", "sun"]}},
      "oneOf": [
        {"$ref": "#/$defs/sphere_light"},
        {"$ref": "#/$defs/disk_light"},
        {"$ref": "#/$defs/rect_light"},
        {"$ref": "#/$defs/segment_light"},
        {"$ref": "#/$defs/point_light"},
        {"$ref": "#/$defs/sun_light"}
      ]
    },
    "sphere_light": {
      "additionalProperties": false,
      "required": ["type", "position", "radius", "radiance"],
      "properties": {
        "type": {"const": "sphere"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "position": {"$ref": "#/$defs/point"},
        "radius": {"$ref": "#/$defs/positive"},
        "radiance": {"$ref": "#/$defs/light_colour"}
      }
    },
    "disk_light": {
      "additionalProperties": false,
      "required": ["type", "position", "normal", "radius", "radiance"],
      "properties": {
        "type": {"const": "disk"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "position": {"$ref": "#/$defs/point"},
        "normal": {"$ref": "#/$defs/nonzero_vector", "description": "The side that emits."},
        "radius": {"$ref": "#/$defs/positive"},
        "radiance": {"$ref": "#/$defs/light_colour"}
      }
    },
    "rect_light": {
      "description": "Emits along edge_u × edge_v.",
      "additionalProperties": false,
      "required": ["type", "corner", "edge_u", "edge_v", "radiance"],
      "properties": {
        "type": {"const": "rect"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "corner": {"$ref": "#/$defs/point"},
        "edge_u": {"$ref": "#/$defs/nonzero_vector"},
        "edge_v": {"$ref": "#/$defs/nonzero_vector"},
        "radiance": {"$ref": "#/$defs/light_colour"},
        "texture": {"$ref": "#/$defs/file", "description": "Multiplies the radiance: a window that is seen and stands in the way of other lights."}
      }
    },
    "segment_light": {
      "additionalProperties": false,
      "required": ["type", "from", "to", "radius", "radiance"],
      "properties": {
        "type": {"const": "segment"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "from": {"$ref": "#/$defs/point"},
        "to": {"$ref": "#/$defs/point"},
        "radius": {"$ref": "#/$defs/positive"},
        "radiance": {"$ref": "#/$defs/light_colour"}
      }
    },
    "point_light": {
      "additionalProperties": false,
      "required": ["type", "position", "intensity"],
      "properties": {
        "type": {"const": "point"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "position": {"$ref": "#/$defs/point"},
        "intensity": {"$ref": "#/$defs/light_colour"}
      }
    },
    "sun_light": {
      "additionalProperties": false,
      "required": ["type", "direction", "irradiance"],
      "properties": {
        "type": {"const": "sun"},
        "name": {"$ref": "#/$defs/text"},
        "keyframes": {"$ref": "#/$defs/keyframes"},
        "interpolation": {"$ref": "#/$defs/interpolation"},
        "direction": {"$ref": "#/$defs/nonzero_vector", "description": "The way the light travels."},
        "angular_diameter_deg": {"type": "number", "minimum": 0, "maximum": 179.999, "default": 0.53},
        "irradiance": {"$ref": "#/$defs/light_colour"}
      }
    }
  }
}
)json";

}  // namespace

std::string_view scene_schema() {
  static const std::string text = std::string(before_sdf).append(sdf_schema()).append(after_sdf);
  return text;
}

}  // namespace penumbra
