#include <algorithm>
#include <cctype>
#include <filesystem>

#include "gl/context.h"

namespace penumbra::gl {

bool is_graphics_processor(const std::string& renderer) {
  std::string name;
  for (const char c : renderer)
    name.push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
  constexpr const char* software[] = {"llvmpipe",    "softpipe", "swrast",
                                      "swiftshader", "software", "lavapipe"};
  return !name.empty() && std::ranges::none_of(software, [&](const char* word) {
    return name.find(word) != std::string::npos;
  });
}

bool may_have_graphics_processor() {
  std::error_code ignored;
  return std::ranges::any_of(
      std::initializer_list<const char*>{"/dev/dri", "/dev/nvidiactl", "/dev/dxg"},
      [&](const char* path) { return std::filesystem::exists(path, ignored); });
}

}  // namespace penumbra::gl
