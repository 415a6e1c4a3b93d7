#include "report/results_json.h"

#include <fmt/format.h>
#include <json/writer.h>

#include <cmath>

namespace penumbra::report {
namespace {

Json::Value count(std::uint64_t n) { return Json::Value(static_cast<Json::UInt64>(n)); }

Json::Value number(double x) { return std::isfinite(x) ? Json::Value(x) : Json::Value(); }

template <class T>
Json::Value count(const std::optional<T>& n) {
  return n ? count(static_cast<std::uint64_t>(*n)) : Json::Value();
}

template <class Range, class Make>
Json::Value list(const Range& range, const Make& make) {
  Json::Value out(Json::arrayValue);
  for (const auto& item : range) out.append(make(item));
  return out;
}

Json::Value scene_json(const Comparison& c) {
  Json::Value out;
  out["file"] = c.scene_file;
  out["checksum"] = fmt::format("{:016x}", c.checksum);
  out["width"] = c.reference.width;
  out["height"] = c.reference.height;
  out["camera"] = c.camera;
  out["lights"] = Json::Value(Json::arrayValue);
  for (std::size_t i = 0; i < c.lights.size(); ++i) {
    Json::Value light;
    light["name"] = light_name(c.lights[i], i);
    light["kind"] = to_string(c.lights[i].type);
    out["lights"].append(light);
  }
  out["objects"] = count(c.objects);
  out["triangles"] = count(c.triangles);
  return out;
}

Json::Value machine_json(const Machine& m) {
  Json::Value out;
  out["processor"] = m.processor.empty() ? Json::Value() : Json::Value(m.processor);
  out["threads"] = m.threads;
  out["memory_bytes"] = count(m.memory_bytes);
  out["system"] = m.system;
  return out;
}

Json::Value reference_json(const Comparison& c) {
  const ReferenceQuality quality = quality_of(c.reference, c.reference_options.target);
  Json::Value out;
  out["name"] = "reference";
  out["picture"] = picture_file("reference");
  out["visibility"] = visibility_file("reference");
  out["data"] = data_file("reference");
  out["target_standard_error"] = std::round(1e6 * c.reference_options.target) / 1e6;
  out["share_within"] = quality.share_within;
  out["points_mean"] = quality.points_mean;
  out["points_most"] = quality.points_most;
  out["rays"] = count(c.reference.rays);
  out["seconds"] = c.reference.seconds;
  out["cached"] = c.reference_was_cached;
  return out;
}

void set_errors(const FieldErrors& e, Json::Value& out) {
  out["all"]["rmse"] = e.rmse;
  out["all"]["bias"] = e.bias;
  out["penumbra"]["rmse"] = e.penumbra_rmse;
  out["penumbra"]["bias"] = e.penumbra_bias;
  out["penumbra"]["pixels"] = count(e.penumbra_points);
}

Json::Value error_json(const MethodResult& m) {
  const FieldErrors& e = m.measured.errors.all;
  Json::Value out;
  set_errors(e, out);
  out["largest"] = e.largest;
  out["share_beyond_tenth"] = e.far_off_share();
  out["flip"] = number(m.flip);
  out["ssim"] = m.ssim ? number(*m.ssim) : Json::Value();
  out["leaked"] = e.leaked;
  out["lost"] = e.lost;
  return out;
}

Json::Value phase(const char* name, double seconds) {
  Json::Value out;
  out["name"] = name;
  out["seconds"] = seconds;
  return out;
}

Json::Value cost_json(const Cost& cost, double hard_seconds) {
  Json::Value out;
  out["seconds"]["median"] = cost.seconds.median;
  out["seconds"]["least"] = cost.seconds.least;
  out["seconds"]["most"] = cost.seconds.most;
  out["seconds"]["repeats"] = cost.seconds.repeats;
  out["relative_to_hard"] = number(cost.seconds.median / hard_seconds);
  out["phases"].append(phase("build", cost.build));
  out["phases"].append(phase("render", cost.render));
  out["phases"].append(phase("final picture", cost.picture));
  out["rays"] = count(cost.rays);
  out["distance_evaluations"] = count(cost.evaluations);
  out["texel_samples"] = count(cost.texel_samples);
  out["peak_bytes"] = count(cost.peak_bytes);
  return out;
}

Json::Value equal_area_json(const std::optional<EqualArea>& equal) {
  if (!equal) return {};
  Json::Value out;
  out["points"] = count(equal->points);
  out["seconds"] = equal->seconds;
  return out;
}

Json::Value lights_json(const Comparison& c, const MethodResult& m) {
  Json::Value out(Json::arrayValue);
  for (std::size_t i = 0; i < m.measured.errors.lights.size(); ++i) {
    Json::Value light;
    light["name"] = light_name(c.lights[i], i);
    set_errors(m.measured.errors.lights[i], light);
    out.append(light);
  }
  return out;
}

Json::Value method_json(const Comparison& c, const MethodResult& m, double hard_seconds) {
  const std::string name(m.call.text.name);
  Json::Value out;
  out["name"] = name;
  out["title"] = std::string(m.call.text.title);
  out["summary"] = std::string(m.call.text.summary);
  out["link"] = std::string(m.call.text.link);
  out["status"] = m.ok() ? "ok" : "failed";
  out["reason"] = m.ok() ? Json::Value() : Json::Value(m.reason);
  out["device"] = m.measured.device;
  out["conversions"] = list(m.call.conversions, [](const auto& text) { return text; });
  out["command"] = m.call.command;
  for (const char* key : {"picture", "visibility", "error_map", "data", "error", "cost"})
    out[key] = Json::Value();
  out["lights"] = m.ok() ? lights_json(c, m) : Json::Value(Json::arrayValue);
  out["equal_area"] = equal_area_json(m.equal_area);
  if (!m.ok()) return out;
  out["picture"] = picture_file(name);
  out["visibility"] = visibility_file(name);
  out["error_map"] = error_file(name);
  out["data"] = data_file(name);
  out["error"] = error_json(m);
  out["cost"] = cost_json(m.measured.cost, hard_seconds);
  return out;
}

Json::Value sweep_json(const Sweep& sweep) {
  Json::Value out;
  out["parameter"] = to_string(sweep.parameter);
  out["unit"] = sweep.parameter == SweepParameter::samples ? "points" : "";
  out["values"] = list(sweep.values, number);
  out["methods"] = list(sweep.methods, [](const SweepMethod& m) {
    Json::Value method;
    method["name"] = m.name;
    method["rmse"] = list(m.rmse, number);
    method["penumbra_rmse"] = list(m.penumbra_rmse, number);
    method["seconds"] = list(m.seconds, number);
    return method;
  });
  return out;
}

double seconds_of_hard(const Comparison& c) {
  for (const MethodResult& m : c.methods)
    if (m.ok() && m.call.text.kind == ShadowKind::hard) return m.measured.cost.seconds.median;
  return NAN;
}

}  // namespace

std::string picture_file(const std::string& name) { return "pictures/" + name + ".png"; }
std::string visibility_file(const std::string& name) { return "visibility/" + name + ".png"; }
std::string error_file(const std::string& name) { return "errors/" + name + ".png"; }
std::string data_file(const std::string& name) { return "data/" + name + ".js"; }

Json::Value results_json(const Comparison& c) {
  Json::Value out;
  out["format"] = "penumbra-compare";
  out["version"] = 1;
  out["scene"] = scene_json(c);
  out["machine"] = machine_json(c.machine);
  out["versions"]["penumbra"] = c.versions.penumbra;
  out["versions"]["compiler"] = c.versions.compiler;
  out["versions"]["embree"] = c.versions.embree;
  out["command"] = c.command;
  out["exposure_ev"] = c.exposure_ev;
  out["scale"]["error"] = 0.5;
  out["reference"] = reference_json(c);
  const double hard = seconds_of_hard(c);
  out["methods"] = list(c.methods, [&](const MethodResult& m) { return method_json(c, m, hard); });
  out["sweeps"] = list(c.sweeps, sweep_json);
  out["advice"]["method"] = c.advice.method.empty() ? Json::Value() : Json::Value(c.advice.method);
  out["advice"]["light_samples"] = count(c.advice.light_samples);
  out["advice"]["text"] = c.advice.text;
  return out;
}

std::string json_text(const Json::Value& value) {
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "  ";
  builder["precision"] = 7;
  builder["emitUTF8"] = true;
  return Json::writeString(builder, value) + '\n';
}

}  // namespace penumbra::report
