#include "auto_method.h"

#include <algorithm>

#include "base/error.h"
#include "drawers.h"
#include "prepare.h"
#include "report/comparison.h"

namespace penumbra::app {
namespace {

constexpr int kWidth = 160;

std::vector<ShadowKind> kinds_for(const Scene& scene) {
  std::vector<ShadowKind> kinds{ShadowKind::hard, ShadowKind::parker, ShadowKind::area};
  if (!scene.sdfs.empty())
    kinds.insert(kinds.end(),
                 {ShadowKind::sdf_classic, ShadowKind::sdf_improved, ShadowKind::sdf_inner});
  return kinds;
}

struct Truth {
  std::unique_ptr<World> world;
  report::Reference reference;
};

Truth small_truth(const Scene& scene, const RenderOptions& options) {
  report::ReferenceOptions asked{options.width, options.height, options.camera};
  asked.seed = options.seed;
  Truth truth{reference_world(scene), report::empty_reference(asked, scene.lights.size())};
  Progress silent;
  complete_reference(
      *truth.world, asked, truth.reference, [](const report::Reference&) {}, silent);
  return truth;
}

Json::Value described(const std::vector<report::Candidate>& candidates,
                      const report::Advice& advice, double limit) {
  Json::Value json;
  json["method"] = advice.method;
  json["text"] = advice.text;
  json["error_limit"] = limit;
  for (const report::Candidate& c : candidates) {
    Json::Value one;
    one["method"] = c.name;
    one["penumbra_rmse"] = c.error;
    one["estimated_seconds"] = c.seconds;
    json["candidates"].append(one);
  }
  return json;
}

}  // namespace

Json::Value choose_method(Arguments& a, const Scene& scene, Console& console) {
  if (scene.glsl)
    throw InputError({scene.glsl->path},
                     "--shadows auto: the truth of a shader's scene cannot be measured",
                     "name a method");
  if (scene.lights.empty())
    throw InputError("--shadows auto: the scene has no light", "add one with --light");
  console.start("choose a method", 0);
  const float limit = a.render.shadows.error.value_or(static_cast<float>(report::default_limit));
  RenderOptions small = a.render;
  small.shadows.error = limit;  // of area
  report::shrink(small, kWidth);
  const Truth truth = small_truth(scene, small);
  const report::MakeDrawer make = drawers_for(a);
  const double pixels = static_cast<double>(a.render.width) * a.render.height * a.render.spp;
  const double growth = pixels / (static_cast<double>(small.width) * small.height);
  std::vector<report::Candidate> candidates;
  bool has_penumbra = false;
  for (const ShadowKind kind : kinds_for(scene)) {
    report::MeasureOptions asked;
    asked.picture = small;
    asked.picture.shadows.kind = kind;
    asked.picture.shadows.variant = SdfVariant::published;
    asked.want_picture = false;
    asked.repeats = 1;
    try {
      const report::Measured found = measure(scene, make, truth.reference, asked);
      candidates.push_back({std::string(report::method_of(kind).name),
                            found.errors.all.penumbra_rmse,
                            found.cost.build + growth * found.cost.render,
                            {}});
      has_penumbra = has_penumbra || found.errors.all.penumbra_points > 0;
    } catch (const Error&) {
      // A method that cannot show the scene is none to choose.
    }
  }
  const report::Advice advice = report::advise(candidates, limit, has_penumbra);
  console.finish();
  console.remark(advice.text + " (measured on a small picture)");
  for (const report::MethodText& method : report::methods())
    if (method.name == advice.method) a.render.shadows.kind = method.kind;
  a.render.shadows.variant = SdfVariant::published;
  if (a.render.shadows.kind == ShadowKind::area) a.render.shadows.error = limit;
  return described(candidates, advice, limit);
}

}  // namespace penumbra::app
