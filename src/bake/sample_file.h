// The bits of `--store samples` with the light points that they belong to, as bytes
// (docs/baking.md, "What a file of samples holds").
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bake/chart_blocks.h"
#include "bake/light_sampler.h"
#include "bake/visible_samples.h"

namespace penumbra::bake {

/// Collects charts; point lists that are alike are written once.
class SampleWriter {
 public:
  explicit SampleWriter(std::size_t lights) : lights_(lights) {}
  void add(const ChartPlace& place, int width, int height, const ChartSight& sight);
  /// All that was added.
  std::string bytes() const;

 private:
  std::size_t lights_;
  std::string lists_, charts_, bits_;
  std::uint32_t list_count_ = 0, chart_count_ = 0;
  std::map<std::string, std::uint32_t> known_;
};

/// A chart's texels: where they lie in a page (ChartPlace), and its lights' points and bits.
struct SampledChart {
  ChartPlace place;
  int width = 0, height = 0;
  std::vector<std::uint32_t> lists;       ///< by light, into SampleFile::lists
  std::vector<const std::uint8_t*> bits;  ///< by light; as SampleBits::bytes()
};

struct SampleFile {
  std::vector<SampledLight> lists;  ///< kind, measure, two_sided and samples alone
  std::vector<SampledChart> charts;
};

/// Keeps pointers into `bytes`. Throws std::runtime_error, saying what is wrong, for bytes that are
/// cut short, changed or of another version, or of another number of lights or pages.
SampleFile parse_samples(std::string_view bytes, std::size_t lights, std::size_t pages);

}  // namespace penumbra::bake
