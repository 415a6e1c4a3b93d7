// Golden pictures: what tests/data/golden holds, and comparison with it.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "image/image.h"

namespace penumbra::test {

/// A line of a list in tests/data/golden.
struct Golden {
  std::string name;                  ///< of the .png beside the list
  std::vector<std::string> command;  ///< render … of the test, but for -o
};

void PrintTo(const Golden& golden, std::ostream* out);

/// Pictures of exact.txt and of sampled.txt.
std::vector<Golden> exact_pictures();
std::vector<Golden> sampled_pictures();

/// RGB, linear.
Image read_rgb(const std::string& file);
Image golden_picture(const std::string& name);

/// Where a test that fails leaves its pictures, beside the folder of the program.
std::string failure_folder(const std::string& name);
/// Writes candidate.png, reference.png and difference.png (FLIP) to `folder`; says so.
std::string leave_pictures(const std::string& folder, const Image& candidate,
                           const Image& reference);

/// Why the candidate is not the golden picture; empty if it is.
std::string objection(const Image& candidate, const Image& golden);
/// Why the golden picture is not what the candidates, of other seeds each, scatter about.
std::string statistical_objection(const std::vector<Image>& candidates, const Image& golden);
Image mean_of(const std::vector<Image>& pictures);

}  // namespace penumbra::test
