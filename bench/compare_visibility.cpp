// How far POV-Ray's visible fractions and ours are from a reference, in the penumbra.
//   compare_visibility SCENE.json REFERENCE.exr OURS.exr POV_SHADOWED.exr POV_UNSHADOWED.exr
// The first two are visibility layers of the scene's first light; POV-Ray's are pictures of the
// scene that to_povray makes. Prints name and value, separated by a tab.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "base/error.h"
#include "geometry/world.h"
#include "image/exr.h"
#include "render/camera_rays.h"
#include "scene/load.h"

namespace penumbra::bench {
namespace {

// Below this cosine a half-precision ratio says little.
constexpr float least_cosine = 0.05f;
// A penumbra, not a rounding of 0 or 1.
constexpr float least_fraction = 0.002f;

Image read_layer(const std::string& file, const std::string& suffix) {
  ExrFile exr = read_exr(file);
  for (auto& [name, image] : exr.channels)
    if (suffix.empty() || name == suffix) return std::move(image);
  throw InputError({file}, "has no channel " + suffix, "check how it was made");
}

struct Pictures {
  Image reference, ours, shadowed, unshadowed;
};

Pictures read_pictures(char** files) {
  Pictures p{read_layer(files[0], ""), read_layer(files[1], ""), read_layer(files[2], "G"),
             read_layer(files[3], "G")};
  for (const Image* image : {&p.ours, &p.shadowed, &p.unshadowed})
    if (image->width != p.reference.width || image->height != p.reference.height)
      throw InputError("the pictures differ in size", "render them alike");
  return p;
}

/// Cosine of the light's centre at what each pixel sees; negative where that is nothing or dark.
Image cosines(const Scene& scene, int width, int height) {
  const World world(scene, {.cone_tree = false});
  const CameraRays camera(scene.cameras.front(), width, height);
  Image out(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Ray ray = camera.at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f).ray;
      const auto hit = world.intersect(ray);
      *out.at(x, y) = -1;
      if (!hit) continue;
      const Surface surface = world.surface(ray, *hit);
      const Vec3 to_light = normalize(scene.lights.front().position - surface.position);
      *out.at(x, y) = dot(to_light, surface.shading_normal);
    }
  return out;
}

struct Sums {
  std::size_t lit = 0;          ///< pixels with something that faces the light
  std::size_t same = 0;         ///< of them those where POV-Ray sees the same point
  std::size_t penumbra = 0;     ///< of them those in the penumbra
  std::size_t opposite = 0;     ///< POV-Ray off by more than a half
  double ours = 0, theirs = 0;  ///< squared errors in the penumbra

  void add(float cosine, float reference, float our, float shadowed, float unshadowed) {
    if (cosine < least_cosine) return;
    ++lit;
    // Another cosine is another surface: silhouettes fall on either side by rounding.
    if (std::abs(unshadowed - cosine) > 0.002f) return;
    ++same;
    const float their = shadowed / unshadowed;
    opposite += std::abs(their - reference) > 0.5f;
    if (reference < least_fraction || reference > 1 - least_fraction) return;
    ++penumbra;
    ours += static_cast<double>((our - reference) * (our - reference));
    theirs += static_cast<double>((their - reference) * (their - reference));
  }
};

void run(char** files) {
  const Scene scene = load_scene(files[0]);
  const Pictures p = read_pictures(files + 1);
  const Image cosine = cosines(scene, p.reference.width, p.reference.height);
  Sums sums;
  for (std::size_t i = 0; i < cosine.data.size(); ++i)
    sums.add(cosine.data[i], p.reference.data[i], p.ours.data[i], p.shadowed.data[i],
             p.unshadowed.data[i]);
  const auto share = [](std::size_t a, std::size_t b) {
    return b ? static_cast<double>(a) / static_cast<double>(b) : 0;
  };
  const double n = static_cast<double>(std::max<std::size_t>(sums.penumbra, 1));
  fmt::print("lit_pixels\t{}\nsame_point\t{:.6f}\nopposite\t{:.6f}\npenumbra_pixels\t{}\n",
             sums.lit, share(sums.same, sums.lit), share(sums.opposite, sums.same), sums.penumbra);
  fmt::print("our_rmse\t{:.5f}\npov_rmse\t{:.5f}\n", std::sqrt(sums.ours / n),
             std::sqrt(sums.theirs / n));
}

}  // namespace
}  // namespace penumbra::bench

int main(int argc, char** argv) {
  try {
    if (argc != 6) throw penumbra::InputError("a scene and four pictures are needed", "see above");
    penumbra::bench::run(argv + 1);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "compare_visibility: {}\n", e.what());
    return 2;
  }
}
