// A JSON text with // and /* */ comments, and where in it everything stands.
#pragma once

#include <json/value.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace penumbra::json {

/// Immutable once read. Values know their byte offset; this turns it into line and column.
class Document {
 public:
  /// Reads and parses the file. InputError for a file that cannot be read, is larger than 32 MiB,
  /// nests deeper than 4096 brackets, breaks the syntax, or repeats a key.
  explicit Document(const std::string& path);
  /// The same with the text at hand; the file need not be there.
  Document(const std::string& path, std::string text);

  const std::string& path() const { return path_; }
  const Json::Value& root() const { return root_; }
  /// Where a value begins. Columns count characters, from 1.
  Place place(const Json::Value& value) const;
  /// Where the key of `member`, a direct member of `object`, begins.
  Place key_place(const Json::Value& object, const Json::Value& member) const;
  /// A value as it is written.
  std::string_view text_of(const Json::Value& value) const;
  /// The path of a file that the document names relative to its own folder; nothing if there is
  /// no such file.
  std::optional<std::string> find_file(const std::string& name) const;

 private:
  Place place_at(std::size_t offset) const;
  std::size_t past_string(std::size_t offset) const;
  void find_lines();
  void blank_comments();
  void check_depth() const;
  void parse();
  [[noreturn]] void refuse_syntax(const std::string& parser_errors) const;
  [[noreturn]] void refuse_syntax(std::size_t offset, std::string_view message) const;

  std::string path_, text_;
  std::string code_;  // the text with blanks for its comments
  std::vector<std::size_t> line_starts_;
  Json::Value root_;
};

/// A value and the key it was found under.
struct Member {
  std::string key;
  const Json::Value* value;
};

/// The members of an object in the order of the file.
std::vector<Member> members_in_file_order(const Json::Value& object);

}  // namespace penumbra::json
