#include "render/gl/probe.h"

#include <algorithm>

#include "base/cancel.h"
#include "render/gl/draws.h"
#include "render/gl/field_program.h"
#include "render/gl/point_patterns.h"

namespace penumbra {
namespace {

constexpr int kRow = 256;                 // queries in a row of a draw
constexpr std::size_t kMost = 64 * kRow;  // in a draw

class Prober {
 public:
  Prober(const gl::Context& context, const Scene& scene, const FieldText& field,
         const RenderOptions& options, std::span<const ProbeQuery> queries)
      : context_(context),
        scene_(scene),
        field_(field),
        options_(options),
        queries_(queries),
        lights_(shader_lights(scene)),
        textures_(field, lights_, context.longest_side()) {}

  ProbeAnswers answer(Progress& progress);

 private:
  void upload(std::span<const std::size_t> some);
  void draw(gl::Program& program, std::size_t light, std::span<const std::size_t> some,
            ProbeAnswers& answers);

  const gl::Context& context_;
  const Scene& scene_;
  const FieldText& field_;
  const RenderOptions& options_;
  std::span<const ProbeQuery> queries_;
  ShaderLights lights_;
  SceneTextures textures_;
  gl::Texture positions_{kRow, kMost / kRow}, normals_{kRow, kMost / kRow};
  gl::Target target_{kRow, kMost / kRow, 1};
  std::unique_ptr<PointPatterns> patterns_;
  int rows_ = 0;
  std::vector<std::uint64_t> streams_;
};

void Prober::upload(std::span<const std::size_t> some) {
  rows_ = static_cast<int>((some.size() + kRow - 1) / kRow);
  std::vector<float> positions, normals;
  streams_.clear();
  for (std::size_t i = 0; i < static_cast<std::size_t>(rows_) * kRow; ++i) {
    const std::size_t query = some[std::min(i, some.size() - 1)];  // the last row is filled up
    const auto& [p, n] = queries_[query].receiver;
    positions.insert(positions.end(), {p.x, p.y, p.z, 0});
    normals.insert(normals.end(), {n.x, n.y, n.z, 0});
    streams_.push_back(query);
  }
  positions_.write(kRow, rows_, positions);
  normals_.write(kRow, rows_, normals);
}

void Prober::draw(gl::Program& program, std::size_t light, std::span<const std::size_t> some,
                  ProbeAnswers& answers) {
  upload(some);
  positions_.bind(3), normals_.bind(4);
  program.set("pnb_positions", 3), program.set("pnb_normals", 4);
  if (patterns_) patterns_->set(program, light, kRow, streams_);
  const int points = !patterns_ ? 1 : is_one_point(scene_.lights[light]) ? 1 : patterns_->count();
  std::uint64_t cut = 0;
  for (int first = 0, at_a_time = 64; first < points;) {
    throw_if_cancelled();
    PictureDraw part;
    part.light_from = light, part.light_count = 1;
    part.first_point = first, part.last_point = std::min(first + at_a_time, points);
    part.point_total = points;
    set_draw(program, part, lights_.list);
    target_.use();
    program.draw(kRow, rows_);
    const std::vector<float> texels = target_.read(0, kRow, rows_);
    cut = 0;
    for (std::size_t i = 0; i < some.size(); ++i) cut += PixelNotes(texels[4 * i + 1]).cut;
    if (cut > 0 && at_a_time > 1 && points > 1) {
      at_a_time = std::max(1, at_a_time / 8);
      continue;
    }
    if (cut > 0) refuse_cut_loops(field_, context_.renderer(), cut, some.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
      const PixelNotes notes(texels[4 * i + 1]);
      answers.fractions[some[i]] += texels[4 * i];
      answers.field_steps += notes.steps;
      answers.unfinished += notes.unfinished;
    }
    first = part.last_point;
  }
}

ProbeAnswers Prober::answer(Progress& progress) {
  progress.start("compile", 0);
  const ShadowOptions& shadows = options_.shadows;
  auto program = field_program(field_, lights_, shadows, ShaderTask::probe,
                               {kRow, static_cast<int>(kMost) / kRow, options_.time});
  textures_.give(*program);
  if (shadows.kind == ShadowKind::area)
    patterns_ = std::make_unique<PointPatterns>(light_point_count(shadows), shadows.seed, kRow,
                                                static_cast<int>(kMost) / kRow);
  progress.finish();
  ProbeAnswers answers;
  answers.fractions.assign(queries_.size(), 0.0f);
  answers.device = context_.renderer();
  progress.start("probe", queries_.size());
  for (std::size_t light = 0; light < lights_.list.size(); ++light) {
    std::vector<std::size_t> mine;
    for (std::size_t i = 0; i < queries_.size(); ++i)
      if (queries_[i].light == light) mine.push_back(i);
    for (std::size_t from = 0; from < mine.size(); from += kMost) {
      const std::size_t count = std::min(kMost, mine.size() - from);
      draw(*program, light, std::span(mine).subspan(from, count), answers);
      progress.advance(count);
    }
  }
  progress.finish();
  return answers;
}

}  // namespace

ProbeAnswers probe_field(const gl::Context& context, const Scene& scene, const FieldText& field,
                         const RenderOptions& options, std::span<const ProbeQuery> queries,
                         Progress& progress) {
  return Prober(context, scene, field, options, queries).answer(progress);
}

}  // namespace penumbra
