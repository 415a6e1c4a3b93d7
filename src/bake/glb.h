// Binary glTF 2.0 files, written.
#pragma once

#include <json/value.h>

#include <string>
#include <vector>

#include "scene/scene.h"

namespace penumbra::bake {

/// Triangles of one material. All attributes that are not empty have one entry a vertex.
struct GlbPrimitive {
  int material = -1;
  std::vector<Vec3> positions, normals;  ///< world, metres; unit
  std::vector<std::vector<Vec2>> uv;     ///< TEXCOORD_0, 1, …
  std::vector<Vec3> colors;              ///< COLOR_0, linear, clamped to [0, 1], 16 bits
  std::vector<std::uint32_t> indices;

  bool empty() const { return indices.empty(); }
};

/// A node with one mesh, in the world's frame.
struct GlbNode {
  std::string name;
  std::vector<GlbPrimitive> primitives;
};

struct GlbImage {
  std::string name, bytes;
  std::string mime_type = "image/png";
};

struct GlbModel {
  std::vector<GlbNode> nodes;
  std::vector<GlbImage> images;
  /// As in the file. Samplers 0 and 1 clamp and repeat; `samplers` follow.
  Json::Value materials{Json::arrayValue};
  Json::Value textures{Json::arrayValue};
  Json::Value samplers{Json::arrayValue};
  std::vector<Camera> cameras;
  std::vector<Light> lights;              ///< see add_lights()
  bool lights_are_baked = true;           ///< says `"baked": true` in their extras
  Json::Value extras{Json::objectValue};  ///< of asset, under "penumbra"
  /// A bufferView of its own, whose number becomes extras.store.samples.bufferView; empty: none.
  std::string samples;
};

/// The file's bytes: one scene, one buffer, images inside. Cameras and lights become nodes of their
/// own. Throws InputError if the file would exceed the 4 GB that its format can say.
std::string glb_bytes(const GlbModel& model);

}  // namespace penumbra::bake
