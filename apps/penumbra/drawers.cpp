#include "drawers.h"

#include <fmt/format.h>

#include "baked_light.h"
#include "device.h"
#include "light_spec.h"
#include "prepare.h"

namespace penumbra::app {
namespace {

constexpr float kPictureError = 0.004f;

class WorldDrawer final : public report::Drawer {
 public:
  WorldDrawer(const Scene& scene, const Arguments& arguments, Console& silent)
      : world_(build_world(scene, arguments, silent)) {}
  RenderResult draw(const RenderOptions& options, Progress& progress) const override {
    return render(*world_, options, progress);
  }

 private:
  std::unique_ptr<World> world_;
};

class BakedDrawer final : public report::Drawer {
 public:
  BakedDrawer(const Scene& scene, const Arguments& arguments, Console& silent)
      : baked_(scene, arguments, silent) {}
  RenderResult draw(const RenderOptions& options, Progress& progress) const override {
    RenderOptions own = options;
    own.known = &baked_.light();
    return render(baked_.world(), own, progress);
  }
  std::optional<std::uint64_t> texel_samples() const override { return baked_.texel_samples(); }

 private:
  BakedLight baked_;
};

class GlDrawer final : public report::Drawer {
 public:
  GlDrawer(const Scene& scene, const Arguments& arguments)
      : scene_(scene), conversions_(arguments.conversion) {}
  RenderResult draw(const RenderOptions& options, Progress& progress) const override {
    RenderOptions own = options;
    own.conversions = conversions_;
    return render_gl(scene_, own, Entry::automatic, progress);
  }

 private:
  const Scene& scene_;
  sdf::ConversionOptions conversions_;
};

}  // namespace

report::MakeDrawer drawers_for(const Arguments& arguments) {
  auto silent = std::make_shared<Console>(true);
  return [arguments, silent](const Scene& scene,
                             const RenderOptions& options) -> std::unique_ptr<report::Drawer> {
    Arguments own = arguments;
    own.render = options;
    if (draws_with_gl(own, scene)) return std::make_unique<GlDrawer>(scene, own);
    if (options.shadows.kind == ShadowKind::heckbert_herf)
      return std::make_unique<BakedDrawer>(scene, own, *silent);
    return std::make_unique<WorldDrawer>(scene, own, *silent);
  };
}

std::vector<std::string> conversions_for(const Scene& scene, const Arguments& arguments,
                                         ShadowKind kind) {
  Scene parts;  // what is converted
  const bool marches = options_for(kind, arguments).shadows.marches_field();
  const bool by_triangles = kind == ShadowKind::parker || kind == ShadowKind::heckbert_herf;
  if (marches || arguments.device == Device::gl)
    parts.meshes = scene.meshes, parts.instances = scene.instances, parts.objects = scene.objects;
  else if (by_triangles)
    parts.sdfs = scene.sdfs, parts.objects = scene.objects;
  std::vector<std::string> lines = sdf::describe_conversions(parts, arguments.conversion);
  if (kind == ShadowKind::heckbert_herf && !scene.spheres.empty())
    lines.push_back(fmt::format("{} sphere{} became triangles", scene.spheres.size(),
                                scene.spheres.size() == 1 ? "" : "s"));
  return lines;
}

RenderOptions options_for(ShadowKind kind, const Arguments& arguments) {
  RenderOptions options = arguments.render;
  ShadowOptions& shadows = options.shadows;
  shadows.kind = kind;
  const bool belongs = (shadows.variant == SdfVariant::blog && kind == ShadowKind::sdf_classic) ||
                       (shadows.variant == SdfVariant::abs && kind == ShadowKind::sdf_inner) ||
                       (shadows.variant == SdfVariant::march && kind == ShadowKind::hard);
  if (!belongs) shadows.variant = SdfVariant::published;
  return options;
}

std::unique_ptr<World> reference_world(const Scene& scene) {
  return std::make_unique<World>(scene, WorldOptions{.cone_tree = scene.sdfs.empty()});
}

RenderOptions reference_picture(const Arguments& arguments) {
  RenderOptions options = arguments.render;
  options.shadows = {};
  options.shadows.kind = ShadowKind::area;
  options.shadows.error = kPictureError;
  options.shadows.seed = arguments.render.seed;
  options.exposure_ev.reset();
  return options;
}

report::ChangeLights change_lights(const Scene& scene) {
  return [&scene](report::SweepParameter parameter, double value) {
    Scene changed = scene;
    const auto factor = static_cast<float>(value);
    if (parameter == report::SweepParameter::light_size) scale_lights(changed, factor);
    if (parameter == report::SweepParameter::distance)
      report::move_lights(changed, bounds_of(scene).center(), factor);
    return changed;
  };
}

}  // namespace penumbra::app
