#include "scene/json/document.h"

#include <fmt/format.h>
#include <json/reader.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/atomic_file.h"

namespace penumbra::json {
namespace {

// The parser keeps some forty bytes for each byte of the densest text.
constexpr std::uintmax_t largest_file = std::uintmax_t{32} << 20;
constexpr int deepest_nesting = 64;

std::string read_text(const std::string& path) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > largest_file)
    throw InputError(Place{path}, fmt::format("the scene has {} bytes, more than 32 MiB", size),
                     "keep large geometry in mesh files");
  std::string text = read_file(path);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

Json::CharReaderBuilder strict_parser() {
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  builder["allowComments"] = true;
  builder["collectComments"] = false;
  builder["stackLimit"] = deepest_nesting + 8;
  return builder;
}

}  // namespace

Document::Document(const std::string& path) : path_(path), text_(read_text(path)) {
  find_lines();
  // The parser would take it for the end of the text.
  if (const auto nul = text_.find('\0'); nul != std::string::npos)
    throw InputError(place_at(nul), "a zero byte in the text", "save the scene as UTF-8 text");
  check_depth();
  parse();
}

void Document::find_lines() {
  line_starts_ = {0};
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n') continue;
    if (text_[i] == '\n' || text_[i] == '\r') line_starts_.push_back(i + 1);
  }
}

Place Document::place_at(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const auto characters = std::count_if(text_.begin() + std::ptrdiff_t(after[-1]),
                                        text_.begin() + std::ptrdiff_t(offset),
                                        [](char c) { return !continues_character(c); });
  return {path_, std::uint64_t(after - line_starts_.begin()), std::uint64_t(characters) + 1};
}

Place Document::place(const Json::Value& value) const {
  return place_at(static_cast<std::size_t>(value.getOffsetStart()));
}

Place Document::key_place(const Json::Value& object, const Json::Value& member) const {
  // The last string directly inside the object before the value is the value's key.
  const auto begin = static_cast<std::size_t>(object.getOffsetStart());
  const auto end = static_cast<std::size_t>(member.getOffsetStart());
  std::size_t key = begin;
  int depth = 0;
  for (std::size_t i = begin; i < end; i = past_token(i)) {
    if (text_[i] == '{' || text_[i] == '[') ++depth;
    if (text_[i] == '}' || text_[i] == ']') --depth;
    if (text_[i] == '"' && depth == 1) key = i;
  }
  return place_at(key);
}

char Document::last_character(const Json::Value& value) const {
  return text_.at(static_cast<std::size_t>(value.getOffsetLimit()) - 1);
}

std::optional<std::string> Document::find_file(const std::string& name) const {
  const std::filesystem::path path = std::filesystem::path(path_).parent_path() / name;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  return path.string();
}

// Past the string, the comment or the single character at `offset`.
std::size_t Document::past_token(std::size_t offset) const {
  const auto past = [&](std::string_view end, std::size_t from) {
    const std::size_t found = text_.find(end, from);
    return found == std::string::npos ? text_.size() : found + end.size();
  };
  const std::string_view rest = std::string_view(text_).substr(offset, 2);
  if (rest == "//") return std::min(text_.find_first_of("\r\n", offset), text_.size());
  if (rest == "/*") return past("*/", offset + 2);
  if (rest[0] != '"') return offset + 1;
  std::size_t i = offset + 1;
  while (i < text_.size() && text_[i] != '"') i += text_[i] == '\\' ? 2 : 1;
  return std::min(i + 1, text_.size());
}

void Document::check_depth() const {
  int depth = 0;
  for (std::size_t i = 0; i < text_.size(); i = past_token(i)) {
    if (text_[i] == '{' || text_[i] == '[') ++depth;
    if (text_[i] == '}' || text_[i] == ']') --depth;
    if (depth > deepest_nesting)
      throw InputError(place_at(i), fmt::format("nested deeper than {} levels", deepest_nesting),
                       "no scene needs that; look for a missing bracket");
  }
}

void Document::parse() {
  const std::unique_ptr<Json::CharReader> reader(strict_parser().newCharReader());
  std::string errors;
  bool parsed = false;
  try {
    parsed = reader->parse(text_.data(), text_.data() + text_.size(), &root_, &errors);
  } catch (const Json::Exception& e) {
    throw InputError(Place{path_}, std::string("not a scene: ") + e.what(), "correct the JSON");
  }
  if (!parsed) refuse_syntax(errors);
}

// The parser reports "* Line 3, Column 5\n  Message.\n", with columns in bytes.
void Document::refuse_syntax(const std::string& parser_errors) const {
  unsigned line = 1, column = 1;
  int length = 0;
  if (std::sscanf(parser_errors.c_str(), "* Line %u, Column %u\n%n", &line, &column, &length) < 2)
    throw InputError(Place{path_}, "not valid JSON", "correct the JSON");
  std::string message = parser_errors.substr(static_cast<std::size_t>(length));
  message = message.substr(0, message.find('\n'));
  message.erase(0, message.find_first_not_of(' '));
  if (message.ends_with('.')) message.pop_back();
  line = std::clamp(line, 1u, static_cast<unsigned>(line_starts_.size()));
  const Place place = place_at(line_starts_[line - 1] + std::max(column, 1u) - 1);
  constexpr std::string_view duplicate = "Duplicate key: ";
  if (message.starts_with(duplicate))
    throw InputError(place, "duplicate key " + message.substr(duplicate.size()),
                     "keep one of the two");
  throw InputError(place, "not valid JSON: " + message, "correct the text there");
}

std::vector<Member> members_in_file_order(const Json::Value& object) {
  std::vector<Member> members;
  for (auto it = object.begin(); it != object.end(); ++it) members.push_back({it.name(), &*it});
  std::ranges::sort(members, {}, [](const Member& m) { return m.value->getOffsetStart(); });
  return members;
}

}  // namespace penumbra::json
