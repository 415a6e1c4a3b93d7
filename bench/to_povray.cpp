// A scene file as a POV-Ray scene that shows the first light's visible fraction: everything is
// white and diffuse, nothing is ambient, so the picture with shadows divided by the one without is
// that fraction.
//   to_povray SCENE.json >OUT.pov       then povray Declare=Shadows=0 (none), 1 (hard), 2 (area)
// Takes spheres, boxes and quads, and a sphere light.
#include <fmt/format.h>
#include <json/reader.h>

#include <cmath>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/load.h"

namespace penumbra::bench {
namespace {

std::string pov(const Vec3d& v) {
  return fmt::format("<{:.17g}, {:.17g}, {:.17g}>", v.x, v.y, v.z);
}
std::string pov(const Vec3& v) { return pov(Vec3d(v)); }

Vec3d vector(const Json::Value& json) {
  return {json[0].asDouble(), json[1].asDouble(), json[2].asDouble()};
}

/// POV-Ray's frame is left-handed. Its camera takes any three vectors, so ours is written out: the
/// picture is right and up wide and high at one unit along the direction.
std::string camera(const Camera& c) {
  const Vec3d forward = normalize(Vec3d(c.look_at) - Vec3d(c.position));
  const Vec3d right = normalize(cross(forward, Vec3d(c.up)));
  const Vec3d up = cross(right, forward);
  const double tall = 2 * std::tan(static_cast<double>(c.vertical_fov) / 2);
  return fmt::format("camera {{ perspective location {} direction {} right {} up {} }}\n",
                     pov(c.position), pov(forward), pov(right * tall), pov(up * tall));
}

std::string light(const Light& l) {
  const double d = 2 * static_cast<double>(l.radius);
  return fmt::format(
      "light_source {{\n  {} rgb 1\n#if (Shadows = 0) shadowless #end\n#if (Shadows = 2)\n"
      "  area_light x * {:.17g}, z * {:.17g}, 17, 17 adaptive 1 jitter circular orient\n#end\n}}\n",
      pov(l.position), d, d);
}

std::string quad(const Json::Value& json) {
  const Vec3d corner = vector(json["corner"]), u = vector(json["edge_u"]),
              v = vector(json["edge_v"]);
  return fmt::format("polygon {{ 5, {}, {}, {}, {}, {} }}\n", pov(corner), pov(corner + u),
                     pov(corner + u + v), pov(corner + v), pov(corner));
}

std::string object(const Json::Value& json) {
  const std::string type = json["type"].asString();
  if (type == "sphere")
    return fmt::format("sphere {{ {}, {:.17g} }}\n", pov(vector(json["center"])),
                       json["radius"].asDouble());
  if (type == "box")
    return fmt::format("box {{ {}, {} }}\n", pov(vector(json["min"])), pov(vector(json["max"])));
  if (type == "quad") return quad(json);
  throw InputError("objects of type " + type + " are not converted", "leave them out");
}

std::string convert(const std::string& file) {
  const Scene scene = load_scene(file);
  Json::Value json;
  Json::Reader reader;
  if (!reader.parse(read_file(file), json)) throw InputError({file}, "is no JSON", "check it");
  if (scene.lights.front().type != LightType::sphere)
    throw InputError({file}, "its first light is no sphere", "put a sphere light first");
  std::string out =
      "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#ifndef (Shadows) #declare Shadows = 2; "
      "#end\n#default { texture { pigment { rgb 1 } finish { diffuse 1 ambient 0 } } }\n";
  out += camera(scene.cameras.front()) + light(scene.lights.front());
  for (const Json::Value& o : json["objects"]) out += object(o);
  return out;
}

}  // namespace
}  // namespace penumbra::bench

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw penumbra::InputError("one scene is needed", "to_povray SCENE.json");
    fmt::print("{}", penumbra::bench::convert(argv[1]));
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "to_povray: {}\n", e.what());
    return 2;
  }
}
