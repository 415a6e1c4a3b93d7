#include "scene/mesh/text_cursor.h"

#include <fast_float/fast_float.h>
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <utility>

namespace penumbra {
namespace {

/// std::from_chars and fast_float take no plus sign.
const char* skip_plus(const char* at, const char* end) {
  return end - at >= 2 && *at == '+' && at[1] != '-' ? at + 1 : at;
}

}  // namespace

std::string in_quotes(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (c < 0x20 || c > 0x7e) c = '?';
  return '\'' + text + (word.size() > longest ? "…'" : "'");
}

Place place_in_text(std::string_view file, std::string_view text, std::size_t offset) {
  const auto before = text.substr(0, offset);
  const auto line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return {std::string(file),
          1 + static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n')),
          1 + offset - line_start};
}

int TextCursor::continuation_length() const {
  if (end_ - at_ >= 2 && at_[0] == '\\' && at_[1] == '\n') return 2;
  if (end_ - at_ >= 3 && at_[0] == '\\' && at_[1] == '\r' && at_[2] == '\n') return 3;
  return 0;
}

void TextCursor::skip_continuations() {
  while (const int length = continuation_length()) {
    at_ += length;
    while (at_ != end_ && is_blank(*at_)) ++at_;
  }
}

void TextCursor::next_line() {
  const void* newline = std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
  at_ = newline ? static_cast<const char*>(newline) + 1 : end_;
}

void TextCursor::skip_white_space() {
  while (at_line_end() && at_ != end_) ++at_;
}

std::string_view TextCursor::word() {
  skip_blanks();
  const char* begin = at_;
  while (!at_word_end()) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string_view TextCursor::rest_of_line() {
  skip_blanks();
  const char* begin = at_;
  while (at_ != end_ && *at_ != '\n') ++at_;
  const char* last = at_;
  while (last != begin && is_blank(last[-1])) --last;
  return {begin, static_cast<std::size_t>(last - begin)};
}

float TextCursor::number(const char* what) {
  skip_blanks();
  float value = 0;
  const auto [after, error] = fast_float::from_chars(skip_plus(at_, end_), end_, value);
  // Out of range leaves infinity or zero, which finish_scene judges.
  if (error == std::errc::invalid_argument) fail_expected("a number", what);
  const char* begin = std::exchange(at_, after);
  if (at_word_end()) return value;
  at_ = begin;
  fail_expected("a number", what);
}

std::int64_t TextCursor::integer(const char* what) {
  skip_blanks();
  const char* begin = at_;
  const std::int64_t value = leading_integer(what);
  if (at_word_end()) return value;
  at_ = begin;
  fail_expected("an integer", what);
}

std::int64_t TextCursor::leading_integer(const char* what) {
  skip_blanks();
  std::int64_t value = 0;
  const auto [after, error] = std::from_chars(skip_plus(at_, end_), end_, value);
  if (error != std::errc{}) fail_expected("an integer", what);
  at_ = after;
  return value;
}

bool TextCursor::take(char c) {
  if (at_ == end_ || *at_ != c) return false;
  ++at_;
  return true;
}

void TextCursor::fail_expected(const char* kind, const char* what) {
  const std::size_t begin = offset();
  const std::string_view found = word();
  const std::string instead = found.empty() ? at_ == end_ ? "the file ends" : "the line ends"
                                            : in_quotes(found) + " stands there";
  fail_at(begin, fmt::format("{} ({}) is missing: {}", kind, what, instead),
          "check whether the file is damaged");
}

Place TextCursor::place(std::size_t offset) const { return place_in_text(file_, text_, offset); }

void TextCursor::fail_at(std::size_t offset, const std::string& what,
                         const std::string& remedy) const {
  throw InputError(place(offset), what, remedy);
}

}  // namespace penumbra
