#include "frame_names.h"

#include <fmt/format.h>

#include "base/error.h"

namespace penumbra::app {
namespace {

[[noreturn]] void refuse(const std::string& pattern, const std::string& what) {
  throw InputError({pattern}, what,
                   "write one %d or %04d for the number of the frame, %% for a percent sign");
}

}  // namespace

std::optional<FrameNames> FrameNames::from(const std::string& pattern) {
  FrameNames names;
  bool found = false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    std::string& part = found ? names.after_ : names.before_;
    if (pattern[i] != '%' || pattern.compare(i, 2, "%%") == 0) {
      part += pattern[i];
      i += pattern[i] == '%';
      continue;
    }
    const std::size_t digits = i + 1;
    const std::size_t end =
        std::min(pattern.find_first_not_of("0123456789", digits), pattern.size());
    if (end == pattern.size() || pattern[end] != 'd') refuse(pattern, "a % that is no %d");
    if (end - digits > 2 || (end > digits && pattern[digits] != '0'))
      refuse(pattern, "the number of the frame has a width that cannot be");
    if (found) refuse(pattern, "two numbers in one name");
    if (end > digits) names.width_ = std::stoi(pattern.substr(digits, end - digits));
    found = true;
    i = end;
  }
  if (!found) return {};
  return names;
}

std::string FrameNames::of(int frame) const {
  return fmt::format("{}{:0{}}{}", before_, frame, width_, after_);
}

}  // namespace penumbra::app
