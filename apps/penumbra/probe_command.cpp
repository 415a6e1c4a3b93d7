#include <algorithm>
#include <mutex>

#include "base/atomic_file.h"
#include "base/parallel.h"
#include "commands.h"
#include "outputs.h"
#include "prepare.h"
#include "probe_points.h"
#include "stats.h"

namespace penumbra::app {
namespace {

constexpr std::size_t kPiece = 64;  // points between two looks at the clock

struct Probed {
  std::vector<float> fractions;
  ShadowCounts counts;
};

Probed probe(const Shadows& shadows, const std::vector<ProbePoint>& points, Console& console) {
  Probed result{std::vector<float>(points.size()), {}};
  std::mutex adding;
  console.start("probe", points.size());
  parallel_for((points.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
    ShadowCounts counts;
    const std::size_t begin = piece * kPiece, end = std::min(begin + kPiece, points.size());
    for (std::size_t i = begin; i < end; ++i)
      result.fractions[i] =
          shadows.visibility(points[i].receiver, points[i].light, i, counts).fraction;
    console.advance(end - begin);
    const std::lock_guard lock(adding);
    result.counts += counts;
  });
  console.finish();
  return result;
}

void write_table(const Arguments& arguments, const CsvTable& table) {
  const std::string text = to_text(table);
  if (arguments.output.empty())
    print(text);
  else
    write_file(arguments.output, text);
}

}  // namespace

void run_probe(const Arguments& arguments, Console& console) {
  check_outputs(arguments);
  warn_of_idle_options(arguments, console);
  CsvTable table = parse_csv(read_file(arguments.points), arguments.points);
  const Stopwatch load;
  const Scene scene = prepare_scene(arguments, console);
  const double load_seconds = load.seconds();
  const std::vector<ProbePoint> points = points_of(table, arguments.points, scene.lights.size());
  const Stopwatch build;
  const std::unique_ptr<World> world = build_world(scene, arguments, console);
  const double build_seconds = build.seconds();
  const Stopwatch work;
  const Probed probed = probe(Shadows(*world, arguments.render.shadows), points, console);
  const double probe_seconds = work.seconds();
  set_visible_fractions(table, probed.fractions);
  write_table(arguments, table);
  if (arguments.stats.empty()) return;
  Json::Value stats = common_stats(arguments, scene, *world);
  stats["seconds"]["load"] = load_seconds;
  stats["seconds"]["build"] = build_seconds;
  stats["seconds"]["probe"] = probe_seconds;
  stats["points"] = static_cast<Json::UInt64>(points.size());
  add_shadow_counts(stats, probed.counts);
  write_stats(arguments.stats, stats);
}

}  // namespace penumbra::app
