#pragma once
#include <string>
#include <string_view>
#include <vector>

/// One line of a source file that breaks a rule.
struct Offence {
  std::string file;  ///< relative to the repository's top
  int line;          ///< from 1
  std::string what;

  bool operator==(const Offence&) const = default;
};

/// The room of a file by its path from the top ("src/base/vec.h" is in "base", "apps/…" in "apps",
/// "include/…" in "include"); empty for files that may include anything (tests, examples, bench).
std::string room_of(std::string_view path);

/// The #includes of `text`, the contents of `path`, that point against the arrows of
/// docs/architecture.md, name an unknown room, or climb with "../".
std::vector<Offence> forbidden_includes(std::string_view path, std::string_view text);

/// How many lines `text` has.
int line_count(std::string_view text);
