#include "scene/json/object_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/nearest_name.h"

namespace penumbra::json {
namespace {

// A name quoted in a message, cut where it is absurdly long.
std::string quoted(std::string_view name) {
  return fmt::format("\"{}{}\"", name.substr(0, 80), name.size() > 80 ? "..." : "");
}

}  // namespace

ObjectReader::ObjectReader(const Document& document, const Json::Value& value, std::string noun)
    : document_(document), value_(value), noun_(std::move(noun)) {
  if (!value.isObject())
    throw InputError(document.place(value), fmt::format("{} is {}", noun_, type_name(value)),
                     "give an object { }");
}

const Json::Value* ObjectReader::find(std::string_view key) {
  const Json::Value* value = value_.find(key.data(), key.data() + key.size());
  if (std::ranges::find(known_, key) != known_.end()) return value;
  known_.push_back(key);
  if (value) ++found_;
  return value;
}

void ObjectReader::done() const {
  if (found_ < value_.size()) refuse_unknown_key();
  if (!missing_.empty())
    throw InputError(document_.place(value_),
                     fmt::format("missing key {} in {}", quoted(missing_.front()), noun_),
                     "add it");
}

void ObjectReader::refuse_unknown_key() const {
  for (const Member& member : members_in_file_order(value_))
    if (std::ranges::find(known_, member.key) == known_.end())
      throw InputError(document_.key_place(value_, *member.value),
                       fmt::format("unknown key {} in {}", quoted(member.key), noun_),
                       suggest(member.key, known_, List::yes));
}

void ObjectReader::refuse_key(std::string_view key, const std::string& what,
                              const std::string& remedy) const {
  const Json::Value* value = value_.find(key.data(), key.data() + key.size());
  throw InputError(document_.place(value ? *value : value_), what, remedy);
}

std::size_t ObjectReader::index_of_name(std::string_view key, std::string_view noun,
                                        const std::vector<std::string_view>& names) {
  const Json::Value* value = find(key);
  if (!value)
    refuse_key(key, fmt::format("missing key {} in {}", quoted(key), noun_),
               fmt::format("add one of {}", fmt::join(names, ", ")));
  const std::string name = text({document_, *value, key});
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    refuse_key(key, fmt::format("unknown {} {} at {}", noun, quoted(name), noun_),
               suggest(name, names, List::yes));
  return static_cast<std::size_t>(found - names.begin());
}

std::string suggest(std::string_view name, const std::vector<std::string_view>& known, List list) {
  const std::string question = fmt::format("did you mean {}?", quoted(nearest_name(name, known)));
  return list == List::no ? question
                          : fmt::format("{} (known: {})", question, fmt::join(known, ", "));
}

std::size_t index_of_type(ObjectReader& reader, const std::vector<std::string_view>& types) {
  const std::string noun = reader.noun().substr(reader.noun().find(' ') + 1);
  const Json::Value* value = reader.find("type");
  if (!value)
    reader.refuse_key("type", fmt::format("missing key \"type\" in {}", reader.noun()),
                      fmt::format("add one of {}", fmt::join(types, ", ")));
  const std::string type = text({reader.document(), *value, "type"});
  const auto found = std::ranges::find(types, type);
  if (found == types.end())
    reader.refuse_key("type", fmt::format("unknown {} type {}", noun, quoted(type)),
                      suggest(type, types, List::yes));
  reader.set_noun(fmt::format("a {} {}", type, noun));
  return static_cast<std::size_t>(found - types.begin());
}

}  // namespace penumbra::json
