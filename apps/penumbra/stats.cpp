#include "stats.h"

#include <fmt/format.h>
#include <json/writer.h>

#include "base/atomic_file.h"
#include "base/parallel.h"
#include "memory.h"

namespace penumbra::app {
namespace {

Json::Value count(std::uint64_t n) { return Json::Value(static_cast<Json::UInt64>(n)); }

Json::Value scene_stats(const Arguments& arguments, const Scene& scene) {
  std::uint64_t stored = 0, placed = 0;
  for (const Mesh& mesh : scene.meshes) stored += mesh.triangle_count();
  for (const Instance& instance : scene.instances)
    placed += scene.meshes[instance.mesh].triangle_count();
  Json::Value json;
  json["file"] = arguments.scene;
  json["format"] = scene.report.format;
  json["triangles_stored"] = count(stored);
  json["triangles_placed"] = count(placed);
  json["dropped_triangles"] = count(scene.report.dropped_triangles);
  json["meshes"] = count(scene.meshes.size());
  json["instances"] = count(scene.instances.size());
  json["spheres"] = count(scene.spheres.size());
  json["objects"] = count(scene.objects.size());
  json["lights"] = count(scene.lights.size());
  json["cameras"] = count(scene.cameras.size());
  json["textures"] = count(scene.textures.size());
  return json;
}

}  // namespace

Json::Value common_stats(const Arguments& arguments, const Scene& scene,
                         std::size_t structure_bytes) {
  Json::Value json;
  json["program"] = "penumbra " PENUMBRA_VERSION;
  for (const std::string& word : arguments.command_line) json["command_line"].append(word);
  json["threads"] = thread_count();
  json["scene"] = scene_stats(arguments, scene);
  json["memory"]["structure_bytes"] = count(structure_bytes);
  return json;
}

void add_shadow_counts(Json::Value& stats, const ShadowCounts& counts) {
  stats["rays"]["shadow"] = count(counts.rays);
  stats["cones"]["queries"] = count(counts.cones);
  stats["cones"]["nodes"] = count(counts.cone_nodes);
  stats["cones"]["leaves"] = count(counts.cone_leaves);
  stats["marches"]["queries"] = count(counts.marches);
  stats["marches"]["steps"] = count(counts.march_steps);
  stats["rays"]["shadow_unfinished"] = count(counts.unfinished_rays);
  stats["marches"]["unfinished"] = count(counts.unfinished_marches);
}

void warn_of_unfinished(const ShadowCounts& counts, Console& console) {
  if (counts.unfinished_marches > 0)
    console.warn(fmt::format("{} of {} marches ran out of steps; --steps gives them more",
                             counts.unfinished_marches, counts.marches));
  if (counts.unfinished_rays > 0)
    console.warn(
        fmt::format("{} of {} shadow rays ran out of steps in a distance field and count as "
                    "blocked: some operator makes it very steep",
                    counts.unfinished_rays, counts.rays));
}

void write_stats(const std::string& file, Json::Value stats) {
  stats["memory"]["peak_bytes"] = count(peak_memory());
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "  ";
  builder["precision"] = 9;
  write_file(file, Json::writeString(builder, stats) + '\n');
}

}  // namespace penumbra::app
