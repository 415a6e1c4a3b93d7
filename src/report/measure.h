// One method on one scene: how far it is from the reference and what it costs.
#pragma once

#include "compare/field_errors.h"
#include "report/drawer.h"
#include "report/reference.h"

namespace penumbra::report {

/// Of one picture of one sample a pixel, without layers: what has to be built for it, then its
/// tiles.
struct Seconds {
  double median = 0, least = 0, most = 0;
  int repeats = 0;
};

struct Cost {
  Seconds seconds;                           ///< build and render together
  double build = 0, render = 0;              ///< medians
  double picture = 0;                        ///< of the final picture, without the build
  std::uint64_t rays = 0;                    ///< shadow rays
  std::optional<std::uint64_t> evaluations;  ///< of the distance field, by shadows
  std::optional<std::uint64_t> texel_samples;
  std::optional<std::uint64_t> peak_bytes;  ///< beyond the scene and what the comparison holds
};

struct Errors {
  FieldErrors all;                  ///< of all lights together
  std::vector<FieldErrors> lights;  ///< by light
};

/// Visible fractions at the centres of pixels: by light, then pixel; NaN without a surface.
using Fractions = std::vector<Image>;

struct Measured {
  Fractions fractions;
  Errors errors;
  Cost cost;
  RenderResult picture;  ///< the final one
  std::string device = "cpu";
};

struct MeasureOptions {
  RenderOptions picture;  ///< its size is the reference's
  bool want_picture = true;
  int repeats = 3;  ///< timed pictures, after one to warm up
  /// No further repeat once those of a method have taken so long, seconds.
  double enough = 5;
};

/// Draws and compares. Throws Error where the method cannot show the scene.
Measured measure(const Scene& scene, const MakeDrawer& make, const Reference& reference,
                 const MeasureOptions& options);

/// The reference's own.
Fractions fractions_of(const Reference& reference);

Errors errors_of(const Fractions& fractions, const Reference& reference);

/// The median of values, of which there is at least one; of an even number the lower one of the two
/// in the middle.
double median(std::vector<double> values);

}  // namespace penumbra::report
