#include "render/gl/render_gl.h"

#include "base/error.h"
#include "render/gl/bytes.h"
#include "render/gl/picture.h"
#include "render/glsl/export.h"

namespace penumbra {
namespace {

void check_method(const ShadowOptions& shadows) {
  if (shadows.kind == ShadowKind::parker)
    throw InputError("--device gl: parker works on triangles and spheres, not in shaders",
                     "use --device cpu, or --shadows hard, area or sdf-improved");
  if (shadows.kind == ShadowKind::area && shadows.error)
    throw InputError("--device gl: --error needs points chosen as they are found",
                     "use --device cpu, or --light-samples");
}

std::string with_warning(const RenderOptions& options, std::uint64_t unfinished) {
  return std::to_string(unfinished) +
         " samples have a march or ray that ran out of steps (--steps " +
         std::to_string(options.shadows.steps) + ")";
}

}  // namespace

RenderResult render_gl(const Scene& scene, const RenderOptions& options, Entry entry,
                       Progress& progress, const gl::Patience& patience) {
  if (static_cast<std::size_t>(options.camera) >= scene.cameras.size())
    throw InputError("the scene has no such camera", "give it one");
  const FieldText field =
      field_text(scene, entry == Entry::map, sdf::mesh_distances(options.conversions));
  if (entry == Entry::main_image && !field.own_picture())
    throw InputError("the scene has no shader with mainImage", "leave out --entry");
  if (!field.own_picture()) check_method(options.shadows);
  const std::string bytes = gl::guarded(
      [&](Progress& told) {
        const gl::Context context;
        return to_bytes(field.own_picture() ? draw_own_picture(context, field, options, told)
                                            : draw_picture(context, scene, field, options, told));
      },
      progress, patience);
  RenderResult result = render_result_from(bytes);
  result.warnings.insert(result.warnings.begin(), field.warnings.begin(), field.warnings.end());
  if (result.stats.unfinished > 0)
    result.warnings.push_back(with_warning(options, result.stats.unfinished));
  return result;
}

ProbeAnswers probe_gl(const Scene& scene, const RenderOptions& options,
                      std::span<const ProbeQuery> queries, Progress& progress,
                      const gl::Patience& patience) {
  const FieldText field = field_text(scene, true, sdf::mesh_distances(options.conversions));
  check_method(options.shadows);
  ProbeAnswers answers = probe_answers_from(gl::guarded(
      [&](Progress& told) {
        const gl::Context context;
        return to_bytes(probe_field(context, scene, field, options, queries, told));
      },
      progress, patience));
  answers.warnings = field.warnings;
  return answers;
}

std::string export_shadertoy(const Scene& scene, const RenderOptions& options,
                             const std::string& source, Progress& progress,
                             std::vector<std::string>& warnings) {
  const FieldText field = field_text(scene, true);
  warnings.insert(warnings.end(), field.warnings.begin(), field.warnings.end());
  float exposure = options.exposure_ev.value_or(0.0f);
  Vec3 ambient = scene.ambient;
  if (!options.exposure_ev || scene.ambient_is_automatic) {
    RenderOptions small;
    small.width = small.height = small.spp = 1;
    small.camera = options.camera;
    small.time = options.time;
    small.exposure_ev = options.exposure_ev;
    small.shadows.kind = ShadowKind::none;
    const RenderStats stats = render_gl(scene, small, Entry::map, progress).stats;
    exposure = stats.exposure_ev;
    ambient = stats.ambient;
  }
  return shadertoy_text(scene, field, options, exposure, ambient, source);
}

}  // namespace penumbra
