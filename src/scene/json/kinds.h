// What a value may be: each kind checks a JSON value and gives the C++ value, or throws InputError
// at its place.
#pragma once

#include <string>
#include <string_view>

#include "base/vec.h"
#include "scene/json/document.h"

namespace penumbra::json {

/// A value, the key it stands under, and the document that knows its place.
struct At {
  const Document& document;
  const Json::Value& value;
  std::string_view key;
  std::string_view
      owner{};  ///< what has the key, for messages where the place alone says too little
};

/// Throws InputError at the value's place: "WHAT in OWNER".
[[noreturn]] void refuse(const At& at, const std::string& what, const std::string& remedy);
/// "a string", "an array" …
std::string_view type_name(const Json::Value& value);

/// What a number may be; `wanted` completes "give …".
struct Range {
  double lo, hi;
  std::string wanted;

  bool holds(double x) const { return lo <= x && x <= hi; }
};
double number(const At& at, const Range& range);
Vec3d triple(const At& at, const Range& each);
Vec3d triple_or_number(const At& at, const Range& each);

// Lengths and coordinates end at 1e9 metres, emissions at 1e12.
float positive(const At& at);              ///< 1e-12 to 1e9
float unit_interval(const At& at);         ///< 0 to 1
float field_of_view_deg(const At& at);     ///< above 0, below 180
float angular_diameter_deg(const At& at);  ///< 0 or above, below 180

Vec3 point(const At& at);           ///< [x, y, z]
Vec3 nonzero_vector(const At& at);  ///< [x, y, z], at least 1e-12 long
Vec3 light_colour(const At& at);    ///< [r, g, b], each 0 or more
Vec3 albedo(const At& at);          ///< [r, g, b], each 0 to 1
Vec3 albedo_or_grey(const At& at);  ///< the same, or one number for all three
Vec3d angles_deg(const At& at);     ///< [x, y, z]
Vec3d scale(const At& at);          ///< [x, y, z] or one number; none within ±1e-12

float samples_scale(const At& at);  ///< 0.001 to 1000

bool flag(const At& at);  ///< true or false

std::string text(const At& at);       ///< a string without control characters
std::string file_name(const At& at);  ///< the same, not empty

/// These two only check the type.
const Json::Value* array(const At& at);
const Json::Value* object(const At& at);

}  // namespace penumbra::json
