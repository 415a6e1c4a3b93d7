#include "shadow/textured_faces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "image/texture_sampler.h"

namespace penumbra {
namespace {

constexpr double most_faces = 32768;
constexpr float like = 1.0f / 256;

struct Corner {
  Vec3 position;
  Vec2 uv;
};

Corner middle(const Corner& a, const Corner& b) {
  return {(a.position + b.position) * 0.5f, {(a.uv.x + b.uv.x) * 0.5f, (a.uv.y + b.uv.y) * 0.5f}};
}

struct Part {
  Corner a, b, c;
};

class Cutter {
 public:
  Cutter(const Scene& scene, const Light& light)
      : instance_(scene.instances[static_cast<std::size_t>(light.instance)]),
        mesh_(scene.meshes[instance_.mesh]),
        slot_(scene.materials[instance_.material].emission_map),
        image_(scene.textures[static_cast<std::size_t>(slot_.image)]),
        sampler_(image_, true),
        side_(instance_.world_from_mesh.determinant() < 0 ? -1.0f : 1.0f) {
    for (int c = 1; c < 3; ++c)
      if (light.emission[c] > light.emission[channel_]) channel_ = c;
  }

  std::vector<LightFace> cut() {
    const double count = static_cast<double>(std::max<std::size_t>(mesh_.triangle_count(), 1));
    const int most = std::max(0, static_cast<int>(std::log2(most_faces / count) / 2));
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
      const auto corner = [&](std::size_t k) {
        const std::uint32_t v = mesh_.indices[3 * t + k];
        const std::vector<Vec2>& uv = mesh_.uv[slot_.uv_set];
        return Corner{instance_.world_from_mesh.point(mesh_.positions[v]),
                      uv.empty() ? Vec2{} : uv[v]};
      };
      const Part whole{corner(0), corner(1), corner(2)};
      const int depth = std::min(most, depth_of(whole));
      const float width = width_of(whole) / static_cast<float>(1 << depth);
      visit(whole, depth, width);
    }
    return std::move(faces_);
  }

 private:
  /// Of a square of the triangle's area twice, in texture coordinates.
  static float width_of(const Part& p) {
    const Vec2 x{p.b.uv.x - p.a.uv.x, p.b.uv.y - p.a.uv.y};
    const Vec2 y{p.c.uv.x - p.a.uv.x, p.c.uv.y - p.a.uv.y};
    return std::sqrt(std::abs(x.x * y.y - x.y * y.x));
  }

  /// How often to halve its sides until they are shorter than a texel.
  int depth_of(const Part& p) const {
    float longest = 0;
    for (const auto& [from, to] : {std::pair{p.a, p.b}, {p.b, p.c}, {p.c, p.a}}) {
      const Vec2 a = transform_uv(slot_, from.uv), b = transform_uv(slot_, to.uv);
      longest = std::max({longest, std::abs(b.x - a.x) * static_cast<float>(image_.width),
                          std::abs(b.y - a.y) * static_cast<float>(image_.height)});
    }
    return longest > 1 ? static_cast<int>(std::ceil(std::log2(std::min(longest, 1e6f)))) : 0;
  }

  /// Appends the part's faces. Returns its brightness if it is one face or dark, else −1.
  float visit(const Part& p, int depth, float width) {
    if (depth == 0) {
      const Vec2 centre{(p.a.uv.x + p.b.uv.x + p.c.uv.x) / 3, (p.a.uv.y + p.b.uv.y + p.c.uv.y) / 3};
      const float brightness = sampler_.sample(slot_, centre, width).color[channel_];
      append(p, brightness);
      return brightness;
    }
    const std::size_t before = faces_.size();
    const Corner ab = middle(p.a, p.b), bc = middle(p.b, p.c), ca = middle(p.c, p.a);
    const std::array<Part, 4> parts{{{p.a, ab, ca}, {ab, p.b, bc}, {ca, bc, p.c}, {ab, bc, ca}}};
    float least = INFINITY, most = -INFINITY, sum = 0;
    for (const Part& part : parts) {
      const float x = visit(part, depth - 1, width);
      least = std::min(least, x), most = std::max(most, x), sum += x;
    }
    if (least < 0 || most - least > like) return -1;
    faces_.resize(before);
    append(p, sum / 4);
    return sum / 4;
  }

  void append(const Part& p, float brightness) {
    const Vec3 n = cross(p.b.position - p.a.position, p.c.position - p.a.position);
    const float size = length(n);
    if (!(size > 0) || !(brightness > 0)) return;
    faces_.push_back({p.a.position, p.b.position, p.c.position, n * (side_ / size),
                      brightness * size / 2, brightness});
  }

  const Instance& instance_;
  const Mesh& mesh_;
  const TextureSlot& slot_;
  const TextureImage& image_;
  TextureSampler sampler_;
  float side_;
  int channel_ = 0;
  std::vector<LightFace> faces_;
};

}  // namespace

std::vector<LightFace> textured_faces(const Scene& scene, const Light& light) {
  return Cutter(scene, light).cut();
}

}  // namespace penumbra
