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
// Distance fields nest by two brackets a level.
constexpr int deepest_nesting = 4096;

std::string read_text(const std::string& path) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > largest_file)
    throw InputError(Place{path}, fmt::format("the scene has {} bytes, more than 32 MiB", size),
                     "keep large geometry in mesh files");
  return read_file(path);
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

Json::CharReaderBuilder strict_parser() {
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  builder["stackLimit"] = deepest_nesting + 8;
  return builder;
}

std::string_view in_our_words(std::string_view message) {
  constexpr std::string_view words[][2] = {
      {"Syntax error: value, object or array expected", "a value is expected"},
      {"Missing '}' or object member name", "a key in quotes or '}' is expected"},
      {"Missing ',' or '}' in object declaration", "',' or '}' is expected"},
      {"Missing ',' or ']' in array declaration", "',' or ']' is expected"},
      {"Missing ':' after object member name", "':' is expected"},
      {"Extra non-whitespace after JSON value", "something follows the end of the scene"},
      {"A valid JSON document must be either an array or an object value", "'{' is expected"}};
  for (const auto& [theirs, ours] : words)
    if (message == theirs) return ours;
  return message;
}

}  // namespace

Document::Document(const std::string& path) : Document(path, read_text(path)) {}

Document::Document(const std::string& path, std::string text)
    : path_(path), text_(std::move(text)) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  find_lines();
  blank_comments();
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
  for (std::size_t i = begin; i < end; i = past_string(i)) {
    if (code_[i] == '{' || code_[i] == '[') ++depth;
    if (code_[i] == '}' || code_[i] == ']') --depth;
    if (code_[i] == '"' && depth == 1) key = i;
  }
  return place_at(key);
}

std::string_view Document::text_of(const Json::Value& value) const {
  const auto begin = static_cast<std::size_t>(value.getOffsetStart());
  return std::string_view(text_).substr(begin, value.getOffsetLimit() - value.getOffsetStart());
}

std::optional<std::string> Document::find_file(const std::string& name) const {
  const std::filesystem::path path = std::filesystem::path(path_).parent_path() / name;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  return path.string();
}

// The offset after the string that begins there, or after the single character.
std::size_t Document::past_string(std::size_t offset) const {
  if (code_[offset] != '"') return offset + 1;
  std::size_t i = offset + 1;
  while (i < code_.size() && code_[i] != '"') i += code_[i] == '\\' ? 2 : 1;
  return std::min(i + 1, code_.size());
}

// The parser does not take a comment in every place.
void Document::blank_comments() {
  code_ = text_;
  for (std::size_t i = 0; i < text_.size();) {
    const std::string_view rest = std::string_view(text_).substr(i, 2);
    std::size_t end = past_string(i);
    if (rest == "//" || rest == "/*") {
      end = rest == "//" ? text_.find_first_of("\r\n", i) : text_.find("*/", i + 2);
      if (end == std::string::npos && rest == "/*")
        throw InputError(place_at(i), "the comment has no end", "close it with */");
      end = end == std::string::npos ? text_.size() : end + (rest == "/*" ? 2 : 0);
      std::replace_if(
          code_.begin() + std::ptrdiff_t(i), code_.begin() + std::ptrdiff_t(end),
          [](char c) { return c != '\n' && c != '\r'; }, ' ');
    }
    i = end;
  }
}

void Document::check_depth() const {
  int depth = 0;
  for (std::size_t i = 0; i < code_.size(); i = past_string(i)) {
    if (code_[i] == '{' || code_[i] == '[') ++depth;
    if (code_[i] == '}' || code_[i] == ']') --depth;
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
    parsed = reader->parse(code_.data(), code_.data() + code_.size(), &root_, &errors);
  } catch (const Json::Exception& e) {
    throw InputError(Place{path_}, std::string("not a scene: ") + e.what(), "correct the JSON");
  }
  if (!parsed) refuse_syntax(errors);
}

// The parser reports "* Line 3, Column 5\n  Message.\n", with columns in bytes.
void Document::refuse_syntax(const std::string& parser_errors) const {
  unsigned line = 1, column = 1;
  int length = 0;
  std::sscanf(parser_errors.c_str(), "* Line %u, Column %u\n%n", &line, &column, &length);
  std::string_view message = std::string_view(parser_errors).substr(std::size_t(length));
  message = message.substr(0, message.find('\n'));
  message.remove_prefix(std::min(message.find_first_not_of(' '), message.size()));
  if (message.ends_with('.')) message.remove_suffix(1);
  line = std::clamp(line, 1u, static_cast<unsigned>(line_starts_.size()));
  refuse_syntax(line_starts_[line - 1] + std::max(column, 1u) - 1, message);
}

void Document::refuse_syntax(std::size_t offset, std::string_view message) const {
  constexpr std::string_view duplicate = "Duplicate key: '";
  if (message.starts_with(duplicate) && message.ends_with('\''))
    throw InputError(
        place_at(offset),
        fmt::format("duplicate key \"{}\"",
                    message.substr(duplicate.size(), message.size() - duplicate.size() - 1)),
        "keep one of the two");
  const bool at_end = code_.find_first_not_of(" \t\r\n", offset) == std::string::npos;
  throw InputError(place_at(offset),
                   fmt::format("not valid JSON: {}{}", in_our_words(message),
                               at_end ? ", but the text ends" : ""),
                   "correct the text there");
}

std::vector<Member> members_in_file_order(const Json::Value& object) {
  std::vector<Member> members;
  for (auto it = object.begin(); it != object.end(); ++it) members.push_back({it.name(), &*it});
  std::ranges::sort(members, {}, [](const Member& m) { return m.value->getOffsetStart(); });
  return members;
}

}  // namespace penumbra::json
