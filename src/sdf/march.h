// Rays through a field: sphere tracing, and the published soft-shadow marches to the letter.
#pragma once

#include <cstdint>
#include <span>

#include "sdf/field.h"

namespace penumbra::sdf {

struct MarchRay {
  Vec3 origin;
  float t_min = 0;
  Vec3 direction;   ///< unit
  float t_max = 0;  ///< may be infinite in shadow marches of bounded length only
};

struct MarchHit {
  float t = 0;  ///< where f crosses 0, to a few units in the last place of the position
  std::uint16_t steps = 0;
  bool hit = false;
  bool out_of_steps = false;  ///< neither hit nor known to miss
};

struct TraceOptions {
  int steps = 1024;  ///< 1 … 65535
};

/// The first crossing in [t_min, t_max] of each ray. Sphere tracing with steps as long as two
/// spheres that touch (Bán and Valasek 2023, Automatic Step Size Relaxation in Sphere Tracing; the
/// fallback where they do not is Keinert et al. 2014, Enhanced Sphere Tracing), then false
/// position. A ray that starts inside is hit at t_min.
void trace(const Field& field, std::span<const MarchRay> rays, std::span<MarchHit> out,
           const TraceOptions& options = {});

/// The same without the place of the hit, faster: hit says whether anything is in [t_min, t_max].
void occluded(const Field& field, std::span<const MarchRay> rays, std::span<MarchHit> out,
              const TraceOptions& options = {});

/// How far every ray of a cone about the axis can go before it may meet the surface: a start for
/// `trace` that is safe for all of a tile's camera rays. slope: tangent of the half angle.
void clear_ways(const Field& field, std::span<const MarchRay> axes, float slope,
                std::span<float> out);

enum class ShadowMarch : std::uint8_t { classic, improved, inner, blog, inner_abs, hard };

struct ShadowRay {
  Vec3 origin;  ///< the shaded point
  float mint = 0.01f;
  Vec3 direction;  ///< unit, to the light's centre
  float maxt = 0;
  float w = 0;  ///< tangent of half the light's angle; k = 1 / w
};

struct ShadowResult {
  float visible_fraction = 1;
  std::uint16_t steps = 0;
  bool out_of_steps = false;  ///< the loop's limit ended it: the fraction is what was found so far
};

struct ShadowOptions {
  int steps = 256;     ///< 1 … 65535
  float hit = 0.001f;  ///< hard, classic, improved; the blog's is blog_hit
  float blog_hit = 0.0001f;
  float least_step = 0.005f, most_step = 0.5f;  ///< inner
};

/// The published loops (include/penumbra/sdf_shadow.h has them as plain code); every h is the
/// field's own value at the published place.
void shadow(const Field& field, ShadowMarch march, std::span<const ShadowRay> rays,
            std::span<ShadowResult> out, const ShadowOptions& options = {});

}  // namespace penumbra::sdf
