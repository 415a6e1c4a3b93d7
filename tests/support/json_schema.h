// The part of JSON Schema (draft 2020-12) that this project's schemas use.
#pragma once

#include <json/value.h>

#include <regex>
#include <string>

namespace penumbra::test {

/// Checks values against a schema; keywords that it does not know are complained about.
class JsonSchema {
 public:
  explicit JsonSchema(Json::Value root) : root_(std::move(root)) {}

  /// What is wrong with a value, a line each; empty if nothing is.
  std::string complaints(const Json::Value& value) const {
    std::string out;
    check(root_, value, "$", out);
    return out;
  }

 private:
  static bool is_of(const std::string& type, const Json::Value& v) {
    if (type == "object") return v.isObject();
    if (type == "array") return v.isArray();
    if (type == "string") return v.isString();
    if (type == "boolean") return v.isBool();
    if (type == "null") return v.isNull();
    if (type == "integer") return v.isIntegral() && !v.isBool();
    return type == "number" && v.isNumeric() && !v.isBool();
  }

  static bool has_type(const Json::Value& types, const Json::Value& v) {
    if (types.isString()) return is_of(types.asString(), v);
    for (const Json::Value& type : types)
      if (is_of(type.asString(), v)) return true;
    return false;
  }

  const Json::Value& definition(const std::string& ref) const {
    return root_["$defs"][ref.substr(ref.rfind('/') + 1)];
  }

  void check(const Json::Value& schema, const Json::Value& v, const std::string& at,
             std::string& out) const {
    for (const std::string& keyword : schema.getMemberNames())
      if (!holds(keyword, schema, v, at, out))
        out += at + ": " + keyword + " is violated by " + v.toStyledString();
  }

  bool holds(const std::string& keyword, const Json::Value& schema, const Json::Value& v,
             const std::string& at, std::string& out) const {
    const Json::Value& rule = schema[keyword];
    if (keyword == "type") return has_type(rule, v);
    if (keyword == "const") return v == rule;
    if (keyword == "enum") return contains(rule, v);
    if (keyword == "minimum") return !v.isNumeric() || v.asDouble() >= rule.asDouble();
    if (keyword == "maximum") return !v.isNumeric() || v.asDouble() <= rule.asDouble();
    if (keyword == "pattern")
      return !v.isString() || std::regex_search(v.asString(), std::regex(rule.asString()));
    if (keyword == "$ref") {
      const Json::Value& target = definition(rule.asString());
      if (!target.isObject()) return false;
      check(target, v, at, out);
      return true;
    }
    if (keyword == "anyOf") return any_of(rule, v, at);
    if (keyword == "required") return !v.isObject() || has_all(rule, v);
    if (keyword == "properties" || keyword == "additionalProperties") {
      check_members(keyword, schema, v, at, out);
      return true;
    }
    if (keyword == "items") {
      if (!v.isArray()) return true;
      for (Json::ArrayIndex i = 0; i < v.size(); ++i)
        check(rule, v[i], at + "[" + std::to_string(i) + "]", out);
      return true;
    }
    return keyword == "description" || keyword == "title" || keyword == "$schema" ||
           keyword == "$defs";
  }

  static bool contains(const Json::Value& list, const Json::Value& v) {
    for (const Json::Value& allowed : list)
      if (allowed == v) return true;
    return false;
  }

  static bool has_all(const Json::Value& names, const Json::Value& v) {
    for (const Json::Value& name : names)
      if (!v.isMember(name.asString())) return false;
    return true;
  }

  bool any_of(const Json::Value& choices, const Json::Value& v, const std::string& at) const {
    for (const Json::Value& choice : choices) {
      std::string complaints;
      check(choice, v, at, complaints);
      if (complaints.empty()) return true;
    }
    return false;
  }

  void check_members(const std::string& keyword, const Json::Value& schema, const Json::Value& v,
                     const std::string& at, std::string& out) const {
    if (!v.isObject()) return;
    for (const std::string& name : v.getMemberNames()) {
      const bool known = schema["properties"].isMember(name);
      if (keyword == "properties" && known)
        check(schema["properties"][name], v[name], at + "." + name, out);
      if (keyword == "additionalProperties" && !known) out += at + ": " + name + " is unknown\n";
    }
  }

  Json::Value root_;
};

}  // namespace penumbra::test
