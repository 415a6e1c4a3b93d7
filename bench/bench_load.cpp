// Where the time of loading a text model goes, and what its structures hold.
//   bench_load [--repeats N] [--threads N] MODEL.ply
// Prints name and value, separated by a tab: medians in seconds, bytes a triangle.
#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cstring>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "geometry/cone_tree.h"
#include "geometry/embree_scene.h"
#include "race.h"
#include "scene/load.h"

namespace penumbra::bench {
namespace {

/// Reads the file's bytes and sums them up, so that all of them are looked at.
double read_bytes(const std::string& file) {
  std::uint64_t sum = 0;
  for (const char c : read_file(file)) sum += static_cast<unsigned char>(c);
  return static_cast<double>(sum);
}

/// Converts every word of the text that is a number, on one thread, and keeps nothing.
double read_numbers(const std::string& file) {
  const std::string text = read_file(file);
  const char *at = text.data(), *end = at + text.size();
  double sum = 0;
  while (at < end) {
    while (at < end && *at <= ' ') ++at;
    float value = 0;
    const auto [stop, error] = fast_float::from_chars(at, end, value);
    if (error == std::errc()) sum += static_cast<double>(value);
    at = stop;
    while (at<end&& * at> ' ') ++at;
  }
  return sum;
}

std::size_t triangles(const Scene& scene) {
  std::size_t count = 0;
  for (const Mesh& mesh : scene.meshes) count += mesh.triangle_count();
  return count;
}

std::size_t mesh_bytes(const Scene& scene) {
  std::size_t bytes = 0;
  for (const Mesh& mesh : scene.meshes)
    bytes += (mesh.positions.size() + mesh.normals.size()) * sizeof(Vec3) +
             (mesh.uv[0].size() + mesh.uv[1].size()) * sizeof(Vec2) +
             mesh.indices.size() * sizeof(std::uint32_t);
  return bytes;
}

void print(const std::string& name, double value) { fmt::print("{}\t{:.4g}\n", name, value); }

void print_times(const std::string& file, int repeats) {
  Race race;
  double sink = 0;
  race.add("read_bytes", [&] { sink += read_bytes(file); });
  race.add("read_numbers", [&] { sink += read_numbers(file); });
  race.add("load", [&] { sink += static_cast<double>(load_scene(file).meshes.size()); });
  race.run(repeats);
  for (const std::size_t i : {0, 1, 2}) print(race.name(i), race.time(i));
  print("load/read_bytes", race.ratio(2, 0));
  print("load/read_numbers", race.ratio(2, 1));
  if (sink == 0) throw WorkError("nothing was read", "give a text model");
}

void print_structures(const std::string& file, int repeats) {
  const Scene scene = load_scene(file);
  const EmbreeScene embree(scene);
  const ConeTree tree(scene);
  const double n = static_cast<double>(triangles(scene));
  fmt::print("triangles\t{}\n", triangles(scene));
  print("cone_tree_bytes", static_cast<double>(tree.memory_bytes()) / n);
  print("embree_bytes", static_cast<double>(embree.memory_bytes()) / n);
  print("mesh_bytes", static_cast<double>(mesh_bytes(scene)) / n);
  Race race;
  const auto build_embree = race.add("build_embree", [&] { const EmbreeScene again(scene); });
  const auto build_tree = race.add("build_cone_tree", [&] { const ConeTree again(scene); });
  race.run(repeats);
  for (const std::size_t i : {build_embree, build_tree}) print(race.name(i), race.time(i));
}

void run(int argc, char** argv) {
  int repeats = 5, threads = 0;
  std::string file;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--repeats") && i + 1 < argc)
      repeats = std::stoi(argv[++i]);
    else if (!std::strcmp(argv[i], "--threads") && i + 1 < argc)
      threads = std::stoi(argv[++i]);
    else
      file = argv[i];
  }
  if (file.empty()) throw InputError("no model is given", "name a PLY file");
  const ThreadLimit limit(threads);
  print_times(file, repeats);
  print_structures(file, repeats);
}

}  // namespace
}  // namespace penumbra::bench

int main(int argc, char** argv) {
  try {
    penumbra::bench::run(argc, argv);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_load: {}\n", e.what());
    return 2;
  }
}
