#include "gl/compile_log.h"

#include <optional>
#include <regex>

namespace penumbra::gl {
namespace {

struct Format {
  std::regex pattern;  // groups: see the numbers
  int source, line, column, severity, text;
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all{
      {std::regex(R"(^(\d+):(\d+)\((\d+)\): (\w+): (.*)$)"), 1, 2, 3, 4, 5},
      {std::regex(R"(^(\d+)\((\d+)\) : (\w+) (.*)$)"), 1, 2, 0, 3, 4},
      {std::regex(R"(^(\w+): (\d+):(\d+): (.*)$)"), 2, 3, 0, 1, 4}};
  return all;
}

int number(const std::cmatch& match, int group) {
  // Longer numbers than a line can have stand for none.
  return group && match.length(group) < 9 ? std::stoi(match.str(group)) : 0;
}

std::optional<CompileMessage> message_of(std::string_view line) {
  for (const Format& format : formats()) {
    std::cmatch match;
    if (!std::regex_match(line.data(), line.data() + line.size(), match, format.pattern)) continue;
    const std::string severity = match.str(format.severity);
    return CompileMessage{number(match, format.source), number(match, format.line),
                          number(match, format.column), severity == "error" || severity == "ERROR",
                          match.str(format.text)};
  }
  return {};
}

}  // namespace

std::vector<CompileMessage> parse_compile_log(std::string_view log) {
  std::vector<CompileMessage> messages;
  while (!log.empty()) {
    std::string_view line = log.substr(0, log.find('\n'));
    log.remove_prefix(std::min(line.size() + 1, log.size()));
    line = line.substr(0, 500);
    while (!line.empty() && (line.back() == '\r' || line.back() == '\0')) line.remove_suffix(1);
    if (auto message = message_of(line)) messages.push_back(std::move(*message));
  }
  return messages;
}

}  // namespace penumbra::gl
