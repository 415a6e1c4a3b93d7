// Lights as a few points each: what equation (1) of Heckbert and Herf (1997) sums over.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bake/bake_options.h"
#include "base/vec.h"
#include "shadow/light_view.h"

namespace penumbra::bake {

/// A point of a light and the part of the light that it stands for.
struct LightSample {
  Vec3 position;     ///< world, metres; of a sun the unit direction towards it
  Vec3 normal;       ///< unit, on the side that emits; of a segment along it
  float weight = 1;  ///< see LightPoints::kind
};

enum class EmitterKind : std::uint8_t {
  surface,   ///< weight: area, m²
  strip,     ///< a segment; weight: area of the strip 2 r Δl, m²
  point,     ///< weight: 1
  direction  ///< a sun; weight: irradiance on a facing surface per unit emission
};

/// By what the visible fraction of a light is measured (docs: rules of light).
enum class FractionMeasure : std::uint8_t {
  count,       ///< each sample alike: area of disk and rect, length, solid angle of a sun
  turned,      ///< those whose face is turned to the receiver alike: area of a mesh
  solid_angle  ///< by weight · max(0, cos θ′) / r²: a sphere
};

/// One light's points for one receiver.
struct SampledLight {
  EmitterKind kind = EmitterKind::surface;
  FractionMeasure measure = FractionMeasure::count;
  bool two_sided = false;  ///< a surface that emits to both sides
  bool flat = false;       ///< all points in one plane: what lies on it does not occlude
  int own_instance = -1;   ///< a mesh light's, which does not occlude it
  Vec3 emission;           ///< radiance; intensity of a point; irradiance of a sun
  Vec3 position;           ///< the light's centre; not of a sun
  float radius = 0;        ///< of a sphere, 0 of others
  bool is_spot = false;
  Vec3 spot_axis;  ///< along which it shines
  float spot_cos_inner = -1, spot_cos_outer = -1;
  std::vector<LightSample> samples;  ///< neighbours in the list are neighbours on the light

  /// True if the samples only say which part of whole_irradiance_of() arrives.
  bool is_ratio() const { return radius > 0; }
  /// What the cone of a spot lets through towards p, in [0, 1]; 1 for other lights.
  float spot_part(const Vec3& p) const;
};

/// What is known of a receiver before it is lit: corners of the parallelogram round it (of a point
/// four times the same), and its normal.
struct ReceiverPatch {
  std::array<Vec3, 4> corners;
  Vec3 normal;
  float samples_scale = 1;
  std::uint32_t set = 0;  ///< samples of different sets are jittered independently
};

/// Places the samples. All texels of a receiver share them: they are points of the light in the
/// world. Immutable; thread-safe. Keeps references to the lights and options.
class LightSampler {
 public:
  LightSampler(const LightViews& lights, const BakeOptions& options)
      : lights_(lights), options_(options) {}

  /// No samples where the light is wholly behind the receiver or the receiver wholly behind the
  /// light (section 3.6), unless `all` is true: visible fractions are defined everywhere.
  SampledLight sample(std::size_t light, const ReceiverPatch& receiver, bool all = false) const;
  /// The number of samples: fixed, or so many that each stands for less than the solid angle of the
  /// options as seen from the nearest point of the receiver (section 3.7); extended lights take
  /// 16 to 4096.
  int count(std::size_t light, const ReceiverPatch& receiver) const;

 private:
  float solid_angle(std::size_t light, const ReceiverPatch& receiver) const;
  void add_sphere(const Light& light, const ReceiverPatch& receiver, const std::vector<Vec2>& grid,
                  SampledLight& out) const;
  void add_mesh(std::size_t light, const ReceiverPatch& receiver, int count,
                SampledLight& out) const;
  std::vector<Vec2> grid(std::size_t light, std::uint32_t set, int count, float aspect) const;

  const LightViews& lights_;
  const BakeOptions& options_;
};

/// Irradiance at p, on a surface with unit normal n, per unit emission, by a sample that nothing
/// hides: weight · cos θ cos θ′ / (r² + weight / π), where the paper has r² alone. A sample is the
/// disk of its area seen by a point (Wallace, Elmquist and Haines 1989, A Ray Tracing Algorithm for
/// Progressive Radiosity, equation 7), so that light stays finite where a receiver touches a light.
/// Without spot_part().
float irradiance_of(const SampledLight& light, const LightSample& sample, const Vec3& p,
                    const Vec3& n);
/// Of a sphere all that arrives if nothing hides it, in closed form: a few points spread over its
/// curved face say well which part of it is seen, but less well how much it gives.
float whole_irradiance_of(const SampledLight& light, const Vec3& p, const Vec3& n);
/// The sample's share of the light as the measure has it, not normalised.
float share_of(const SampledLight& light, const LightSample& sample, const Vec3& p);

}  // namespace penumbra::bake
