// Radiance textures and lightmaps of a scene (Heckbert and Herf 1997).
#pragma once

#include <functional>

#include "bake/glb.h"
#include "bake/light_chart.h"
#include "bake/passes.h"
#include "bake/plan.h"
#include "base/progress.h"
#include "render/direct_light.h"
#include "scene/gltf_materials.h"

namespace penumbra::bake {

/// What every bake looks up: all of one scene, which is of triangles (triangulate.h).
struct BakeInput {
  const Scene& scene;
  const Irradiance& irradiance;
  const DirectLight& lights;  ///< for what does not receive
  const MaterialLookup& materials;
  Vec3 ambient;           ///< radiance
  float exposure_ev = 0;  ///< of 8-bit textures: code = sRGB(radiance · 2^EV)
  /// light_in_passes() of this, instead of `irradiance`; null: all points at once.
  const BakedIrradiance* refined = nullptr;
  PassOptions passes = {};
  /// Lightmaps: the materials of the glTF file that the scene was read from, kept as they are;
  /// null: written from the scene's.
  const GltfMaterials* source = nullptr;
  /// Asked when the work is cancelled. True: what there is shall be finished, and cancel_requested
  /// is false again; charts that are not lit are lit by light_in_passes() of `hasty` for a second,
  /// or as long as the first pass takes. Null: never.
  std::function<bool()> finish_early = {};
  const BakedIrradiance* hasty = nullptr;  ///< with finish_early
};

enum class Output : std::uint8_t { radiance, lightmap };

struct BakeStats {
  std::size_t charts = 0, vertex_charts = 0, pages = 0;
  std::uint64_t texels = 0;        ///< lit
  std::uint64_t saved_texels = 0;  ///< of charts that became vertex colours
  double light_points = 0;         ///< a light, on average; of charts lit in passes
  std::size_t hasty_charts = 0;    ///< lit by `hasty`
};

/// Called with each page of linear texels as it is finished.
using PageSink = std::function<void(int page, std::size_t pages, const Image& image)>;

struct Baked {
  GlbModel model;
  Json::Value description;  ///< lightmap: which image, channel and unit belongs to which mesh
  BakeStats stats;
};

/// Lights the plan's charts and puts together the file.
///
/// radiance: unlit surfaces with the texels of light_chart() in TEXCOORD_0, or vertex colours where
/// those are within one 8-bit step of the texels; what does not receive is lit at its vertices,
/// without shadows (section 3.5). lightmap: the scene's materials with irradiance in TEXCOORD_1
/// (MOZ_lightmap).
///
/// The result depends on its arguments alone, not on threads; but for a deadline.
Baked bake(const BakeInput& input, const Plan& plan, const TextureOptions& options, Output output,
           const PageSink& sink, Progress& progress);

}  // namespace penumbra::bake
