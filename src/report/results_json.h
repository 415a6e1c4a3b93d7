// results.json; docs/compare.schema.json describes it.
#pragma once

#include <json/value.h>

#include <string>

#include "report/comparison.h"

namespace penumbra::report {

/// Times in seconds, lengths in metres; null where something is not known.
Json::Value results_json(const Comparison& comparison);

/// Indented, UTF-8, ending with a line break.
std::string json_text(const Json::Value& value);

/// Where a method's files lie in the folder of results.
std::string picture_file(const std::string& name);     ///< the final picture
std::string visibility_file(const std::string& name);  ///< visible fractions, mean over the lights
std::string error_file(const std::string& name);       ///< method − reference
std::string data_file(const std::string& name);        ///< visible fractions for the page

}  // namespace penumbra::report
