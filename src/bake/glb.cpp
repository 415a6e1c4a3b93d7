#include "bake/glb.h"

#include <json/writer.h>

#include <algorithm>
#include <limits>
#include <set>

#include "bake/glb_buffer.h"
#include "bake/glb_lights.h"
#include "base/error.h"

namespace penumbra::bake {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBinary = 0x004e4942;

class Writer {
 public:
  explicit Writer(const GlbModel& model) : model_(model) {}

  std::string bytes() {
    add_asset();
    for (const GlbNode& node : model_.nodes) add_mesh_node(node);
    for (const Camera& camera : model_.cameras) add_camera(camera);
    add_lights(model_.lights, model_.lights_are_baked, root_, extensions_);
    add_images();
    if (!model_.materials.empty()) root_["materials"] = model_.materials;
    note_extensions(model_.materials);
    note_extensions(model_.textures);
    for (const std::string& name : extensions_) root_["extensionsUsed"].append(name);
    add_scene();
    root_["bufferViews"] = buffer_.views();
    root_["accessors"] = buffer_.accessors();
    Json::Value buffer;
    buffer["byteLength"] = static_cast<Json::UInt64>(buffer_.bytes().size());
    root_["buffers"].append(buffer);
    return packed();
  }

 private:
  void note_extensions(const Json::Value& in) {
    if (in.isArray())
      for (const Json::Value& value : in) note_extensions(value);
    if (!in.isObject()) return;
    for (const std::string& key : in.getMemberNames()) {
      if (key == "extras") continue;
      if (key == "extensions")
        for (const std::string& name : in[key].getMemberNames()) extensions_.insert(name);
      note_extensions(in[key]);
    }
  }

  void add_asset() {
    Json::Value& asset = root_["asset"];
    asset["version"] = "2.0";
    asset["generator"] = "penumbra bake";
    if (!model_.extras.empty()) asset["extras"]["penumbra"] = model_.extras;
    if (!model_.samples.empty())
      asset["extras"]["penumbra"]["store"]["samples"]["bufferView"] =
          buffer_.add_view(model_.samples);
  }

  Json::Value primitive(const GlbPrimitive& p) {
    Json::Value out;
    Json::Value& attributes = out["attributes"];
    attributes["POSITION"] = buffer_.add_positions(p.positions);
    if (!p.normals.empty()) attributes["NORMAL"] = buffer_.add_vectors(p.normals);
    for (std::size_t i = 0; i < p.uv.size(); ++i)
      attributes["TEXCOORD_" + std::to_string(i)] = buffer_.add_uvs(p.uv[i]);
    if (!p.colors.empty()) attributes["COLOR_0"] = buffer_.add_colors(p.colors);
    out["indices"] = buffer_.add_indices(p.indices, p.positions.size());
    if (p.material >= 0) out["material"] = p.material;
    return out;
  }

  void add_mesh_node(const GlbNode& node) {
    Json::Value mesh;
    mesh["name"] = node.name;
    for (const GlbPrimitive& p : node.primitives)
      if (!p.empty()) mesh["primitives"].append(primitive(p));
    if (!mesh.isMember("primitives")) return;
    Json::Value out;
    out["name"] = node.name;
    out["mesh"] = root_["meshes"].size();
    root_["meshes"].append(mesh);
    root_["nodes"].append(out);
  }

  void add_camera(const Camera& camera) {
    Json::Value lens, node;
    if (!camera.name.empty()) lens["name"] = node["name"] = camera.name;
    // glTF needs planes to clip at, which our cameras do without.
    const double far = 4.0 * std::max(length(camera.look_at - camera.position), 1e-3f);
    if (camera.ortho_height) {
      lens["type"] = "orthographic";
      Json::Value& o = lens["orthographic"];
      o["xmag"] = o["ymag"] = *camera.ortho_height / 2.0;
      o["znear"] = 0.0, o["zfar"] = 100 * far;
    } else {
      lens["type"] = "perspective";
      lens["perspective"]["yfov"] = static_cast<double>(camera.vertical_fov);
      lens["perspective"]["znear"] = far / 1000;
    }
    node["camera"] = root_["cameras"].size();
    node["matrix"] = matrix_facing(camera.position, camera.look_at - camera.position, camera.up);
    root_["cameras"].append(lens);
    root_["nodes"].append(node);
  }

  void add_images() {
    for (const GlbImage& image : model_.images) {
      Json::Value out;
      if (!image.name.empty()) out["name"] = image.name;
      out["mimeType"] = image.mime_type;
      out["bufferView"] = buffer_.add_view(image.bytes);
      root_["images"].append(out);
    }
    if (model_.textures.empty()) return;
    root_["textures"] = model_.textures;
    constexpr int linear = 9729, mipmaps = 9987, clamp = 33071, repeat = 10497;
    const bool repeats = !model_.samplers.empty() ||
                         std::ranges::any_of(model_.textures, [](const Json::Value& texture) {
                           return texture["sampler"] == 1;
                         });
    for (const int wrap : {clamp, repeat}) {
      if (wrap == repeat && !repeats) break;
      Json::Value sampler;
      sampler["magFilter"] = linear, sampler["minFilter"] = mipmaps;
      sampler["wrapS"] = sampler["wrapT"] = wrap;
      root_["samplers"].append(sampler);
    }
    for (const Json::Value& sampler : model_.samplers) root_["samplers"].append(sampler);
  }

  void add_scene() {
    Json::Value scene;
    for (Json::ArrayIndex i = 0; i < root_["nodes"].size(); ++i) scene["nodes"].append(i);
    root_["scenes"].append(scene);
    root_["scene"] = 0;
  }

  std::string packed() const {
    Json::StreamWriterBuilder builder;
    builder["indentation"] = "";
    std::string json = Json::writeString(builder, root_), binary = buffer_.bytes();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    const std::size_t size = 12 + 8 + json.size() + 8 + binary.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
      throw InputError("the file would be larger than the 4 GB that a .glb can be",
                       "choose coarser texels by --texel-size");
    std::string out;
    const auto put = [&](std::size_t n) {
      const auto word = static_cast<std::uint32_t>(n);
      out.append(reinterpret_cast<const char*>(&word), 4);
    };
    for (const std::size_t n :
         {std::size_t{kMagic}, std::size_t{2}, size, json.size(), std::size_t{kJson}})
      put(n);
    out += json;
    put(binary.size()), put(kBinary);
    return out + binary;
  }

  const GlbModel& model_;
  Json::Value root_;
  GlbBuffer buffer_;
  std::set<std::string> extensions_;
};

}  // namespace

std::string glb_bytes(const GlbModel& model) { return Writer(model).bytes(); }

}  // namespace penumbra::bake
