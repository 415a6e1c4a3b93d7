#include <fmt/format.h>
#include <json/writer.h>

#include <cmath>
#include <filesystem>
#include <new>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "commands.h"
#include "compare/error_map.h"
#include "image/png.h"
#include "outputs.h"
#include "picture_file.h"

namespace penumbra::app {
namespace {

struct Limit {
  const char* option;
  double value;
};

// One number that is printed, and what it may be.
struct Measure {
  const char* name;
  const char* unit;
  std::optional<double> value;  // none: the pictures are too small for it
  std::optional<Limit> limit;
  bool larger_is_worse = true;

  bool within() const {
    if (!limit) return true;
    return larger_is_worse ? *value <= limit->value : *value >= limit->value;
  }
};

struct Comparison {
  PictureErrors errors;
  HdrFlip flip;
  double mean_flip = 0;
  int width = 0, height = 0;
  PictureKind kind = PictureKind::display;
  std::size_t no_numbers = 0;
  std::vector<Measure> measures;

  bool within() const {
    for (const Measure& measure : measures)
      if (!measure.within()) return false;
    return true;
  }
};

// As floats were read from text: "0.1" is to bound what is 0.1 by any rounding.
std::optional<Limit> limit_of(const char* option, const std::optional<float>& value) {
  if (!value) return std::nullopt;
  return Limit{option, double{*value}};
}

std::vector<Measure> measures_of(const DiffArguments& diff, const Comparison& c) {
  std::optional<Limit> error = limit_of("--max-error", diff.max_error);
  if (!diff.has_limit()) error = Limit{"--max-error", 0};
  return {{"error", "", c.errors.largest, error},
          {"rmse", "", c.errors.rmse, limit_of("--max-rmse", diff.max_rmse)},
          {"psnr", " dB", c.errors.psnr_db, limit_of("--min-psnr", diff.min_psnr), false},
          {"ssim", "", c.errors.ssim, limit_of("--min-ssim", diff.min_ssim), false},
          {"flip", "", c.mean_flip, limit_of("--max-flip", diff.max_flip)}};
}

Comparison compare(const DiffArguments& diff, const PictureFile& a, const PictureFile& b) {
  Comparison c;
  c.width = a.image.width;
  c.height = a.image.height;
  c.kind = a.kind;
  c.errors = picture_errors(a.image, b.image, a.kind);
  if (diff.min_ssim && !c.errors.ssim)
    throw InputError("--min-ssim: these pictures are smaller than its window of 11x11 pixels",
                     "leave it out");
  if (a.kind == PictureKind::linear)
    c.flip = hdr_flip(a.image, b.image, diff.pixels_per_degree);
  else
    c.flip.map = flip_map(a.image, b.image, diff.pixels_per_degree);
  c.mean_flip = mean_value(c.flip.map);
  c.measures = measures_of(diff, c);
  return c;
}

std::string line_of(const Measure& measure, const std::string& note) {
  std::string line = measure.value
                         ? fmt::format("{:6}{:.6g}{}", measure.name, *measure.value, measure.unit)
                         : fmt::format("{:6}-", measure.name);
  line += note;
  if (measure.limit)
    line += fmt::format("  ({} {}: {})", measure.limit->option,
                        static_cast<float>(measure.limit->value),
                        measure.within() ? "within" : "beyond");
  return line + '\n';
}

std::string text_of(const Comparison& c) {
  std::string text;
  for (const Measure& measure : c.measures) {
    std::string note;
    if (measure.name == std::string_view("error") && c.errors.largest > 0)
      note = fmt::format(" at {},{}", c.errors.largest_x, c.errors.largest_y);
    text += line_of(measure, note);
  }
  if (c.no_numbers > 0)
    text += fmt::format("{} pixels are no number in both and count as equal\n", c.no_numbers);
  return text;
}

Json::Value number_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json::Value(*value) : Json::Value();
}

Json::Value flip_json(const DiffArguments& diff, const Comparison& c) {
  Json::Value json;
  json["mean"] = c.mean_flip;
  json["pixels_per_degree"] = diff.pixels_per_degree;
  if (c.kind == PictureKind::linear) {
    json["exposures"] = c.flip.exposures;
    json["first_ev"] = c.flip.first_ev;
    json["last_ev"] = c.flip.last_ev;
  }
  return json;
}

std::string json_of(const DiffArguments& diff, const Comparison& c) {
  Json::Value json;
  json["a"] = diff.reference;
  json["b"] = diff.test;
  json["size"].append(c.width);
  json["size"].append(c.height);
  json["kind"] = c.kind == PictureKind::display ? "display" : "linear";
  json["error"] = c.errors.largest;
  json["error_at"].append(c.errors.largest_x);
  json["error_at"].append(c.errors.largest_y);
  json["rmse"] = c.errors.rmse;
  json["psnr_db"] = number_or_null(c.errors.psnr_db);
  json["ssim"] = number_or_null(c.errors.ssim);
  json["flip"] = flip_json(diff, c);
  json["pixels_without_number"] = static_cast<Json::UInt64>(c.no_numbers);
  json["within"] = c.within();
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "  ";
  builder["precision"] = 9;
  return Json::writeString(builder, json) + '\n';
}

void check_map(const DiffArguments& diff) {
  if (diff.map.empty()) return;
  if (!has_extension(diff.map, ".png"))
    throw InputError({diff.map}, "a map is written as PNG", "let it end in .png");
  std::error_code ignored;
  for (const std::string& file : {diff.reference, diff.test})
    if (std::filesystem::equivalent(diff.map, file, ignored))
      throw InputError({diff.map}, "this is one of the pictures", "name another file for the map");
  const AtomicFile can_be_written(diff.map);
}

bool differ_within_limits(const Arguments& arguments) {
  const DiffArguments& diff = arguments.diff;
  check_map(diff);
  PictureFile a = read_picture(diff.reference, diff.channel);
  PictureFile b = read_picture(diff.test, diff.channel);
  const std::size_t no_numbers = make_comparable(a, b);
  Comparison comparison = compare(diff, a, b);
  comparison.no_numbers = no_numbers;
  if (!diff.map.empty())
    write_png(diff.map, a.image.channels == 1 ? signed_error_map(a.image, b.image)
                                              : magnitude_map(comparison.flip.map));
  if (!arguments.quiet) print(diff.json ? json_of(diff, comparison) : text_of(comparison));
  return comparison.within();
}

}  // namespace

// As with diff(1), 1 is an answer; all that goes wrong is 2, an InputError's status.
int run_diff(const Arguments& arguments) try {
  return differ_within_limits(arguments) ? 0 : 1;
} catch (const WorkError& error) {
  throw InputError(Told{error.what()});
} catch (const std::bad_alloc&) {
  throw InputError("the memory is not enough for these pictures", "compare smaller ones");
}

}  // namespace penumbra::app
