#include "bake/gl/sample_pass.h"

#include <algorithm>
#include <array>

namespace penumbra::bake {
namespace {

/// A little larger than the sphere, so that no texel at its edge is lost where coordinates round.
constexpr float box_scale = 1 + 0x1p-10f;

void put(float* to, const Vec3& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

void put(float* to, const Vec3d& row, double constant) {
  put(to, Vec3(row));
  to[3] = static_cast<float>(constant);
}

GlView gl_view(const SampleView& view, std::size_t bit) {
  GlView out{};
  const PyramidToBox& m = view.projection;
  put(out.origin, Vec3(m.origin));
  out.least_w = static_cast<float>(view.least_w);
  put(out.x, m.x, m.x_0), put(out.y, m.y, m.y_0), put(out.w, m.w, m.w_0);
  put(out.sample, Vec3(view.sample));
  out.is_near = view.at_infinity ? 0.0f : 1.0f;
  out.bit[0] = std::uint32_t{1} << bit;
  return out;
}

GlWeight gl_weight(const TexelWeights& w) {
  GlWeight out{};
  put(out.first, w.first), put(out.normal, w.normal);
  out.scale = w.scale, out.k = w.k;
  return out;
}

void add_box(const Sphere& s, bool is_cut, std::vector<float>& out) {
  static constexpr std::array<int, 36> corners{0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6,
                                               0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6,
                                               0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
  const float r = s.radius * box_scale;
  for (const int c : corners) {
    const Vec3 at = s.center + Vec3{c & 1 ? r : -r, c & 2 ? r : -r, c & 4 ? r : -r};
    out.insert(out.end(), {at.x, at.y, at.z, s.center.x, s.center.y, s.center.z,
                           is_cut ? -s.radius : s.radius});
  }
}

class Words {
 public:
  Words(const Occluders& occluders, const Tile& tile, const OwnTriangles& own,
        const SampledLight& light)
      : occluders_(occluders), tile_(tile), own_(own), light_(light) {}

  WordPass prepare(std::span<const LightSample> samples) {
    const Shaft shaft(tile_, light_, samples, occluders_);
    WordPass out;
    if (shaft.empty) return out;
    triangles_.clear(), masked_.clear();
    collect(occluders_, shaft, own_, light_.own_instance, triangles_, masked_);
    add_triangles(out);
    for (const Sphere& s : occluders_.spheres())
      if (shaft.meets(s.center, s.radius))
        add_box(s, tile_.height_of(s.center) < s.radius, out.spheres);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!is_above(tile_, light_, samples[i])) continue;
      const auto view = view_of(occluders_, tile_, light_, samples[i], shaft.receiver_epsilon);
      if (!view) continue;
      out.views.push_back(gl_view(*view, i));
      if (!masked_.empty()) draw_holes(*view, i, shaft.receiver_epsilon, out);
    }
    return out;
  }

 private:
  void add_triangles(WordPass& out) const {
    out.triangles.reserve(3 * triangles_.count);
    for (std::size_t t = 0; t < triangles_.count; ++t)
      for (int c = 0; c < 3; ++c) out.triangles.push_back(triangles_.at(t, c));
  }

  void draw_holes(const SampleView& view, std::size_t bit, float receiver_epsilon, WordPass& out) {
    raster_.resize(tile_.width, tile_.height);
    for (const MaskedTriangle& t : masked_)
      draw_masked(view, t, *occluders_.mask(t.instance), receiver_epsilon, raster_);
    out.words.resize(static_cast<std::size_t>(tile_.width) * tile_.height);
    std::uint32_t* word = out.words.data();
    for (int j = 0; j < tile_.height; ++j)
      for (int i = 0; i < tile_.width; ++i, ++word) *word |= std::uint32_t{raster_.at(i, j)} << bit;
  }

  const Occluders& occluders_;
  const Tile& tile_;
  const OwnTriangles& own_;
  const SampledLight& light_;
  TriangleList triangles_;
  std::vector<MaskedTriangle> masked_;
  BitRaster raster_;
};

/// Bits of the samples that the receiver's own plane hides.
std::uint32_t below(const Tile& tile, const SampledLight& light,
                    std::span<const LightSample> samples) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (!is_above(tile, light, samples[i])) bits |= std::uint32_t{1} << i;
  return bits;
}

}  // namespace

SamplePass prepare_pass(const Occluders& occluders, const Tile& tile, const OwnTriangles& own,
                        const SampledLight& light, std::span<const LightSample> samples,
                        BakeQuantity quantity) {
  SamplePass pass;
  pass.origin = tile.origin, pass.step_x = tile.step_x, pass.step_y = tile.step_y;
  pass.width = tile.width, pass.height = tile.height;
  Words words(occluders, tile, own, light);
  for (std::size_t first = 0; first < samples.size(); first += samples_a_word) {
    const auto some = samples.subspan(first, std::min(samples_a_word, samples.size() - first));
    WordPass& word = pass.words.emplace_back(words.prepare(some));
    word.below = below(tile, light, some);
    for (std::uint32_t& bits : word.words) bits |= word.below;
    for (const LightSample& sample : some) {
      const TexelWeights weights = weights_of(tile, light, sample, quantity);
      pass.falloff = weights.falloff;
      word.weights.push_back(gl_weight(weights));
    }
  }
  return pass;
}

}  // namespace penumbra::bake
