#include "scene/json/kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace penumbra::json {
namespace {

// finish_scene takes no geometry beyond a million kilometres.
constexpr double largest = 1e9, smallest = 1e-12, brightest = 1e12;

std::size_t past_digits(std::string_view s, std::size_t from) {
  return std::min(s.find_first_not_of("0123456789", from), s.size());
}

// The parser also takes "-", "+1", "01" and "1." for numbers; JSON does not.
bool is_json_number(std::string_view s) {
  const std::size_t whole = s.starts_with('-') ? 1 : 0;
  std::size_t end = past_digits(s, whole);
  if (end == whole || (s[whole] == '0' && end > whole + 1)) return false;
  if (end < s.size() && s[end] == '.') {
    const std::size_t fraction = end + 1;
    end = past_digits(s, fraction);
    if (end == fraction) return false;
  }
  if (end < s.size() && (s[end] == 'e' || s[end] == 'E')) {
    const std::size_t sign = end + 1 < s.size() && (s[end + 1] == '+' || s[end + 1] == '-');
    const std::size_t exponent = end + 1 + sign;
    end = past_digits(s, exponent);
    if (end == exponent) return false;
  }
  return end == s.size();
}

double number(const At& at, const std::string& label, const Range& range) {
  if (!at.value.isNumeric())
    refuse(at, fmt::format("{} is {}", label, type_name(at.value)), "give " + range.wanted);
  if (const auto text = at.document.text_of(at.value); !is_json_number(text))
    refuse(at, fmt::format("{} is \"{}\", which is no JSON number", label, text.substr(0, 40)),
           "give " + range.wanted);
  const double x = at.value.asDouble();
  if (!range.holds(x)) refuse(at, fmt::format("{} is {:g}", label, x), "give " + range.wanted);
  return x;
}

}  // namespace

double number(const At& at, const Range& range) {
  return number(at, fmt::format("\"{}\"", at.key), range);
}

Vec3d triple(const At& at, const Range& each) {
  if (!at.value.isArray())
    refuse(at, fmt::format("\"{}\" is {}", at.key, type_name(at.value)), "give " + each.wanted);
  if (at.value.size() != 3)
    refuse(at, fmt::format("\"{}\" has {} entries instead of 3", at.key, at.value.size()),
           "give " + each.wanted);
  Vec3d v;
  for (int i = 0; i < 3; ++i)
    v[i] = number({at.document, at.value[i], at.key, at.owner},
                  fmt::format("\"{}\"[{}]", at.key, i), each);
  return v;
}

Vec3d triple_or_number(const At& at, const Range& each) {
  return at.value.isNumeric() ? Vec3d(number(at, each)) : triple(at, each);
}

namespace {

const Range& in_space() {
  static const Range range{-largest, largest, "[x, y, z], three numbers of size at most 1e9"};
  return range;
}

}  // namespace

void refuse(const At& at, const std::string& what, const std::string& remedy) {
  throw InputError(at.document.place(at.value),
                   at.owner.empty() ? what : fmt::format("{} in {}", what, at.owner), remedy);
}

std::string_view type_name(const Json::Value& value) {
  switch (value.type()) {
    case Json::nullValue:
      return "null";
    case Json::stringValue:
      return "a string";
    case Json::booleanValue:
      return "a boolean";
    case Json::arrayValue:
      return "an array";
    case Json::objectValue:
      return "an object";
    default:
      return "a number";
  }
}

float positive(const At& at) {
  static const Range range{smallest, largest, "a number above 0 (1e-12 to 1e9)"};
  return static_cast<float>(number(at, range));
}

float unit_interval(const At& at) {
  static const Range range{0, 1, "a number from 0 to 1"};
  return static_cast<float>(number(at, range));
}

float field_of_view_deg(const At& at) {
  static const Range range{0.001, 179.999, "degrees above 0 and below 180 (0.001 to 179.999)"};
  return static_cast<float>(number(at, range));
}

float angular_diameter_deg(const At& at) {
  static const Range range{0, 179.999, "degrees from 0 to below 180 (at most 179.999)"};
  return static_cast<float>(number(at, range));
}

float samples_scale(const At& at) {
  static const Range range{1e-3, 1e3, "a number from 0.001 to 1000"};
  return static_cast<float>(number(at, range));
}

Vec3 point(const At& at) { return Vec3(triple(at, in_space())); }

Vec3 nonzero_vector(const At& at) {
  const Vec3d v = triple(at, in_space());
  if (!(length(v) >= smallest))
    refuse(at, fmt::format("\"{}\" has no length", at.key), "give a vector other than zero");
  return Vec3(v);
}

Vec3 light_colour(const At& at) {
  static const Range range{0, brightest, "[r, g, b], three numbers from 0 to 1e12"};
  return Vec3(triple(at, range));
}

Vec3 albedo(const At& at) {
  static const Range range{0, 1, "[r, g, b], three numbers from 0 to 1"};
  return Vec3(triple(at, range));
}

Vec3 albedo_or_grey(const At& at) {
  static const Range range{0, 1, "a number from 0 to 1, or [r, g, b] of such"};
  return Vec3(triple_or_number(at, range));
}

Vec3d angles_deg(const At& at) {
  static const Range range{-1e6, 1e6, "[x, y, z], three angles in degrees"};
  return triple(at, range);
}

Vec3d scale(const At& at) {
  static const Range range{-largest, largest, "a number other than 0, or [x, y, z] of such"};
  const Vec3d v = triple_or_number(at, range);
  if (std::min({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) < smallest)
    refuse(at, fmt::format("\"{}\" is 0", at.key), "give " + range.wanted);
  return v;
}

bool flag(const At& at) {
  if (!at.value.isBool())
    refuse(at, fmt::format("\"{}\" is {}", at.key, type_name(at.value)), "give true or false");
  return at.value.asBool();
}

std::string text(const At& at) {
  if (!at.value.isString())
    refuse(at, fmt::format("\"{}\" is {}", at.key, type_name(at.value)), "give a string");
  std::string s = at.value.asString();
  if (std::ranges::any_of(s, [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    refuse(at, fmt::format("\"{}\" holds a control character", at.key), "give plain text");
  return s;
}

std::string file_name(const At& at) {
  std::string s = text(at);
  if (s.empty()) refuse(at, fmt::format("\"{}\" is empty", at.key), "give a file name");
  return s;
}

const Json::Value* array(const At& at) {
  if (!at.value.isArray())
    refuse(at, fmt::format("\"{}\" is {}", at.key, type_name(at.value)), "give an array [ ]");
  return &at.value;
}

const Json::Value* object(const At& at) {
  if (!at.value.isObject())
    refuse(at, fmt::format("\"{}\" is {}", at.key, type_name(at.value)), "give an object { }");
  return &at.value;
}

}  // namespace penumbra::json
