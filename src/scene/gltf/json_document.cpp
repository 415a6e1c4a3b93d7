#include "scene/gltf/json_document.h"

#include <fmt/format.h>
#include <json/reader.h>

#include <cstdio>
#include <memory>
#include <string_view>

namespace penumbra::gltf {
namespace {

constexpr int kDeepest = 256;

/// The byte at which `line` and `column`, both from 1, are.
std::size_t offset_of(std::string_view text, std::size_t line, std::size_t column) {
  std::size_t begin = 0;
  for (; line > 1; --line) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) break;
    begin = end + 1;
  }
  return std::min(text.size(), begin + column - 1);
}

/// Cuts the first step off a path: "a[3].b" gives "a", then "3", then "b".
std::string_view next_step(std::string_view& path) {
  path.remove_prefix(std::min(path.find_first_not_of(".[]"), path.size()));
  const std::size_t end = std::min(path.find_first_of(".[]"), path.size());
  const std::string_view step = path.substr(0, end);
  path.remove_prefix(end);
  return step;
}

const Json::Value* child(const Json::Value& value, std::string_view step) {
  if (value.isObject()) return value.find(step.data(), step.data() + step.size());
  if (!value.isArray() || step.empty() || step.size() > 9 ||
      step.find_first_not_of("0123456789") != std::string_view::npos)
    return nullptr;
  const auto i = static_cast<Json::ArrayIndex>(std::stoul(std::string(step)));
  return i < value.size() ? &value[i] : nullptr;
}

}  // namespace

JsonDocument::JsonDocument(const std::string& path) : source_(path) {
  check_nesting();
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  const std::string_view text = source_.json();
  std::string errors;
  if (!reader->parse(text.data(), text.data() + text.size(), &root_, &errors)) fail_syntax(errors);
  if (!root_.isObject())
    throw InputError(source_.place(0), "a glTF file holds one JSON object", "export it again");
}

void JsonDocument::check_nesting() const {
  const std::string_view text = source_.json();
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') in_string = !in_string;
    if (in_string && c == '\\') ++i;
    if (in_string) continue;
    if (c == ']' || c == '}') --depth;
    if ((c == '[' || c == '{') && ++depth > kDeepest)
      throw InputError(source_.place(i),
                       fmt::format("the JSON is nested deeper than {} levels", kDeepest),
                       "export the file again");
  }
}

void JsonDocument::fail_syntax(const std::string& errors) const {
  unsigned line = 1, column = 1;
  int message = 0;
  std::sscanf(errors.c_str(), "* Line %u, Column %u %n", &line, &column, &message);
  std::string what = errors.substr(static_cast<std::size_t>(message));
  what = what.substr(0, std::min(what.find_first_of(".\n"), std::size_t{120}));
  throw InputError(source_.place(offset_of(source_.json(), line, column)),
                   what.empty() ? "this is no JSON" : what, "correct it or export the file again");
}

InputError JsonDocument::error(const std::string& path, const std::string& what,
                               const std::string& remedy) const {
  const Json::Value* value = &root_;
  for (std::string_view rest = path; !rest.empty();) {
    const Json::Value* next = child(*value, next_step(rest));
    if (!next) break;
    value = next;
  }
  const auto offset =
      static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, value->getOffsetStart()));
  return InputError(source_.place(offset), path.empty() ? what : path.substr(0, 200) + ": " + what,
                    remedy);
}

}  // namespace penumbra::gltf
