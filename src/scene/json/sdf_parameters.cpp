#include "scene/json/sdf_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/json/polygon.h"

namespace penumbra::json {
namespace {

struct Rule {
  double lo, hi;
  std::string_view wanted;  ///< completes "give "
};

Rule rule_of(SdfRule rule) {
  switch (rule) {
    case SdfRule::positive:
      return {1e-12, 1e9, "a number above 0 (1e-12 to 1e9)"};
    case SdfRule::non_negative:
      return {0, 1e9, "a number from 0 to 1e9"};
    case SdfRule::angle_deg:
      return {-1e6, 1e6, "an angle in degrees"};
    case SdfRule::acute_deg:
      return {0.001, 89.999, "degrees above 0 and below 90 (0.001 to 89.999)"};
    case SdfRule::aperture_deg:
      return {0.001, 180, "degrees from 0.001 to 180"};
    case SdfRule::whole:
      return {0, 1e6, "a whole number from 0 to 1e6"};
    default:
      return {-1e9, 1e9, "a number of size at most 1e9"};
  }
}

Range range_of(const SdfParameter& parameter) {
  const Rule rule = rule_of(parameter.rule);
  std::string wanted(rule.wanted);
  if (parameter.count == 3 && parameter.one_for_all) wanted += ", or [x, y, z] of such";
  if (parameter.count == 3 && !parameter.one_for_all) wanted = "[x, y, z], each " + wanted;
  return {rule.lo, rule.hi, wanted};
}

At at_key(const ObjectReader& reader, const Json::Value& value, std::string_view key) {
  return {reader.document(), value, key, reader.noun()};
}

void append(std::vector<double>& numbers, const Vec3d& v) {
  numbers.insert(numbers.end(), {v.x, v.y, v.z});
}

void refuse_each(const At& at, const Vec3d& v, bool (*is_bad)(double), const char* remedy) {
  for (int i = 0; i < 3; ++i)
    if (is_bad(v[i])) refuse(at, fmt::format("\"{}\"[{}] is {:g}", at.key, i, v[i]), remedy);
}

Vec3d read_axes(const At& at) {
  const std::string axes = text(at);
  Vec3d v;
  for (const char c : axes) {
    const int axis = c - 'x';
    if (axis < 0 || axis > 2 || v[axis] != 0)
      refuse(at, fmt::format("\"{}\" is \"{}\"", at.key, axes.substr(0, 20)),
             R"(give axes, each once: "x", "yz", "xyz" …)");
    v[axis] = 1;
  }
  if (axes.empty()) refuse(at, fmt::format("\"{}\" is empty", at.key), R"(give "x", "yz" …)");
  return v;
}

Vec3d read_triple(const At& at, const SdfParameter& parameter) {
  if (parameter.rule == SdfRule::axes) return read_axes(at);
  if (parameter.rule == SdfRule::direction) return normalize(Vec3d(nonzero_vector(at)));
  if (parameter.rule == SdfRule::nonzero) return scale(at);
  const Range range = range_of(parameter);
  const Vec3d v = parameter.one_for_all ? triple_or_number(at, range) : triple(at, range);
  if (parameter.rule == SdfRule::whole)
    refuse_each(
        at, v, [](double x) { return x != std::floor(x); }, "give whole numbers");
  return v;
}

void read_parameter(ObjectReader& reader, const SdfParameter& parameter,
                    std::vector<double>& numbers) {
  const Json::Value* value = reader.find(parameter.key);
  if (!value && parameter.required) reader.miss(parameter.key);
  if (!value)
    numbers.insert(numbers.end(), static_cast<std::size_t>(parameter.count), parameter.fallback);
  else if (const At at = at_key(reader, *value, parameter.key); parameter.count == 3)
    append(numbers, read_triple(at, parameter));
  else
    numbers.push_back(number(at, range_of(parameter)));
}

// "min" and "max" in the place of "center" and "half_size".
bool read_corners(ObjectReader& reader, std::vector<double>& numbers) {
  const Json::Value *lo = reader.find("min"), *hi = reader.find("max");
  if (!lo && !hi) return false;
  for (const char* key : {"center", "half_size"})
    if (reader.find(key))
      reader.refuse_key(key,
                        fmt::format("both \"{}\" and \"{}\" are given in {}", key,
                                    lo ? "min" : "max", reader.noun()),
                        R"(give "min" and "max", or "center" and "half_size")");
  Vec3d a, b;
  if (lo) a = Vec3d(point(at_key(reader, *lo, "min")));
  if (hi) b = Vec3d(point(at_key(reader, *hi, "max")));
  if (!lo || !hi) reader.miss(lo ? "max" : "min");
  for (int i = 0; i < 3; ++i)
    if (lo && hi && !(a[i] < b[i]))
      reader.refuse_key(
          "max",
          fmt::format("\"max\" does not lie above \"min\" along {} in {}", "xyz"[i], reader.noun()),
          "give a \"max\" above \"min\" in x, y and z");
  append(numbers, (a + b) * 0.5);
  append(numbers, (b - a) * 0.5);
  return true;
}

// "point" in the place of "offset".
void read_plane(ObjectReader& reader, std::span<const SdfParameter> parameters,
                std::vector<double>& numbers) {
  const std::size_t first = numbers.size();
  read_parameter(reader, parameters[0], numbers);
  const Json::Value* through = reader.find("point");
  read_parameter(reader, parameters[1], numbers);
  if (!through) return;
  if (reader.find("offset"))
    reader.refuse_key("offset",
                      fmt::format("both \"point\" and \"offset\" are given in {}", reader.noun()),
                      "give one of them");
  const Vec3d p(point(at_key(reader, *through, "point")));
  numbers[first + 3] = dot(p, Vec3d(numbers[first], numbers[first + 1], numbers[first + 2]));
}

const Range& positive_range() {
  static const Range range{1e-12, 1e9, "a number above 0 (1e-12 to 1e9)"};
  return range;
}

Vec2 pair_of(const At& at, double x[2], const Range& range) {
  if (!at.value.isArray() || at.value.size() != 2)
    refuse(at, fmt::format("\"{}\" is not two numbers", at.key), "give [x, y]");
  for (int i = 0; i < 2; ++i) x[i] = number({at.document, at.value[i], at.key, at.owner}, range);
  return {};
}

void read_outline(const At& at, std::vector<double>& numbers) {
  static const Range range{-1e9, 1e9, "[x, y], two numbers of size at most 1e9"};
  std::vector<Vec3d> vertices;
  for (const Json::Value& value : *array(at)) {
    double x[2];
    pair_of({at.document, value, at.key, at.owner}, x, range);
    vertices.emplace_back(x[0], x[1], 0);
    numbers.insert(numbers.end(), {x[0], x[1]});
  }
  const PolygonCut cut = cut_polygon(vertices);
  if (!cut.fault.empty()) refuse(at, cut.fault, cut.remedy);
}

}  // namespace

void read_parameters(ObjectReader& reader, const SdfSignature& signature,
                     std::vector<double>& numbers) {
  if (signature.op == SdfOp::box && read_corners(reader, numbers)) return;
  if (signature.op == SdfOp::plane) return read_plane(reader, signature.parameters, numbers);
  for (const SdfParameter& parameter : signature.parameters)
    read_parameter(reader, parameter, numbers);
}

SdfProfile read_profile(ObjectReader& owner, std::vector<double>& numbers) {
  const Json::Value* value = owner.find("profile");
  if (!value) {
    owner.miss("profile");
    return SdfProfile::circle;
  }
  static const std::vector<std::string_view> names{"circle", "box", "polygon"};
  ObjectReader reader(owner.document(), *value, "the profile of " + owner.noun());
  const std::size_t index = reader.index_of_name("shape", "profile", names);
  const char* key = index == 0 ? "radius" : index == 1 ? "half_size" : "vertices";
  const Json::Value* list = reader.find(key);
  if (!list) {
    reader.miss(key);
  } else if (index == 0) {
    numbers.push_back(positive(at_key(reader, *list, key)));
  } else if (index == 1) {
    double x[2];
    pair_of(at_key(reader, *list, key), x, positive_range());
    numbers.insert(numbers.end(), {x[0], x[1]});
  } else {
    read_outline(at_key(reader, *list, key), numbers);
  }
  reader.done();
  return static_cast<SdfProfile>(index + 1);
}

void check_parameters(const ObjectReader& reader, SdfOp op, std::span<const double> n) {
  if (op == SdfOp::round_box && n[6] > std::min({n[3], n[4], n[5]}))
    reader.refuse_key("radius",
                      fmt::format("\"radius\" is {:g}, more than the least half_size, in {}", n[6],
                                  reader.noun()),
                      "give a smaller radius");
  if (op == SdfOp::capsule && n[0] == n[3] && n[1] == n[4] && n[2] == n[5])
    reader.refuse_key("to",
                      fmt::format("\"from\" and \"to\" are the same point in {}", reader.noun()),
                      "use a sphere");
}

}  // namespace penumbra::json
