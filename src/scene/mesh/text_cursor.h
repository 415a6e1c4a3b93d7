// Walks over the text of a model file and says where something is wrong.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.h"

namespace penumbra {

/// The word in quotes, shortened and made printable.
std::string in_quotes(std::string_view word);

/// Words are separated by blanks: spaces, tabs and other white space short of a newline; a newline
/// after a backslash is blank too. Errors are InputErrors with line and column, which are counted
/// only then. `text` must outlive the cursor.
class TextCursor {
 public:
  /// Walks over text[begin, end); places are counted from the start of the text.
  TextCursor(std::string_view file, std::string_view text, std::size_t begin, std::size_t end)
      : file_(file), text_(text), at_(text.data() + begin), end_(text.data() + end) {}
  TextCursor(std::string_view file, std::string_view text)
      : TextCursor(file, text, 0, text.size()) {}

  bool at_end() const { return at_ == end_; }
  std::size_t offset() const { return static_cast<std::size_t>(at_ - text_.data()); }

  void skip_blanks() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    if (at_ != end_ && *at_ == '\\') skip_continuations();
  }
  /// After blanks: nothing is left in this line.
  bool at_line_end() {
    skip_blanks();
    return at_ == end_ || *at_ == '\n';
  }
  /// Nothing is left of this word.
  bool at_word_end() const {
    return at_ == end_ || is_blank(*at_) || *at_ == '\n' ||
           (*at_ == '\\' && continuation_length() > 0);
  }
  /// Goes to the start of the next line.
  void next_line();
  /// Skips blanks and newlines.
  void skip_white_space();

  /// The next word of this line; empty if there is none.
  std::string_view word();
  /// All that is left in this line, without blanks around it.
  std::string_view rest_of_line();
  /// A decimal number, inf or nan. `what` says in an error what it should have been, "x" say.
  float number(const char* what);
  std::int64_t integer(const char* what);
  /// An integer that something else may follow in the same word.
  std::int64_t leading_integer(const char* what);
  /// Takes the character if it is next.
  bool take(char c);

  Place place(std::size_t offset) const;
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    fail_at(offset(), what, remedy);
  }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what,
                            const std::string& remedy) const;

 private:
  static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
  }
  /// Of a backslash and the newline after it; 0 if there is none.
  int continuation_length() const;
  void skip_continuations();
  [[noreturn]] void fail_expected(const char* kind, const char* what);

  std::string_view file_;
  std::string_view text_;
  const char* at_;
  const char* end_;
};

/// Line and column (in bytes), both from 1, of an offset into the text.
Place place_in_text(std::string_view file, std::string_view text, std::size_t offset);

}  // namespace penumbra
