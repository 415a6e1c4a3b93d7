// Remarks on what of a file could not be honoured, one line for each kind however often it occurs.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace penumbra::gltf {

class Warnings {
 public:
  /// `text` is the kind; `which`, if given, names one case of it.
  void add(const std::string& text, const std::string& which = {});

  /// One line each, in the order of first occurrence: "text", or "text (4 times, first in which)".
  std::vector<std::string> lines() const;

 private:
  struct Kind {
    std::string text, first;
    std::size_t times = 0;
  };
  std::vector<Kind> kinds_;
  std::map<std::string, std::size_t> index_;
};

}  // namespace penumbra::gltf
