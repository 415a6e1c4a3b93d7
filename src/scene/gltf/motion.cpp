#include "scene/gltf/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "scene/gltf/accessor.h"

namespace penumbra::gltf {
namespace {

enum class Between { linear, step, cubic };

/// An animation's sampler: `size` numbers a keyframe.
class Curve {
 public:
  Curve(Document& document, const std::string& path, const Json::Value& sampler, int size);

  std::vector<double> at(double time) const;
  double begin() const { return times_.front(); }
  double end() const { return times_.back(); }

 private:
  std::vector<double> value(std::size_t i) const { return element(cubic() ? 3 * i + 1 : i); }
  std::vector<double> element(std::size_t i) const;
  bool cubic() const { return between_ == Between::cubic; }
  std::vector<double> between(std::size_t i, double s) const;

  int size_;
  Between between_ = Between::linear;
  std::vector<double> times_;
  std::vector<float> numbers_;
};

Curve::Curve(Document& document, const std::string& path, const Json::Value& sampler, int size)
    : size_(size) {
  const std::string kind = sampler.get("interpolation", "LINEAR").asString();
  between_ = kind == "STEP" ? Between::step : kind == "LINEAR" ? Between::linear : Between::cubic;
  const Elements input(document, sampler["input"].asInt());
  const Elements output(document, sampler["output"].asInt());
  if (input.count() == 0 || input.components() != 1)
    throw document.json().error(path + ".input", "keyframes need at least one time, each a number");
  if (output.components() != size)
    throw document.json().error(
        path + ".output",
        fmt::format("this motion has {} numbers a keyframe, not {}", size, output.components()));
  if (output.count() != input.count() * (cubic() ? 3 : 1))
    throw document.json().error(
        path + ".output", fmt::format("{} values for {} keyframes", output.count(), input.count()));
  document.spend(input.count() * sizeof(double) +
                     output.count() * sizeof(float) * static_cast<std::size_t>(size),
                 path);
  for (std::size_t i = 0; i < input.count(); ++i) {
    float time;
    input.get(i, &time);
    if (!std::isfinite(time) || (i > 0 && !(time > times_.back())))
      throw document.json().error(path + ".input",
                                  fmt::format("time {} does not follow the one before", i));
    times_.push_back(time);
  }
  numbers_.resize(output.count() * static_cast<std::size_t>(size));
  for (std::size_t i = 0; i < output.count(); ++i)
    output.get(i, &numbers_[i * static_cast<std::size_t>(size)]);
  if (!std::ranges::all_of(numbers_, [](float x) { return std::isfinite(x); }))
    throw document.json().error(path + ".output", "a value is no finite number");
}

std::vector<double> Curve::element(std::size_t i) const {
  const auto first = numbers_.begin() + static_cast<std::ptrdiff_t>(i) * size_;
  return {first, first + size_};
}

/// The shorter way between two rotations, at even speed.
std::vector<double> slerp(std::vector<double> a, const std::vector<double>& b, double s) {
  double cosine = 0;
  for (std::size_t c = 0; c < 4; ++c) cosine += a[c] * b[c];
  if (cosine < 0)
    for (double& x : a) x = -x;
  const double angle = std::acos(std::min(std::abs(cosine), 1.0));
  const bool near = angle < 1e-6;
  const double wa = near ? 1 - s : std::sin((1 - s) * angle) / std::sin(angle);
  const double wb = near ? s : std::sin(s * angle) / std::sin(angle);
  for (std::size_t c = 0; c < 4; ++c) a[c] = wa * a[c] + wb * b[c];
  return a;
}

std::vector<double> normalized(std::vector<double> q) {
  double square = 0;
  for (const double x : q) square += x * x;
  if (square > 0)
    for (double& x : q) x /= std::sqrt(square);
  return q;
}

std::vector<double> Curve::between(std::size_t i, double s) const {
  if (between_ == Between::step) return value(i);
  std::vector<double> a = value(i);
  const std::vector<double> b = value(i + 1);
  if (cubic()) {
    const std::vector<double> out = element(3 * i + 2), in = element(3 * i + 3);
    const double way = times_[i + 1] - times_[i], r = 1 - s;
    for (std::size_t c = 0; c < a.size(); ++c)
      a[c] = r * r * ((1 + 2 * s) * a[c] + s * way * out[c]) +
             s * s * ((3 - 2 * s) * b[c] - r * way * in[c]);
    return a;
  }
  if (size_ == 4) return slerp(normalized(a), normalized(b), s);
  for (std::size_t c = 0; c < a.size(); ++c) a[c] = (1 - s) * a[c] + s * b[c];
  return a;
}

std::vector<double> Curve::at(double time) const {
  const auto after = std::ranges::upper_bound(times_, time);
  if (after == times_.begin()) return value(0);
  const auto i = static_cast<std::size_t>(after - times_.begin()) - 1;
  if (after == times_.end()) return value(i);
  return between(i, (time - times_[i]) / (times_[i + 1] - times_[i]));
}

/// Where a pose keeps what a channel moves; null for weights and what extensions move.
std::vector<double>* target_in(Pose& pose, const std::string& path) {
  if (path == "translation") return &pose.translation;
  if (path == "rotation") return &pose.rotation;
  return path == "scale" ? &pose.scale : nullptr;
}

void apply(Document& document, const Json::Value& animation, Json::ArrayIndex channel, double time,
           Motion& motion) {
  const Json::Value& c = animation["channels"][channel];
  const Json::Value& target = c["target"];
  if (!target.isMember("node")) return;  // an extension's own
  const auto node = static_cast<std::size_t>(target["node"].asUInt64());
  const std::string path = target["path"].asString();
  Pose& pose = motion.poses[node];
  std::vector<double>* out = target_in(pose, path);
  if (!out)
    return document.warnings().add(fmt::format("motion of \"{}\" is left out", path.substr(0, 80)));
  if (!document.model().nodes[node].matrix.empty())
    return document.warnings().add("nodes placed by a matrix do not move");
  const auto sampler = c["sampler"].asUInt64();
  if (sampler >= animation["samplers"].size())
    throw document.json().error(fmt::format("animations[0].channels[{}].sampler", channel),
                                fmt::format("{} is no index of a sampler", sampler));
  const Curve curve(document, fmt::format("animations[0].samplers[{}]", sampler),
                    animation["samplers"][static_cast<Json::ArrayIndex>(sampler)],
                    path == "rotation" ? 4 : 3);
  *out = curve.at(time);
  motion.times.push_back(curve.begin());
  motion.times.push_back(curve.end());
}

}  // namespace

Motion motion_at(Document& document, double time) {
  Motion motion;
  const Json::Value& animations = document.json().root()["animations"];
  if (animations.empty()) return motion;
  for (Json::ArrayIndex i = 0; i < animations[0]["channels"].size(); ++i)
    apply(document, animations[0], i, time, motion);
  if (animations.size() > 1)
    document.warnings().add(fmt::format("of {} animations the first is shown", animations.size()));
  if (motion.times.empty()) return motion;
  const auto [first, last] = std::ranges::minmax(motion.times);
  motion.times = {first};
  if (last > first) motion.times.push_back(last);
  return motion;
}

}  // namespace penumbra::gltf
