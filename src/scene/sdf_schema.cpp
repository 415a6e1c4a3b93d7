#include "scene/sdf_schema.h"

#include <fmt/format.h>

#include "scene/sdf.h"

namespace penumbra {
namespace {

std::string_view number_schema(SdfRule rule) {
  switch (rule) {
    case SdfRule::positive:
      return R"({"$ref": "#/$defs/positive"})";
    case SdfRule::non_negative:
      return R"({"type": "number", "minimum": 0, "maximum": 1e9})";
    case SdfRule::nonzero:
      return R"({"$ref": "#/$defs/scale"})";
    case SdfRule::angle_deg:
      return R"({"type": "number", "minimum": -1e6, "maximum": 1e6})";
    case SdfRule::acute_deg:
      return R"({"type": "number", "minimum": 0.001, "maximum": 89.999})";
    case SdfRule::aperture_deg:
      return R"({"type": "number", "minimum": 0.001, "maximum": 180})";
    case SdfRule::whole:
      return R"({"type": "integer", "minimum": 0, "maximum": 1e6})";
    default:
      return R"({"$ref": "#/$defs/coordinate"})";
  }
}

std::string value_schema(const SdfParameter& p) {
  if (p.rule == SdfRule::axes) return R"({"enum": ["x", "y", "z", "xy", "xz", "yz", "xyz"]})";
  if (p.rule == SdfRule::direction) return R"({"$ref": "#/$defs/nonzero_vector"})";
  const std::string_view one = number_schema(p.rule);
  if (p.count == 1) return std::string(one);
  const std::string three =
      fmt::format(R"({{"type": "array", "items": {}, "minItems": 3, "maxItems": 3}})", one);
  return p.one_for_all ? fmt::format(R"({{"anyOf": [{}, {}]}})", one, three) : three;
}

class Definition {
 public:
  explicit Definition(const SdfSignature& signature) : signature_(signature) {
    const char* kind = signature.kind == SdfKind::shape ? "shape" : "op";
    require(kind, fmt::format(R"({{"const": "{}"}})", signature.name));
    add("material", R"({"$ref": "#/$defs/text"})");
    add("keyframes", R"({"$ref": "#/$defs/keyframes"})");
    add("interpolation", R"({"$ref": "#/$defs/interpolation"})");
    for (const SdfParameter& p : signature.parameters) add_parameter(p);
    if (signature.has_profile) require("profile", R"({"$ref": "#/$defs/sdf_profile"})");
    if (signature.most_children > 0) add_children();
  }

  std::string text() const {
    return fmt::format(
        "    \"sdf_{}\": {{\n      \"additionalProperties\": false,\n      \"required\": [{}],{}\n"
        "      \"properties\": {{\n{}\n      }}\n    }},\n",
        signature_.name, required_, choice_, properties_);
  }

 private:
  void add(std::string_view key, std::string_view value) {
    properties_ +=
        fmt::format("{}        \"{}\": {}", properties_.empty() ? "" : ",\n", key, value);
  }
  void require(std::string_view key, std::string_view value) {
    add(key, value);
    required_ += fmt::format("{}\"{}\"", required_.empty() ? "" : ", ", key);
  }
  void add_parameter(const SdfParameter& p) {
    const bool has_twin = signature_.op == SdfOp::box && p.required;
    if (p.required && !has_twin)
      require(p.key, value_schema(p));
    else
      add(p.key, value_schema(p));
    if (has_twin) {
      add("min", R"({"$ref": "#/$defs/point"})");
      add("max", R"({"$ref": "#/$defs/point"})");
      choose(R"({"required": ["half_size"]})", R"({"required": ["min", "max"]})");
    }
    if (signature_.op == SdfOp::plane && !p.required) add("point", R"({"$ref": "#/$defs/point"})");
  }
  void add_children() {
    const std::string_view node = R"({"$ref": "#/$defs/sdf_node"})";
    const bool one = signature_.most_children == 1;
    const std::string list = fmt::format(R"({{"type": "array", "items": {}, "minItems": 1{}}})",
                                         node, one ? R"(, "maxItems": 1)" : "");
    if (!one) return require("children", list);
    add("child", node);
    add("children", list);
    choose(R"({"required": ["child"]})", R"({"required": ["children"]})");
  }
  void choose(std::string_view a, std::string_view b) {
    choice_ = fmt::format("\n      \"anyOf\": [{}, {}],", a, b);
  }

  const SdfSignature& signature_;
  std::string required_, properties_, choice_;
};

constexpr std::string_view profile_schema = R"(    "sdf_profile": {
      "type": "object",
      "properties": {"shape": {"enum": ["circle", "box", "polygon"]}},
      "oneOf": [
        {"$ref": "#/$defs/sdf_circle_profile"},
        {"$ref": "#/$defs/sdf_box_profile"},
        {"$ref": "#/$defs/sdf_polygon_profile"}
      ]
    },
    "sdf_circle_profile": {
      "additionalProperties": false,
      "required": ["shape", "radius"],
      "properties": {"shape": {"const": "circle"}, "radius": {"$ref": "#/$defs/positive"}}
    },
    "sdf_box_profile": {
      "additionalProperties": false,
      "required": ["shape", "half_size"],
      "properties": {
        "shape": {"const": "box"},
        "half_size": {"type": "array", "items": {"$ref": "#/$defs/positive"}, "minItems": 2, "maxItems": 2}
      }
    },
    "sdf_polygon_profile": {
      "additionalProperties": false,
      "required": ["shape", "vertices"],
      "properties": {
        "shape": {"const": "polygon"},
        "vertices": {
          "type": "array", "minItems": 3, "maxItems": 1000,
          "items": {"type": "array", "items": {"$ref": "#/$defs/coordinate"}, "minItems": 2, "maxItems": 2}
        }
      }
    },
)";

std::string parameter_text(const SdfParameter& p) {
  if (p.required) return fmt::format("`{}`", p.key);
  if (p.rule == SdfRule::whole) return fmt::format("`{}` (none)", p.key);
  return fmt::format("`{}` ({})", p.key, p.count == 3 ? "[0, 0, 0]" : "0");
}

}  // namespace

std::string sdf_schema() {
  std::string nodes, definitions;
  for (const SdfSignature& signature : sdf_signatures()) {
    nodes += fmt::format("{}        {{\"$ref\": \"#/$defs/sdf_{}\"}}", nodes.empty() ? "" : ",\n",
                         signature.name);
    definitions += Definition(signature).text();
  }
  return fmt::format(
      "    \"sdf_node\": {{\n      \"type\": \"object\",\n      \"oneOf\": [\n{}\n      ]\n    "
      "}},\n"
      "{}{}",
      nodes, definitions, profile_schema);
}

std::string sdf_manual_rows(SdfKind kind) {
  std::string rows;
  for (const SdfSignature& signature : sdf_signatures()) {
    if (signature.kind != kind) continue;
    std::string parameters;
    for (const SdfParameter& p : signature.parameters)
      parameters += fmt::format("{}{}", parameters.empty() ? "" : ", ", parameter_text(p));
    if (signature.has_profile) parameters += ", `profile`";
    rows += fmt::format("| `{}` | {} | {} |\n", signature.name, parameters, signature.meaning);
  }
  return rows;
}

}  // namespace penumbra
