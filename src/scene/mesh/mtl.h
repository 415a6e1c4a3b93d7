// Material libraries of OBJ files (Wavefront 1995, Object Files; Ramey, Rose and Tyerman, MTL
// material format).
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>

#include "scene/scene.h"

namespace penumbra {

/// Adds the materials and textures of the libraries of one OBJ file to a scene.
///
/// Kd is the diffuse albedo, Ke the emission. Ks is a highlight, not a reflectance: 0.5, what most
/// programs write for plastic, becomes 4 % at normal incidence; where illum asks for reflections (3
/// and above) and Ks is above 0.5 it is the mirror's reflectance instead. Ns is a Blinn–Phong
/// exponent: GGX α = √(2 / (Ns + 2)) (Walter et al. 2007, Microfacet Models for Refraction, section
/// 5.2) and the perceptual roughness is √α. map_Kd and map_Ke are read with -s, -o and -clamp.
class MaterialLibraries {
 public:
  explicit MaterialLibraries(Scene& scene) : scene_(scene) {}

  /// Reads what an `mtllib` line names: one file whose name may have spaces or, if there is no such
  /// file, several; each once. One that cannot be read leaves a warning; bad numbers in it throw
  /// InputError with line and column. `obj_folder` is empty or ends with '/'.
  void load(const std::string& obj_folder, const std::string& names);

  /// The material of that name; none: a default material, with a warning the first
  /// time if there is a library at all.
  std::uint32_t find(const std::string& name);
  /// The material of faces without one.
  std::uint32_t default_material();

 private:
  friend class MtlReader;
  void load_one(const std::string& obj_folder, const std::string& name);
  int texture(const std::string& path);

  Scene& scene_;
  std::unordered_map<std::string, std::uint32_t> materials_;
  std::unordered_map<std::string, int> textures_;  ///< by path; −1 = cannot be read
  std::unordered_set<std::string> seen_;           ///< paths of libraries
  bool any_loaded_ = false;
  int default_ = -1;
};

}  // namespace penumbra
