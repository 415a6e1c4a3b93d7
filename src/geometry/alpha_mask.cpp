#include "geometry/alpha_mask.h"

#include <algorithm>
#include <cmath>

namespace penumbra {
namespace {

constexpr float far_away = 1e12f;  // squared texels; larger than any texture

// One pass of the lower envelope of parabolas (Felzenszwalb and Huttenlocher 2012, algorithm
// DT(f)): out[q] = min over p of (q − p)² + f[p].
void transform_row(const std::vector<float>& f, std::vector<float>& out, std::size_t n) {
  std::vector<std::size_t> apex(n);
  std::vector<float> from(n + 1);
  std::size_t k = 0;
  const auto meet = [&](std::size_t p, std::size_t q) {
    const auto a = static_cast<float>(p), b = static_cast<float>(q);
    return (f[q] - f[p] + b * b - a * a) / (2 * (b - a));
  };
  from[0] = -far_away, from[1] = far_away;
  for (std::size_t q = 1; q < n; ++q) {
    float s = meet(apex[k], q);
    while (k > 0 && s <= from[k]) s = meet(apex[--k], q);
    if (s <= from[k]) {
      apex[k] = q;
    } else {
      apex[++k] = q;
      from[k] = s;
    }
    from[k + 1] = far_away;
  }
  k = 0;
  for (std::size_t q = 0; q < n; ++q) {
    while (from[k + 1] < static_cast<float>(q)) ++k;
    const float d = static_cast<float>(q) - static_cast<float>(apex[k]);
    out[q] = d * d + f[apex[k]];
  }
}

// The texels along one line of the texture, `step` apart, transformed in place. A repeated line has
// neighbours on both sides; a clamped or mirrored one none that are nearer than its own texels.
void transform_line(float* line, std::size_t n, std::size_t step, Wrap wrap) {
  const std::size_t copies = wrap == Wrap::repeat ? 3 : 1, skipped = copies / 2 * n;
  thread_local std::vector<float> f, out;
  f.resize(copies * n), out.resize(copies * n);
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = line[i % n * step];
  transform_row(f, out, f.size());
  for (std::size_t i = 0; i < n; ++i) line[i * step] = out[skipped + i];
}

// Squared distances of every texel to the nearest with inside[texel] true.
std::vector<float> squared_distances(const std::vector<bool>& inside, int width, int height,
                                     Wrap wrap_s, Wrap wrap_t) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  std::vector<float> field(w * h);
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = inside[i] ? 0 : far_away;
  for (std::size_t x = 0; x < w; ++x) transform_line(&field[x], h, w, wrap_t);
  for (std::size_t y = 0; y < h; ++y) transform_line(&field[y * w], w, 1, wrap_s);
  return field;
}

// Texel i, at most one outside; beyond a clamped or mirrored border lies the border's own texel.
int wrap_index(int i, int n, Wrap wrap) {
  return wrap == Wrap::repeat ? (i + n) % n : std::clamp(i, 0, n - 1);
}

float wrap_coordinate(float x, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(x, 0.0f, 1.0f);
  if (wrap == Wrap::repeat) return x - std::floor(x);
  const float m = x - 2 * std::floor(x / 2);
  return m > 1 ? 2 - m : m;
}

}  // namespace

AlphaMask::AlphaMask(const TextureImage& image, float alpha, float cutoff, Wrap wrap_s, Wrap wrap_t)
    : width_(image.width), height_(image.height), wrap_s_(wrap_s), wrap_t_(wrap_t) {
  const std::size_t n = static_cast<std::size_t>(width_) * height_;
  std::vector<bool> opaque(n), hole(n);
  for (std::size_t i = 0; i < n; ++i) {
    opaque[i] = static_cast<float>(image.rgba[4 * i + 3]) / 255 * alpha >= cutoff;
    hole[i] = !opaque[i];
  }
  const std::vector<float> outside = squared_distances(opaque, width_, height_, wrap_s, wrap_t);
  const std::vector<float> within = squared_distances(hole, width_, height_, wrap_s, wrap_t);
  distance_.resize(n);
  // The edge runs half a texel from the centres on both of its sides.
  for (std::size_t i = 0; i < n; ++i)
    distance_[i] = opaque[i] ? 0.5f - std::sqrt(within[i]) : std::sqrt(outside[i]) - 0.5f;
}

float AlphaMask::distance(float s, float t) const {
  const float x = s * static_cast<float>(width_) - 0.5f, y = t * static_cast<float>(height_) - 0.5f;
  if (!std::isfinite(x) || !std::isfinite(y)) return -1;
  const float fx = std::floor(x), fy = std::floor(y);
  const auto at = [&](int i, int j) {
    return distance_[static_cast<std::size_t>(wrap_index(j, height_, wrap_t_)) * width_ +
                     wrap_index(i, width_, wrap_s_)];
  };
  const int i = static_cast<int>(fx), j = static_cast<int>(fy);
  const float u = x - fx, v = y - fy;
  return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) +
         (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
}

float MaskedMesh::distance(std::uint32_t triangle, float b1, float b2, float scale) const {
  const TextureSlot& slot = material->diffuse_map;
  const std::vector<Vec2>& uv = mesh->uv[slot.uv_set];
  if (!mask || uv.empty()) return -1;
  const std::uint32_t* v = &mesh->indices[std::size_t{3} * triangle];
  const float b0 = 1 - b1 - b2;
  const Vec2 &a = uv[v[0]], &b = uv[v[1]], &c = uv[v[2]];
  const float x = (b0 * a.x + b1 * b.x + b2 * c.x) * slot.scale.x;
  const float y = (b0 * a.y + b1 * b.y + b2 * c.y) * slot.scale.y;
  // KHR_texture_transform: translation · rotation · scale.
  const float cs = std::cos(slot.rotation), sn = std::sin(slot.rotation);
  const float s = wrap_coordinate(cs * x + sn * y + slot.offset.x, slot.wrap_s);
  const float t = wrap_coordinate(-sn * x + cs * y + slot.offset.y, slot.wrap_t);
  const float texels = mask->distance(s, t);
  // Metres a texel, from the ratio of the triangle's areas.
  const float uv_area = std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) *
                        std::abs(slot.scale.x * slot.scale.y) * static_cast<float>(mask->width()) *
                        static_cast<float>(mask->height());
  const Vec3& p = mesh->positions[v[0]];
  const float area = length(cross(mesh->positions[v[1]] - p, mesh->positions[v[2]] - p));
  return uv_area > 0 ? texels * scale * std::sqrt(area / uv_area) : texels;
}

AlphaMasks::AlphaMasks(const Scene& scene) : masks_(scene.materials.size()) {
  for (std::size_t i = 0; i < masks_.size(); ++i) {
    const Material& material = scene.materials[i];
    if (!material.alpha_cutoff || !material.diffuse_map.used()) continue;
    const auto& image = scene.textures[static_cast<std::size_t>(material.diffuse_map.image)];
    masks_[i] =
        std::make_unique<AlphaMask>(image, material.alpha, *material.alpha_cutoff,
                                    material.diffuse_map.wrap_s, material.diffuse_map.wrap_t);
  }
}

const AlphaMask* AlphaMasks::find(std::uint32_t material) const { return masks_[material].get(); }

}  // namespace penumbra
