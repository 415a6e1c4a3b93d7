#include "scene/mesh/mtl.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include "base/atomic_file.h"
#include "scene/mesh/text_cursor.h"

namespace penumbra {
namespace {

/// The file's bytes; none if it is missing or no regular file (a device may never end).
std::optional<std::string> read_regular_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  try {
    return read_file(path);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string path_in(const std::string& folder, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name.starts_with('/') ? name : folder + name;
}

Vec3 clamp01(const Vec3& c) {
  const auto one = [](float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; };  // NaN is 0
  return {one(c.x), one(c.y), one(c.z)};
}

Vec3 radiance(const Vec3& c) {
  const auto one = [](float x) { return x > 0 && std::isfinite(x) ? x : 0.0f; };
  return {one(c.x), one(c.y), one(c.z)};
}

/// Highlights as most programs write them: Ks 0.5 for plastic, which reflects 4 %.
constexpr float kReflectancePerKs = 0.08f;
constexpr int kFirstReflectingIllum = 3;

/// What the lines of a material say before they become a Material.
struct MtlMaterial {
  Vec3 kd{0.8f, 0.8f, 0.8f}, ks{}, ke{};
  float ns = 0;
  std::int64_t illum = 2;

  void apply_to(Material& material) const {
    material.diffuse = clamp01(kd);
    material.emission = radiance(ke);
    const Vec3 highlight = clamp01(ks);
    if (illum >= kFirstReflectingIllum && max_component(highlight) > 0.5f) {
      material.mirror = highlight;
      material.diffuse = material.diffuse * (1 - max_component(highlight));
    } else {
      material.specular = highlight * kReflectancePerKs;
    }
    const float exponent = ns > 0 ? ns : 0;
    material.roughness = std::sqrt(std::sqrt(2 / (exponent + 2)));
    if (material.diffuse_map.used() && material.diffuse == Vec3{}) material.diffuse = Vec3(1);
    if (material.emission_map.used() && material.emission == Vec3{}) material.emission = Vec3(1);
  }
};

}  // namespace

/// Reads one library.
class MtlReader {
 public:
  MtlReader(MaterialLibraries& libraries, const std::string& folder, const std::string& file,
            std::string_view text)
      : libraries_(libraries), folder_(folder), cursor_(file, text) {}

  void read() {
    for (; !cursor_.at_end(); cursor_.next_line()) statement(cursor_.word());
    finish();
  }

 private:
  Material& material() { return libraries_.scene_.materials[current_]; }

  void statement(std::string_view keyword) {
    if (keyword == "newmtl") return begin(std::string(cursor_.rest_of_line()));
    if (current_ < 0) return;
    if (keyword == "Kd") values_.kd = color(values_.kd);
    if (keyword == "Ks") values_.ks = color(values_.ks);
    if (keyword == "Ke") values_.ke = color(values_.ke);
    if (keyword == "Ns") values_.ns = cursor_.number("Ns");
    if (keyword == "illum") values_.illum = cursor_.integer("illum");
    if (keyword == "map_Kd") map(material().diffuse_map);
    if (keyword == "map_Ke") map(material().emission_map);
  }

  void begin(std::string name) {
    finish();
    auto& materials = libraries_.scene_.materials;
    current_ = static_cast<int>(materials.size());
    values_ = {};
    materials.emplace_back().name = name;
    libraries_.materials_.emplace(std::move(name), current_);  // the first of a name counts
  }

  void finish() {
    if (current_ >= 0) values_.apply_to(material());
  }

  /// One number is grey. Spectral curves and XYZ are not for us.
  Vec3 color(const Vec3& otherwise) {
    TextCursor ahead = cursor_;
    const std::string_view word = ahead.word();
    if (word == "spectral" || word == "xyz") return otherwise;
    const float r = cursor_.number("red");
    if (cursor_.at_line_end()) return Vec3(r);
    const float g = cursor_.number("green");
    return {r, g, cursor_.number("blue")};
  }

  /// Options begin with a minus; the rest of the line is the file's name, which may have spaces.
  void map(TextureSlot& slot) {
    Vec2 scale{1, 1}, offset{0, 0};
    for (;;) {
      TextCursor ahead = cursor_;
      const std::string_view word = ahead.word();
      if (!word.starts_with('-') || ahead.at_line_end()) break;
      cursor_ = ahead;
      option(word, slot, scale, offset);
    }
    const std::string name(cursor_.rest_of_line());
    if (name.empty()) return;
    slot.image = libraries_.texture(path_in(folder_, name));
    // With v up, v' = v s + o; our texture coordinates are 1 − v.
    slot.scale = scale;
    slot.offset = {offset.x, 1 - scale.y - offset.y};
  }

  void option(std::string_view name, TextureSlot& slot, Vec2& scale, Vec2& offset) {
    if (name == "-s") return pair(scale);
    if (name == "-o") return pair(offset);
    if (name == "-clamp") {
      if (cursor_.word() == "on") slot.wrap_s = slot.wrap_t = Wrap::clamp;
      return;
    }
    Vec2 ignored;
    if (name == "-t" || name == "-mm") return pair(ignored);
    cursor_.word();  // all others take one word
  }

  /// One to three numbers, of which the first two count.
  void pair(Vec2& value) {
    const auto finite = [](float x, float otherwise) { return std::isfinite(x) ? x : otherwise; };
    value.x = finite(cursor_.number("u"), value.x);
    if (next_is_number()) value.y = finite(cursor_.number("v"), value.y);
    if (next_is_number()) cursor_.number("w");
  }

  bool next_is_number() {
    TextCursor ahead = cursor_;
    const std::string_view word = ahead.word();
    // The last word of the line is the name, whatever it looks like.
    return !word.empty() && word.find_first_not_of("+-.0123456789eE") == std::string_view::npos &&
           !ahead.at_line_end();
  }

  MaterialLibraries& libraries_;
  const std::string& folder_;
  TextCursor cursor_;
  MtlMaterial values_;
  int current_ = -1;
};

void MaterialLibraries::load(const std::string& obj_folder, const std::string& names) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path_in(obj_folder, names), error))
    return load_one(obj_folder, names);
  std::istringstream words(names);
  for (std::string name; words >> name;) load_one(obj_folder, name);
}

void MaterialLibraries::load_one(const std::string& obj_folder, const std::string& name) {
  const std::string path = path_in(obj_folder, name);
  if (!seen_.insert(path).second) return;
  const auto text = read_regular_file(path);
  if (!text) {
    scene_.report.warnings.push_back("the material library " + in_quotes(name) +
                                     " cannot be read: its materials are the default");
    return;
  }
  const std::string folder = path.substr(0, path.find_last_of('/') + 1);
  MtlReader(*this, folder, path, *text).read();
  any_loaded_ = true;
}

int MaterialLibraries::texture(const std::string& path) {
  const auto [known, is_new] = textures_.emplace(path, -1);
  if (!is_new) return known->second;
  const auto bytes = read_regular_file(path);
  if (!bytes) {
    scene_.report.warnings.push_back("the texture " + in_quotes(path) +
                                     " cannot be read: left out");
    return -1;
  }
  TextureImage image;
  if (!decode_texture(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size(), image))
    scene_.report.warnings.push_back("the texture " + in_quotes(path) +
                                     " cannot be decoded: white");
  image.name = path;
  scene_.textures.push_back(std::move(image));
  return known->second = static_cast<int>(scene_.textures.size() - 1);
}

std::uint32_t MaterialLibraries::find(const std::string& name) {
  const auto found = materials_.find(name);
  if (found != materials_.end()) return found->second;
  if (any_loaded_)
    scene_.report.warnings.push_back("there is no material " + in_quotes(name) +
                                     ": the default is used");
  return materials_[name] = default_material();
}

std::uint32_t MaterialLibraries::default_material() {
  if (default_ < 0) {
    default_ = static_cast<int>(scene_.materials.size());
    scene_.materials.emplace_back().name = "default";
  }
  return static_cast<std::uint32_t>(default_);
}

}  // namespace penumbra
