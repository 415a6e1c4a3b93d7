// The JSON of a glTF file, with errors that tell where in it.
#pragma once

#include <json/value.h>

#include <string>

#include "base/error.h"
#include "scene/gltf/source.h"

namespace penumbra::gltf {

class JsonDocument {
 public:
  /// Reads and parses; throws InputError on bytes that are no JSON object, and on nesting deeper
  /// than 256, which recursive readers after this one need not be ready for.
  explicit JsonDocument(const std::string& path);

  const Source& source() const { return source_; }
  const std::string& file() const { return source_.file(); }
  Json::Value& root() { return root_; }
  const Json::Value& root() const { return root_; }

  /// "PLACE: path: what; remedy". `path` as in "meshes[3].primitives[0].attributes.POSITION"; the
  /// place is the longest part of it that exists.
  InputError error(const std::string& path, const std::string& what,
                   const std::string& remedy = "correct it or export the file again") const;

  /// The number of elements of a top-level array; 0 if there is none.
  std::size_t count(const char* array) const { return root_[array].size(); }

 private:
  void check_nesting() const;
  [[noreturn]] void fail_syntax(const std::string& errors) const;

  Source source_;
  Json::Value root_;
};

}  // namespace penumbra::gltf
