#include "scene/gltf/rules.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "scene/gltf/rule_table.h"

namespace penumbra::gltf {
namespace {

/// Doubles hold every whole number below this.
constexpr double kTwo53 = 9007199254740992.0;

/// Applies one rule to the whole document.
class Check {
 public:
  Check(JsonDocument& document, const Rule& rule)
      : document_(document), rule_(rule), target_size_(size_of_target()) {}

  void run() { walk(document_.root(), rule_.path); }

 private:
  std::size_t size_of_target() const;
  void walk(Json::Value& parent, std::string_view steps);
  void walk_child(Json::Value& child, bool each, std::string_view steps);
  void check(Json::Value& value);
  double number(const Json::Value& value) const;
  double number_not_below(const Json::Value& value, double least, const char* what) const;
  Json::UInt64 whole(Json::Value& value) const;
  void numbers(const Json::Value& value, std::size_t length, bool may_be_negative) const;
  void index(Json::Value& value) const;
  void one_of(const std::string& found) const;
  void array(const Json::Value& value) const;
  [[noreturn]] void fail(const std::string& what) const { throw document_.error(path_, what); }

  /// Calls body for every element with path_ naming it.
  template <class Body>
  void for_elements(Json::Value& list, Body body) {
    array(list);
    const std::size_t end = path_.size();
    for (auto it = list.begin(); it != list.end(); ++it) {
      path_ += '[' + std::to_string(it.index()) + ']';
      body(*it);
      path_.resize(end);
    }
  }

  JsonDocument& document_;
  const Rule& rule_;
  std::size_t target_size_;
  std::string path_;
};

std::size_t Check::size_of_target() const {
  if (rule_.kind != Kind::index && rule_.kind != Kind::indices) return 0;
  const Json::Value* value = &document_.root();
  for (std::string_view rest = rule_.argument; !rest.empty();) {
    const std::string_view step = rest.substr(0, rest.find('.'));
    rest.remove_prefix(std::min(rest.size(), step.size() + 1));
    value = value->isObject() ? value->find(step.data(), step.data() + step.size()) : nullptr;
    if (!value) return 0;
  }
  return value->isArray() ? value->size() : 0;
}

void Check::walk(Json::Value& parent, std::string_view steps) {
  if (steps.empty()) return check(parent);
  if (!parent.isObject()) fail("must be an object");
  std::string step(steps.substr(0, steps.find('.')));
  steps.remove_prefix(std::min(steps.size(), step.size() + 1));
  const bool each = step.ends_with("[]");
  if (each) step.resize(step.size() - 2);
  const std::size_t end = path_.size();
  for (const std::string& name :
       step == "*" ? parent.getMemberNames() : Json::Value::Members{step}) {
    if (!parent.isMember(name)) {
      if (rule_.required && steps.empty()) fail("'" + name + "' is missing");
      continue;
    }
    path_ += (path_.empty() ? "" : ".") + name;
    walk_child(parent[name], each, steps);
    path_.resize(end);
  }
}

void Check::walk_child(Json::Value& child, bool each, std::string_view steps) {
  if (!each) return walk(child, steps);
  for_elements(child, [&](Json::Value& element) { walk(element, steps); });
}

void Check::check(Json::Value& value) {
  switch (rule_.kind) {
    case Kind::object:
      if (!value.isObject()) fail("must be an object");
      break;
    case Kind::list:
      return for_elements(value, [&](Json::Value& element) {
        if (!element.isObject()) fail("must be an object");
      });
    case Kind::text:
    case Kind::word_of:
      if (!value.isString()) fail("must be a string");
      if (rule_.kind == Kind::word_of) one_of(value.asString());
      break;
    case Kind::flag:
      if (!value.isBool()) fail("must be true or false");
      break;
    case Kind::number:
      number(value);
      break;
    case Kind::not_negative:
      number_not_below(value, 0, "must not be negative");
      break;
    case Kind::positive:
      number_not_below(value, 1e-300, "must be greater than zero");
      break;
    case Kind::numbers:
      return numbers(value, rule_.length, true);
    case Kind::color:
      return numbers(value, 3, false);
    case Kind::count:
      whole(value);
      break;
    case Kind::int_count:
      if (whole(value) >= Json::UInt64{1} << 31) fail("must be below 2147483648");
      break;
    case Kind::stride:
      if (const auto n = whole(value); n < 4 || n > 252 || n % 4 != 0)
        fail("must be a multiple of 4 from 4 to 252");
      break;
    case Kind::index:
      return index(value);
    case Kind::indices:
      return for_elements(value, [&](Json::Value& element) { index(element); });
    case Kind::number_of:
      one_of(std::to_string(whole(value)));
  }
}

double Check::number(const Json::Value& value) const {
  if (!value.isNumeric() || !std::isfinite(value.asDouble())) fail("must be a number");
  return value.asDouble();
}

double Check::number_not_below(const Json::Value& value, double least, const char* what) const {
  const double n = number(value);
  if (n < least) fail(what);
  return n;
}

Json::UInt64 Check::whole(Json::Value& value) const {
  const double n = value.isNumeric() ? value.asDouble() : -1;
  if (!(n >= 0 && n < kTwo53) || n != std::floor(n)) fail("must be a whole number, zero or more");
  if (!value.isUInt64() || value.type() == Json::realValue) {
    Json::Value integer(static_cast<Json::UInt64>(n));
    integer.setOffsetStart(value.getOffsetStart());
    integer.setOffsetLimit(value.getOffsetLimit());
    value = integer;
  }
  return value.asUInt64();
}

void Check::numbers(const Json::Value& value, std::size_t length, bool may_be_negative) const {
  array(value);
  if (value.size() != length) fail(fmt::format("must have {} numbers", length));
  for (const Json::Value& element : value)
    if (number(element) < 0 && !may_be_negative) fail("must not be negative");
}

void Check::index(Json::Value& value) const {
  const Json::UInt64 i = whole(value);
  if (i >= target_size_)
    fail(fmt::format("there is no {}[{}]: the file has {}", rule_.argument, i, target_size_));
}

void Check::one_of(const std::string& found) const {
  const std::string bounded = '|' + rule_.argument + '|';
  if (found.empty() || found.find('|') != std::string::npos ||
      bounded.find('|' + found + '|') == std::string::npos)
    fail(fmt::format("'{}' is none of {}", found.substr(0, 40), rule_.argument));
}

void Check::array(const Json::Value& value) const {
  if (!value.isArray()) fail("must be an array");
}

}  // namespace

void check_declarations(JsonDocument& document) {
  for (const Rule& rule : declaration_rules()) Check(document, rule).run();
}

void check_document(JsonDocument& document) {
  for (const char* name : {"buffers", "bufferViews", "accessors", "meshes", "nodes", "scenes",
                           "materials", "textures", "images", "samplers", "cameras", "skins"}) {
    const Rule every_one_is_an_object{name, Kind::list};
    Check(document, every_one_is_an_object).run();
  }
  for (const Rule& rule : document_rules()) Check(document, rule).run();
}

}  // namespace penumbra::gltf
