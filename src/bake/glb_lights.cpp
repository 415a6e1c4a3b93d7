#include "bake/glb_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra::bake {
namespace {

using std::numbers::pi;

Json::Value array_of(const Vec3d& v) {
  Json::Value a(Json::arrayValue);
  for (int i = 0; i < 3; ++i) a.append(v[i]);
  return a;
}

/// Colour in [0, 1] and the factor that is left.
void set_emission(const Vec3d& emission, Json::Value& light) {
  const double most = max_component(emission);
  light["intensity"] = most;
  light["color"] = array_of(most > 0 ? emission / most : Vec3d(1, 1, 1));
}

void set_spot(const Light& in, Json::Value& light) {
  light["type"] = "spot";
  const double outer = std::acos(std::clamp(in.spot_cos_outer, 0.0f, 1.0f));
  const double inner = std::acos(std::clamp(in.spot_cos_inner, 0.0f, 1.0f));
  light["spot"]["outerConeAngle"] = outer;
  light["spot"]["innerConeAngle"] = std::min(inner, 0.999 * outer);
}

Json::Value punctual(const Light& in) {
  Json::Value light;
  Vec3d emission(in.emission);
  light["type"] = in.type == LightType::sun ? "directional" : "point";
  if (in.type == LightType::sphere) {
    // Radiance to intensity: the sphere's silhouette has the area π r².
    emission *= pi * in.radius * in.radius;
    light["extras"]["radius"] = static_cast<double>(in.radius);
  }
  if (in.type == LightType::sun)
    light["extras"]["angular_diameter_deg"] = in.angular_diameter * 180 / pi;
  else if (in.spot_cos_outer > -1)
    set_spot(in, light);
  set_emission(emission, light);
  return light;
}

Json::Value area(const Light& in) {
  Json::Value light;
  set_emission(Vec3d(in.emission), light);
  if (in.type == LightType::disk) {
    light["type"] = "disk";
    light["size"] = 2.0 * in.radius;
    return light;
  }
  light["type"] = "rect";
  light["size"] = static_cast<double>(length(in.edge_v));
  light["rect"]["aspect"] = static_cast<double>(length(in.edge_u) / length(in.edge_v));
  return light;
}

bool is_punctual(const Light& light) {
  return light.type == LightType::point || light.type == LightType::sphere ||
         light.type == LightType::sun;
}

bool is_flat(const Light& light) {
  return light.type == LightType::disk || light.type == LightType::rect;
}

/// As scene files have it; of a mesh what it emits.
Json::Value described(const Light& in) {
  Json::Value out;
  out["type"] = to_string(in.type);
  const auto set = [&](const char* key, const Vec3& v) { out[key] = array_of(Vec3d(v)); };
  const Vec3 half_u = in.edge_u * 0.5f, half_v = in.edge_v * 0.5f;
  const bool has_position =
      in.type == LightType::point || in.type == LightType::sphere || in.type == LightType::disk;
  if (has_position) set("position", in.position);
  if (in.type == LightType::disk) set("normal", in.normal);
  if (in.type == LightType::rect)
    set("corner", in.position - half_u - half_v), set("edge_u", in.edge_u),
        set("edge_v", in.edge_v);
  if (in.type == LightType::segment)
    set("from", in.position - half_u), set("to", in.position + half_u);
  if (in.type == LightType::sphere || in.type == LightType::disk || in.type == LightType::segment)
    out["radius"] = static_cast<double>(in.radius);
  if (in.type == LightType::sun) {
    set("direction", in.direction);
    out["angular_diameter_deg"] = in.angular_diameter * 180 / pi;
  }
  set(in.type == LightType::point ? "intensity"
      : in.type == LightType::sun ? "irradiance"
                                  : "radiance",
      in.emission);
  return out;
}

Json::Value matrix_of(const Light& light) {
  if (light.type == LightType::sun) return matrix_facing({}, light.direction, {0, 1, 0});
  const bool turns = is_flat(light) || light.spot_cos_outer > -1;
  const Vec3 up = light.type == LightType::rect ? light.edge_v : Vec3{0, 1, 0};
  return matrix_facing(light.position, turns ? light.normal : Vec3{0, 0, -1}, up);
}

}  // namespace

Json::Value matrix_facing(const Vec3& origin, const Vec3& direction, const Vec3& up) {
  const Vec3d z = normalize(-Vec3d(direction));
  Vec3d x = cross(Vec3d(up), z);
  if (!(length(x) > 1e-6 * length(Vec3d(up)))) x = Vec3d(frame_around(Vec3(z)).u);
  x = normalize(x);
  const Vec3d y = cross(z, x);
  Json::Value m(Json::arrayValue);
  const Vec3d columns[] = {x, y, z, Vec3d(origin)};
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 3; ++r) m.append(columns[c][r]);
    m.append(c == 3 ? 1.0 : 0.0);
  }
  return m;
}

void add_lights(const std::vector<Light>& lights, bool baked, Json::Value& root,
                std::set<std::string>& extensions) {
  for (const Light& light : lights) {
    const bool is_known = is_punctual(light) || is_flat(light);
    if (!is_known && !baked) continue;
    Json::Value node;
    if (!light.name.empty()) node["name"] = light.name;
    if (baked) node["extras"]["baked"] = true, node["extras"]["light"] = described(light);
    if (is_known) {
      const char* name = is_flat(light) ? "EXT_lights_area" : "KHR_lights_punctual";
      extensions.insert(name);
      Json::Value out = is_flat(light) ? area(light) : punctual(light);
      if (baked) out["extras"]["baked"] = true;
      if (!light.name.empty()) out["name"] = light.name;
      Json::Value& list = root["extensions"][name]["lights"];
      node["extensions"][name]["light"] = list.size();
      node["matrix"] = matrix_of(light);
      list.append(out);
    }
    root["nodes"].append(node);
  }
}

}  // namespace penumbra::bake
