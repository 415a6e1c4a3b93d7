// The names of a film's frames.
#pragma once

#include <optional>
#include <string>

namespace penumbra::app {

/// As "frames/%04d.png": one %d, perhaps with a width that zeros fill; %% is a percent sign.
class FrameNames {
 public:
  /// Nothing if the pattern has no %d. Throws InputError for more than one and for other uses of %.
  static std::optional<FrameNames> from(const std::string& pattern);

  std::string of(int frame) const;

 private:
  std::string before_, after_;
  int width_ = 0;
};

}  // namespace penumbra::app
