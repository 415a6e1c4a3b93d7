// One sentence: which method to use on a scene, and why.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace penumbra::report {

struct Candidate {
  std::string name;                  ///< as of --shadows
  double error = 0;                  ///< root mean square, in the penumbra
  double seconds = 0;                ///< of one picture
  std::optional<int> light_samples;  ///< area: that many points a light
};

struct Advice {
  std::string method;  ///< empty if there was no candidate
  std::optional<int> light_samples;
  std::string text;
};

/// The fastest whose error is not above `limit`; where none is, the one with the least error. The
/// text compares it with hard, if that is among them, and with the fastest one that is better.
/// `has_penumbra`: false if no point sees a part of a light alone, so that all errors are 0.
Advice advise(const std::vector<Candidate>& candidates, double limit, bool has_penumbra);

}  // namespace penumbra::report
