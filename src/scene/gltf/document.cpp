#include "scene/gltf/document.h"

#include <fmt/format.h>
#include <json/writer.h>

#include <filesystem>

#include "base/atomic_file.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/extensions.h"
#include "scene/gltf/rules.h"
#include "scene/gltf/uri.h"

namespace penumbra::gltf {
namespace {

constexpr const char* kExtras[] = {"radius", "angular_diameter_deg"};

/// What of `extras` is read: numbers of known names, and whether a node receives light.
Json::Value known_extras(const Json::Value& extras) {
  Json::Value known(Json::objectValue);
  if (!extras.isObject()) return known;
  for (const char* name : kExtras)
    if (extras.isMember(name) && extras[name].isNumeric()) known[name] = extras[name].asDouble();
  if (extras["receives"].isBool()) known["receives"] = extras["receives"];
  return known;
}

/// tinygltf turns whole numbers in extensions into ints, whatever their size.
void make_real(Json::Value& value) {
  if (value.isNumeric()) value = value.asDouble();
  for (Json::Value& child : value) make_real(child);
}

void strip_extensions(Json::Value& extensions) {
  for (const std::string& name : extensions.getMemberNames())
    if (!is_implemented(name)) extensions.removeMember(name);
  make_real(extensions);
}

/// Removes what is not read from extras and extensions, which may hold anything.
void strip(Json::Value& value) {
  if (value.isObject() && value.isMember("extras")) value["extras"] = known_extras(value["extras"]);
  if (value.isObject() && value.isMember("extensions")) strip_extensions(value["extensions"]);
  for (Json::Value& child : value) strip(child);
}

/// Adds what tinygltf insists on: a spot's cone; and a member to each area light, because it drops
/// empty objects from arrays and so moves the others.
void complete_lights(Json::Value& root) {
  if (!root.isMember("extensions")) return;
  for (Json::Value& light : root["extensions"]["KHR_lights_punctual"]["lights"])
    if (light["type"] == "spot" && !light["spot"].isObject()) light["spot"] = Json::objectValue;
  for (Json::Value& light : root["extensions"]["EXT_lights_area"]["lights"])
    if (!light.isMember("type")) light["type"] = light.get("shape", "rect");
}

/// The part of the document that tinygltf is to read.
std::string slim_json(const Json::Value& root) {
  Json::Value slim(Json::objectValue);
  for (const char* name : {"asset", "accessors", "bufferViews", "meshes", "nodes", "scene",
                           "scenes", "materials", "textures", "samplers", "cameras", "extensions"})
    if (root.isMember(name)) slim[name] = root[name];
  for (Json::Value& accessor : slim["accessors"]) {
    accessor.removeMember("min");
    accessor.removeMember("max");
  }
  for (Json::Value& mesh : slim["meshes"])
    for (Json::Value& primitive : mesh["primitives"]) primitive.removeMember("indices");
  strip(slim);
  complete_lights(slim);
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "";
  return Json::writeString(builder, slim);
}

}  // namespace

Document::Document(const std::string& path) : json_(path), held_(json_.source().size()) {
  check_declarations(json_);
  check_version();
  check_extensions(json_, warnings_);
  check_document(json_);
  load_buffers();
  check_views();
  parse_model();
  for (std::size_t i = 0; i < model_.accessors.size(); ++i) check_accessor(*this, i);
}

void Document::check_version() const {
  const std::string version = json_.root()["asset"]["version"].asString();
  if (!version.starts_with("2."))
    throw json_.error("asset.version",
                      fmt::format("this is glTF {}, not 2.0", version.substr(0, 20)),
                      "convert it to glTF 2.0");
}

void Document::load_buffers() {
  Json::Value& list = json_.root()["buffers"];
  for (Json::ArrayIndex i = 0; i < list.size(); ++i) {
    const std::string path = fmt::format("buffers[{}]", i);
    const std::size_t length = list[i]["byteLength"].asUInt64();
    std::string_view bytes = json_.source().bin();
    if (i > 0 || !json_.source().binary() || list[i].isMember("uri"))
      bytes = *owned_.emplace_back(load_buffer(list[i], path));
    if (bytes.size() < length)
      throw json_.error(
          path, fmt::format("byteLength is {}, but there are only {} bytes", length, bytes.size()));
    buffers_.push_back(bytes.substr(0, length));
  }
}

std::shared_ptr<const std::string> Document::load_buffer(Json::Value& buffer,
                                                         const std::string& path) {
  if (!buffer.isMember("uri")) throw json_.error(path, "it has no uri, and there is no BIN chunk");
  const std::string uri = buffer["uri"].asString();
  if (is_data_uri(uri)) {
    auto bytes = decode_data_uri(uri);
    if (!bytes) throw json_.error(path + ".uri", "this data URI is malformed");
    buffer["uri"] = "";
    return std::make_shared<const std::string>(std::move(*bytes));
  }
  if (auto file = external_file(uri)) return file;
  throw json_.error(path + ".uri", fmt::format("'{}' cannot be read", uri.substr(0, 200)),
                    "put that file where the uri says");
}

std::shared_ptr<const std::string> Document::external_file(const std::string& uri) {
  const auto path = local_path(json_.file(), uri);
  std::error_code error;
  if (!path || !std::filesystem::is_regular_file(*path, error)) return nullptr;
  const auto [it, is_new] = files_.try_emplace(*path);
  if (!is_new) return it->second;
  try {
    it->second = std::make_shared<const std::string>(read_file(*path));
    held_ += it->second->size();
  } catch (const std::exception&) {
    // Also what claims a size beyond all memory, as some files of the system do.
    it->second = nullptr;
  }
  return it->second;
}

void Document::check_views() const {
  const Json::Value& views = json_.root()["bufferViews"];
  for (Json::ArrayIndex i = 0; i < views.size(); ++i) {
    const auto buffer = views[i]["buffer"].asUInt64();
    const auto begin = views[i].get("byteOffset", 0).asUInt64();
    const auto length = views[i]["byteLength"].asUInt64();
    if (begin + length > buffers_[buffer].size())
      throw json_.error(fmt::format("bufferViews[{}]", i),
                        fmt::format("bytes {} to {} are outside buffers[{}], which has {}", begin,
                                    begin + length, buffer, buffers_[buffer].size()));
  }
}

void Document::parse_model() {
  const std::string text = slim_json(json_.root());
  std::string error, warning;
  tinygltf::TinyGLTF reader;
  if (!reader.LoadASCIIFromString(&model_, &error, &warning, text.data(),
                                  static_cast<unsigned>(text.size()), ""))
    throw InputError({json_.file()}, "this is no valid glTF: " + error.substr(0, 200),
                     "export it again");
}

int Document::indices_of(std::size_t mesh, std::size_t primitive) const {
  const Json::Value& list =
      json_.root()["meshes"][static_cast<Json::ArrayIndex>(mesh)]["primitives"];
  return list[static_cast<Json::ArrayIndex>(primitive)].get("indices", -1).asInt();
}

std::string_view Document::bytes_of_view(int view) const {
  const tinygltf::BufferView& v = model_.bufferViews[static_cast<std::size_t>(view)];
  return buffers_[static_cast<std::size_t>(v.buffer)].substr(v.byteOffset, v.byteLength);
}

void Document::spend(std::uint64_t bytes, const std::string& path) {
  const std::uint64_t limit = (std::uint64_t{256} << 20) + 64 * held_;
  if (bytes > limit - spent_)
    throw json_.error(path, fmt::format("this asks for more than {} bytes in all, "
                                        "far more than the file holds",
                                        limit));
  spent_ += bytes;
}

}  // namespace penumbra::gltf
