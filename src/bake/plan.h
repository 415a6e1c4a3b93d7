// What a bake will do, known before its work begins.
#pragma once

#include <memory>
#include <optional>

#include "bake/chart_blocks.h"

namespace penumbra::bake {

/// What a person may choose of textures.
struct TextureOptions {
  std::optional<float> texel_size;     ///< metres; none: so that all receivers take 2²² texels
  bool existing_uv = false;            ///< charts lie where the meshes' texture coordinates say
  bool power_of_two = false;           ///< sides of atlas pages
  int supersample = 1;                 ///< points along each side of a texel, 1 to 8
  std::vector<std::string> receivers;  ///< objects by name; empty: those that say so
  bool in_passes = false;              ///< sums stay in memory between passes
  std::uint64_t most_bytes = 0;        ///< of memory for texels; 0: no limit
};

struct Plan {
  float texel_size = 0;
  std::vector<std::unique_ptr<WorldMesh>> meshes;  ///< by instance
  std::vector<bool> receives;                      ///< by instance
  std::vector<bool> backs;                         ///< by instance: its back is seen
  std::vector<CutChart> charts;
  std::optional<PlacedCharts> placed;  ///< of all charts; none: to be packed
  ChartRemarks remarks;

  std::uint64_t texel_count() const;
};

/// Cuts all receivers into charts. Throws InputError where nothing receives, or, telling the texel
/// size that would do, where texels need more than most_bytes or, of a texel_size that is given,
/// where a chart has more of them along a side than a page. Keeps a reference to the scene.
Plan make_plan(const Scene& scene, const TextureOptions& options);

}  // namespace penumbra::bake
