// Reads one JSON object key by key, and in the end knows which keys nobody asked for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/json/kinds.h"

namespace penumbra::json {

/// Ask for every key by its kind (kinds.h), then call done(). What a missing key gives is only a
/// placeholder: done() throws, so checks that join several values belong after it.
class ObjectReader {
 public:
  /// `noun` names the thing in messages: "a sphere light". InputError if the value is no object.
  ObjectReader(const Document& document, const Json::Value& value, std::string noun);

  template <class T>
  T required(std::string_view key, T (*kind)(const At&)) {
    if (const Json::Value* value = find(key)) return kind({document_, *value, key});
    missing_.push_back(key);
    return T{};
  }
  template <class T>
  T optional(std::string_view key, T (*kind)(const At&), T fallback) {
    const Json::Value* value = find(key);
    return value ? kind({document_, *value, key}) : fallback;
  }
  /// The value of a key, or null; the key counts as known from then on.
  const Json::Value* find(std::string_view key);

  /// Counts the key as required and missing.
  void miss(std::string_view key) { missing_.push_back(key); }
  /// Which of `names` the text under `key` is; InputError with the nearest if it is none of them.
  /// `noun` names such a thing in messages.
  std::size_t index_of_name(std::string_view key, std::string_view noun,
                            const std::vector<std::string_view>& names);

  /// Throws InputError for a key that was not asked for, with the nearest that was, or else for a
  /// required key that is missing.
  void done() const;

  /// Errors about the value of a key, or about the whole object if the key is not there.
  [[noreturn]] void refuse_key(std::string_view key, const std::string& what,
                               const std::string& remedy) const;

  void set_noun(std::string noun) { noun_ = std::move(noun); }
  const std::string& noun() const { return noun_; }
  const Document& document() const { return document_; }

 private:
  void refuse_unknown_key() const;

  const Document& document_;
  const Json::Value& value_;
  std::string noun_;
  std::vector<std::string_view> known_, missing_;
  std::size_t found_ = 0;  ///< of the known keys
};

/// `did you mean "NEAREST"?` for a name that is not among `known`; also lists these if asked to.
enum class List { no, yes };
std::string suggest(std::string_view name, const std::vector<std::string_view>& known, List list);

/// Which of `types` the object's "type" names; InputError with the nearest if it is none of them.
/// The reader's noun "a light" becomes "a sphere light".
std::size_t index_of_type(ObjectReader& reader, const std::vector<std::string_view>& types);

/// One way to read an object, chosen by its "type".
template <class Function>
struct TypeEntry {
  std::string_view type;
  Function read;
};

/// The function for the object's "type".
template <class Function, std::size_t count>
Function choose_by_type(ObjectReader& reader, const TypeEntry<Function> (&entries)[count]) {
  std::vector<std::string_view> types;
  for (const auto& entry : entries) types.push_back(entry.type);
  return entries[index_of_type(reader, types)].read;
}

}  // namespace penumbra::json
