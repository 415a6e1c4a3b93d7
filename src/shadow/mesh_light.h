// The surface of an emissive mesh, and which part of it is turned to a point.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace penumbra {

/// One face of a mesh light, world frame.
struct LightFace {
  Vec3 a, b, c;
  Vec3 normal;           ///< unit, by the winding
  float area = 0;        ///< m², times the brightness
  float brightness = 1;  ///< of the light's emission, (0, 1]; below 1 of textures alone
};

/// Faces are kept in the order of a tree whose nodes know the ball and the cone of normals of
/// theirs, so that a part that is turned to a point, or away from it, is known as a whole.
/// Immutable once made; queries are thread-safe.
struct MeshLight {
  std::vector<LightFace> faces;
  std::vector<float> areas;  ///< of the faces up to and with each
  bool is_textured = false;  ///< the faces are parts of the mesh's (textured_faces.h)
  bool flat = false;         ///< all faces in one plane, to floating-point error
  Vec3 center;               ///< of the area
  float radius = 0;          ///< of the ball round the center that holds all of it
  bool closed = false;       ///< every edge has two faces: its far side is hidden by its near side

  MeshLight() = default;
  MeshLight(const Scene& scene, const Light& light);

  /// Faces that follow one another.
  struct Run {
    std::uint32_t first = 0, last = 0;  ///< the one behind the last
    float area = 0;                     ///< of all runs up to and with this
  };
  struct Sum {
    float area = 0;
    Vec3 moment;  ///< area times centre
  };
  /// The faces that can light the point: those turned to it; of an open double-sided mesh all;
  /// where none is turned to it all (its visible fraction is defined everywhere, its light is
  /// zero). `runs`, which may be null, gets them (cleared first).
  Sum seen_from(const Vec3& point, bool double_sided, std::vector<Run>* runs = nullptr) const;
  /// For shaders, four numbers a texel, parents before children. Of a node: ball's centre, radius;
  /// axis, cosine; moment, area; first face, the one behind the last, number of the next node where
  /// this one's children are left out, 1 = a leaf. Of a face: a, its area; b, areas up to and with
  /// it; c, 0; normal, 0.
  void write_texels(std::vector<float>& nodes, std::vector<float>& faces) const;
  static bool turned(const LightFace& face, const Vec3& point) {
    return dot(face.normal, point - face.a) > 0;
  }

 private:
  struct Node {
    Vec3 center, axis;           ///< of the ball; of the cone of normals
    float radius = 0;            ///< of the ball
    float cosine = 1, sine = 0;  ///< of the cone's half-angle; a cosine of −1: all directions
    std::uint32_t first = 0, last = 0;
    std::uint32_t second = 0;  ///< the other child follows the node itself; 0: a leaf
    Sum sum;
  };
  class Search;

  void add_faces(const Mesh& mesh, const Affine& world_from_mesh);
  void build(std::uint32_t first, std::uint32_t last);
  void bound(Node& node) const;

  std::vector<Node> nodes_;
};

}  // namespace penumbra
