// Things of a scene file that move: what they are at a moment.
#pragma once

#include <optional>
#include <vector>

#include "scene/json/object_reader.h"

namespace penumbra::json {

struct Moment {
  Json::Value root;           ///< values know the places of the keyframes that they come from
  std::vector<double> times;  ///< of all keyframes, seconds; unsorted
};

/// The document at `time`, seconds: cameras, lights, objects and nodes of distance fields have what
/// their "keyframes" say in place of their own values, and lose "keyframes" and "interpolation".
/// Numbers, arrays of numbers and objects of these move, between neighbouring keyframes of the same
/// key; before the first and after the last they stand still. "linear" goes straight; "smooth" by
/// monotone cubics (Fritsch and Butland 1984) with a rest at both ends: no number leaves the range
/// of its two keyframes. Nothing if no keyframe is in the document. InputError with the place.
std::optional<Moment> moment_of(const Document& document, double time);

/// Makes the two keys, which moment_of takes away, known in messages about others.
void know_keyframes(ObjectReader& reader);

}  // namespace penumbra::json
