// The folder of results: pictures, data, results.json and the page that shows them.
#pragma once

#include <string>

#include "report/comparison.h"

namespace penumbra::report {

/// Makes the folder and those in it, and checks that each can be written to; throws WorkError.
void prepare_folder(const std::string& folder);

/// Where the reference is kept between calls.
std::string reference_file(const std::string& folder);

/// Writes all but the reference; throws WorkError.
void write_folder(const std::string& folder, const Comparison& comparison);

/// The page with results.json's text inside.
std::string page_with(const std::string& json);

/// A script that hands visible fractions to the page: planes of bytes by light, row by row from the
/// top, 0 to 254 for [0, 1], 255 for no surface.
std::string data_script(const std::string& name, const Fractions& fractions);

/// Mean over the lights as gray, the code in proportion to the fraction; slate without a surface.
Image gray_of(const Fractions& fractions);

}  // namespace penumbra::report
