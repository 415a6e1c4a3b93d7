// The distance field of a whole scene.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "sdf/mesh_distance.h"

namespace penumbra::sdf {

struct FieldData;

struct FieldOptions {
  bool only_distance_fields = false;  ///< the `sdf` objects alone
  bool prune = true;                  ///< false: every point by the whole code, for comparison
  std::size_t region_bytes = std::size_t{20} << 20;  ///< about what cells and their codes may take
  /// Gives the distance to an instance that is not exact (box, quad, polygon); null leaves it out,
  /// with a warning.
  std::function<std::shared_ptr<const MeshDistance>(const Scene&, std::size_t instance)>
      mesh_distance;
};

/// What the surface nearest to a point is made of.
struct SurfaceAt {
  struct Part {
    std::uint32_t material;
    float weight;
  };
  std::uint32_t object = 0;
  std::vector<Part> parts;  ///< weights add up to 1; several where smooth operators blend
};

/// f at a point: negative inside, and never farther from 0 than the way to the surface, for slopes
/// are divided out (lipschitz.h). Immutable; every function is thread-safe. Values do not depend on
/// how points are grouped into calls.
class Field {
 public:
  explicit Field(const Scene& scene, const FieldOptions& options = {});
  ~Field();
  Field(Field&&) noexcept;
  Field& operator=(Field&&) noexcept;

  /// True if the scene has nothing that has a distance: then distances are infinite.
  bool empty() const;
  float distance(const Vec3& p) const;
  void distance(std::span<const Vec3> points, std::span<float> out) const;
  /// The unit normal at points on or near the surface: where f grows fastest. Differences over
  /// `step` metres; 0 chooses `normal_step`.
  void normal(std::span<const Vec3> points, std::span<Vec3> out, float step = 0) const;
  /// A thousandth of the point's greatest coordinate: wide enough for rounding not to show.
  static float normal_step(const Vec3& p);
  SurfaceAt surface(const Vec3& p) const;
  /// Per point the object and, where one material alone makes the surface, it; else `blended`.
  struct Owner {
    std::uint32_t object, material;
    bool blended;
  };
  void owners(std::span<const Vec3> points, std::span<Owner> out) const;

  /// Of all that is bounded; empty if nothing is.
  const Bounds& bounds() const;
  bool is_bounded() const;
  const std::vector<std::string>& warnings() const;
  std::size_t memory_bytes() const;
  /// Words of the whole code, and how many different shortened codes the cells have.
  std::size_t code_size() const;
  std::size_t region_codes() const;

  const FieldData& data() const { return *data_; }

 private:
  std::unique_ptr<FieldData> data_;
};

/// What a Field of the scene's distance-field objects warns of, without building one.
std::vector<std::string> field_warnings(const Scene& scene);

}  // namespace penumbra::sdf
