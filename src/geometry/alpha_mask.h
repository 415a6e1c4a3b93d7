// Cut-out textures (glTF alphaMode MASK): where a surface has holes, and how far the holes reach.
#pragma once

#include <memory>
#include <vector>

#include "scene/scene.h"

namespace penumbra {

/// The opaque part of one texture under one cutoff, as a field of distances.
class AlphaMask {
 public:
  /// Texels with alpha · `alpha` < cutoff are holes. Exact distances between texel centres by
  /// Felzenszwalb and Huttenlocher (2012), Distance Transforms of Sampled Functions, section 2.
  /// `wrap_s`, `wrap_t`: where the texture repeats, so does the field.
  AlphaMask(const TextureImage& image, float alpha, float cutoff, Wrap wrap_s, Wrap wrap_t);

  /// Signed distance from (s, t), in texels, to the edge of the opaque part; negative inside it.
  /// Interpolated bilinearly, so that the edge is continuous. (s, t) after slot transform and wrap.
  float distance(float s, float t) const;
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  Wrap wrap_s_, wrap_t_;
  std::vector<float> distance_;
};

/// A masked material on a mesh: answers for a point of a triangle.
struct MaskedMesh {
  const Mesh* mesh = nullptr;
  const Material* material = nullptr;
  const AlphaMask* mask = nullptr;  ///< null: the whole surface is opaque
  bool culls_back = false;          ///< rays to see by go through it from behind

  /// Metres on the surface from the point with barycentric weights (b1, b2) of `triangle` to the
  /// nearest opaque point; zero or negative where it is opaque itself. `scale`: world metres per
  /// metre of the mesh.
  float distance(std::uint32_t triangle, float b1, float b2, float scale = 1) const;
};

/// Masks of all materials that have holes, shared between meshes.
class AlphaMasks {
 public:
  explicit AlphaMasks(const Scene& scene);
  /// No value for a material without holes.
  const AlphaMask* find(std::uint32_t material) const;

 private:
  std::vector<std::unique_ptr<AlphaMask>> masks_;  ///< per material
};

}  // namespace penumbra
