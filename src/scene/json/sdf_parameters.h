// The parameters of a distance-field node.
#pragma once

#include <vector>

#include "scene/json/object_reader.h"
#include "scene/sdf.h"

namespace penumbra::json {

/// Asks the reader for every parameter that the signature names, and for the other ways to write
/// boxes and planes; appends the numbers in the order of SdfSignature, missing ones as 0.
/// InputError for a number out of its range.
void read_parameters(ObjectReader& reader, const SdfSignature& signature,
                     std::vector<double>& numbers);

/// Reads "profile" and appends its numbers.
SdfProfile read_profile(ObjectReader& reader, std::vector<double>& numbers);

/// What only several parameters together can break: radii, ends that coincide. After done().
void check_parameters(const ObjectReader& reader, SdfOp op, std::span<const double> numbers);

}  // namespace penumbra::json
