// Error and time while one thing changes.
#pragma once

#include <string>
#include <vector>

#include "report/measure.h"

namespace penumbra::report {

enum class SweepParameter : std::uint8_t {
  light_size,  ///< factor on the lights' size
  distance,    ///< factor on the lights' distance from the scene's centre
  samples,     ///< points of each light, for the methods that take them
};

struct SweepRequest {
  SweepParameter parameter = SweepParameter::light_size;
  std::vector<double> values;
};

/// Numbers by value; NaN where the method could not run.
struct SweepMethod {
  std::string name;
  std::vector<double> rmse, penumbra_rmse, seconds;
};

struct Sweep {
  SweepParameter parameter = SweepParameter::light_size;
  std::vector<double> values;
  std::vector<SweepMethod> methods;
};

/// "light-size", "distance" or "samples".
const char* to_string(SweepParameter parameter);

/// `count` values from `first` to `last`, evenly spaced by their logarithms. Both are positive.
std::vector<double> log_spaced(double first, double last, int count);

/// The scene with its lights changed; may throw InputError. Not asked for samples.
using ChangeLights = std::function<Scene(SweepParameter, double)>;

/// Moves lights away from a point or towards it, by a factor on their distance. Suns and mesh
/// lights stay. Emission stays too.
void move_lights(Scene& scene, const Vec3& centre, float factor);

/// Measures each method at each value, on pictures of at most `width` pixels across in the shape of
/// the options' size. Options by method, with the method in their shadows.
struct SweepMethodCall {
  std::string name;
  RenderOptions options;
};
Sweep sweep(const Scene& scene, const ChangeLights& change, const SweepRequest& request,
            const std::vector<SweepMethodCall>& methods, const MakeDrawer& make, int repeats,
            Progress& progress);

/// A size of the same shape with at most `width` pixels across, at least 1 × 1.
void shrink(RenderOptions& options, int width);

inline constexpr int sweep_width = 192;

}  // namespace penumbra::report
