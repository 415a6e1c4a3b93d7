// What drivers say of a shader that they refuse.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace penumbra::gl {

/// One complaint. `source` and `line` are those of the shader's #line directives.
struct CompileMessage {
  int source = 0, line = 0;
  int column = 0;      ///< 0 = the driver does not tell
  bool error = false;  ///< else a warning
  std::string text;    ///< without the place, one line
};

/// Reads the formats of Mesa ("1:12(5): error: …"), NVIDIA ("1(12) : error C1008: …") and of
/// glslang, ANGLE, AMD and Apple ("ERROR: 1:12: …"). Lines of no such format are left out.
std::vector<CompileMessage> parse_compile_log(std::string_view log);

}  // namespace penumbra::gl
