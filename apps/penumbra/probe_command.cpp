#include <algorithm>
#include <mutex>

#include "baked_light.h"
#include "base/atomic_file.h"
#include "base/parallel.h"
#include "commands.h"
#include "device.h"
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
  std::string device;  // OpenGL's; empty = this processor
  std::size_t structure_bytes = 0;
  double build_seconds = 0;
};

Probed probe(const Shadows& shadows, const std::vector<ProbePoint>& points, Console& console) {
  Probed result;
  result.fractions.resize(points.size());
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

Probed probe_on_cpu(const Scene& scene, const Arguments& arguments,
                    const std::vector<ProbePoint>& points, Console& console) {
  const Stopwatch build;
  const std::unique_ptr<World> world = build_world(scene, arguments, console);
  const double build_seconds = build.seconds();
  for (const std::string& text : world->warnings()) console.warn(text);
  Probed result;
  if (arguments.render.shadows.kind == ShadowKind::heckbert_herf)
    result.fractions = baked_fractions(*world, arguments, points, console);
  else
    result = probe(Shadows(*world, arguments.render.shadows), points, console);
  warn_of_unfinished(result.counts, console);
  result.build_seconds = build_seconds;
  result.structure_bytes = world->memory_bytes();
  return result;
}

Probed probe_on_gl(const Scene& scene, Arguments& arguments, const std::vector<ProbePoint>& points,
                   Console& console) {
  adapt_to_gl(arguments, scene, console);
  std::vector<ProbeQuery> queries;
  queries.reserve(points.size());
  for (const ProbePoint& point : points) queries.push_back({point.receiver, point.light});
  ProbeAnswers answers = probe_gl(scene, arguments.render, queries, console);
  for (const std::string& text : answers.warnings) console.warn(text);
  if (answers.unfinished > 0)
    console.warn(std::to_string(answers.unfinished) + " points have a march that ran out of steps");
  Probed result;
  result.fractions = std::move(answers.fractions);
  result.device = answers.device;
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

void run_probe(Arguments& arguments, Console& console) {
  check_outputs(arguments);
  warn_of_idle_options(arguments, console);
  CsvTable table = parse_csv(read_file(arguments.points), arguments.points);
  const Stopwatch load;
  const Scene scene = prepare_scene(arguments, console);
  const double load_seconds = load.seconds();
  const std::vector<ProbePoint> points = points_of(table, arguments.points, scene.lights.size());
  const Stopwatch work;
  const Probed probed = draws_with_gl(arguments, scene)
                            ? probe_on_gl(scene, arguments, points, console)
                            : probe_on_cpu(scene, arguments, points, console);
  const double probe_seconds = work.seconds() - probed.build_seconds;
  set_visible_fractions(table, probed.fractions);
  write_table(arguments, table);
  if (arguments.stats.empty()) return;
  Json::Value stats = common_stats(arguments, scene, probed.structure_bytes);
  stats["seconds"]["load"] = load_seconds;
  stats["seconds"]["build"] = probed.build_seconds;
  stats["seconds"]["probe"] = probe_seconds;
  stats["points"] = static_cast<Json::UInt64>(points.size());
  if (!probed.device.empty()) stats["device"] = probed.device;
  add_shadow_counts(stats, probed.counts);
  write_stats(arguments.stats, stats);
}

}  // namespace penumbra::app
