// "What part of this light can be seen from here?", by any of the methods.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/cone_tree.h"
#include "geometry/world.h"
#include "shadow/light_points.h"
#include "shadow/light_view.h"

namespace penumbra {

enum class ShadowKind : std::uint8_t {
  none,
  hard,
  area,
  parker,
  heckbert_herf,  ///< baked before (render/known_light.h): not asked of Shadows
  sdf_classic,
  sdf_improved,
  sdf_inner
};
/// Of the published marches: blog is a variant of sdf_classic, abs of sdf_inner; march, of hard, is
/// the plain march that they begin from.
enum class SdfVariant : std::uint8_t { published, blog, abs, march };
enum class Profile : std::uint8_t { cubic, sine, linear };
enum class Composite : std::uint8_t { min, multiply, add };

struct ShadowOptions {
  ShadowKind kind = ShadowKind::parker;
  int light_samples = 0;             ///< area: points a light, 0 = 64
  std::optional<float> error;        ///< area: adaptive, until the standard error is below this
  bool skip_lit = true;              ///< area of a fixed count: no rays where a cone proves that
                                     ///< the whole light is seen
  Profile profile = Profile::cubic;  ///< parker
  Composite composite = Composite::min;  ///< parker
  float tolerance = 0.02f;  ///< parker: allowed change of the visible fraction, 0 = exact
  float mint = 0.01f;       ///< sdf_*: where the march begins, metres
  int steps = 256;          ///< sdf_*: at most
  std::optional<float> k;   ///< sdf_*: 1/w instead of the light's size
  SdfVariant variant = SdfVariant::published;  ///< sdf_classic, sdf_inner and hard
  std::uint32_t seed = 0;

  /// True for the methods that march a distance field from mint on.
  bool marches_field() const {
    return kind >= ShadowKind::sdf_classic || variant == SdfVariant::march;
  }
};

/// A point to be lit. `normal` bounds what can occlude: nothing on or below the plane through
/// `position`.
struct Receiver {
  Vec3 position;
  Vec3 normal;  ///< unit
};

/// The receiver of a surface: its smooth position and shading normal where it has vertex normals
/// (so that facets of a smooth surface draw no stripes at the terminator), the geometric ones else.
Receiver receiver_of(const Surface& surface);

/// One point of a light as seen from a receiver.
struct LightPoint {
  Vec3 direction;    ///< unit, receiver to light point
  float weight = 0;  ///< irradiance on a surface facing it, per unit radiance, of the whole light
                     ///< as this point stands for it: the mean over points of weight · cos θ ·
                     ///< radiance is the irradiance. (sun: radiance → irradiance; sphere, disk,
                     ///< rect, mesh, segment: solid angle the light would have)
  bool visible = false;
};

/// Seen by one receiver of one light.
struct Visibility {
  float fraction = 1;        ///< visible fraction in [0, 1]
  float standard_error = 0;  ///< estimated; 0 for methods without sampling
  int steps = 0;             ///< sdf_*: of the march
};

/// Counters, one set a thread; add them up.
struct ShadowCounts {
  std::uint64_t rays = 0;                ///< Embree shadow rays
  std::uint64_t cones = 0;               ///< clearance queries
  std::uint64_t cone_nodes = 0;          ///< nodes that these opened
  std::uint64_t cone_leaves = 0;         ///< leaves that these tested
  std::uint64_t marches = 0;             ///< through the distance field
  std::uint64_t march_steps = 0;         ///< of these
  std::uint64_t unfinished_marches = 0;  ///< that ran out of steps: the fraction is what they found
  std::uint64_t unfinished_rays = 0;     ///< that ran out of steps: they count as blocked
  ShadowCounts& operator+=(const ShadowCounts& b);
};

class AdaptiveArea;
struct CentreLight;

/// Immutable; every query is thread-safe. Keeps a reference to the world.
class Shadows {
 public:
  Shadows(const World& world, const ShadowOptions& options);
  ~Shadows();
  Shadows(const Shadows&) = delete;
  Shadows& operator=(const Shadows&) = delete;

  const ShadowOptions& options() const { return options_; }
  const World& world() const { return world_; }
  const LightViews& lights() const { return lights_; }
  /// True for the methods that march a distance field; the world must have one.
  bool marches_field() const { return options_.marches_field(); }
  /// True for area: radiance is summed over light_points() with the cosines inside; false: the
  /// unshadowed light is multiplied by the visible fraction.
  bool sums_light_points() const { return options_.kind == ShadowKind::area; }

  /// The visible fraction of scene light `light` from a receiver. `stream` decorrelates sampled
  /// methods: a number for the pixel and sample; the same number gives the same answer.
  Visibility visibility(const Receiver& receiver, std::size_t light, std::uint64_t stream,
                        ShadowCounts& counts) const;

  /// The same for many receivers, best in an order that keeps neighbours together: they share
  /// what they can, packets of rays or the walk of their cones, and parker's answers may differ
  /// from those of visibility() by the tolerance. Three spans of one size.
  void visibilities(std::span<const Receiver> receivers, std::size_t light,
                    std::span<const std::uint64_t> streams, std::span<Visibility> out,
                    ShadowCounts& counts) const;

  /// With an error limit: the search in two steps, for callers who know the neighbours; else null.
  const AdaptiveArea* adaptive() const { return adaptive_.get(); }

  /// The same for area, with the light's points left in `points` (cleared first); none where
  /// the whole light, or nothing of it, is known to be seen.
  Visibility light_points(const Receiver& receiver, std::size_t light, std::uint64_t stream,
                          std::vector<LightPoint>& points, ShadowCounts& counts) const;

 private:
  /// light_points(), which may be null.
  Visibility sampled(const Receiver& receiver, std::size_t light, std::uint64_t stream,
                     std::vector<LightPoint>* points, ShadowCounts& counts) const;
  float hard(const Receiver& receiver, const LightView& view, ShadowCounts& counts) const;
  float parker(const Receiver& receiver, const LightView& view, ShadowCounts& counts) const;
  float composite(const ConeQuery& query, ConeCounts& counts) const;
  ConeQuery cone_query(const Receiver& receiver, const LightView& view) const;
  void hard_packets(std::span<const Receiver> receivers, std::size_t light,
                    std::span<Visibility> out, ShadowCounts& counts) const;
  void trace_centre(std::span<const Receiver> receivers, const CentreLight& light,
                    std::span<Visibility> out, ShadowCounts& counts) const;
  void field_marches(std::span<const Receiver> receivers, std::size_t light,
                     std::span<Visibility> out, ShadowCounts& counts) const;
  CentreLight centre_light(const Light& source) const;
  void mesh_queries(std::span<const Receiver> receivers, std::size_t light, ConeBatch& queries,
                    std::vector<std::uint32_t>& which) const;
  void parker_group(std::span<const Receiver> receivers, std::size_t light,
                    std::span<Visibility> out, ShadowCounts& counts) const;

  const World& world_;
  ShadowOptions options_;
  LightViews lights_;
  LightSamples samples_;
  SearchLimit limit_;
  std::unique_ptr<AdaptiveArea> adaptive_;
};

}  // namespace penumbra
