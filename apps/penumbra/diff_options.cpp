#include "diff_options.h"

#include "arguments.h"
#include "options.h"
#include "values.h"

namespace penumbra::app {
namespace {

void add_limits(CLI::App& command, Arguments& a) {
  const auto add = [&](const char* name, const char* value, std::optional<float>& limit,
                       double least, double most, const char* help) {
    add_value(
        command, a, name, value, "",
        [=, &limit](auto& text) { limit = parse_number(name, text, least, most); }, help)
        ->group("Limits (without any, the pictures must be equal)");
  };
  add("--max-error", "X", a.diff.max_error, 0, 1e30, "greatest difference of a channel of a pixel");
  add("--max-rmse", "X", a.diff.max_rmse, 0, 1e30, "root mean square of the differences");
  add("--max-flip", "X", a.diff.max_flip, 0, 1, "mean FLIP");
  add("--min-psnr", "DB", a.diff.min_psnr, -1000, 1000, "peak signal-to-noise ratio");
  add("--min-ssim", "X", a.diff.min_ssim, -1, 1, "mean structural similarity");
}

}  // namespace

void add_diff_options(CLI::App& command, Arguments& a) {
  add_limits(command, a);
  const auto add = [&](const char* name, const char* value, const char* shown, auto read,
                       const char* help) {
    add_value(command, a, name, value, shown, read, help)->group("Comparison");
  };
  add(
      "--map", "OUT.png", "", [&](auto& t) { a.diff.map = t; },
      "write where they differ: FLIP, black 0 to pale yellow 1; of a single channel B - A,\n"
      "blue -0.5, white 0, orange 0.5");
  add(
      "--channel", "NAME", "R, G and B, or the only one", [&](auto& t) { a.diff.channel = t; },
      "of EXR files, as visibility.key");
  add(
      "--pixels-per-degree", "N", "67",
      [&](auto& t) { a.diff.pixels_per_degree = parse_number("--pixels-per-degree", t, 1, 1000); },
      "FLIP: what the eye sees of the screen");
  add(
      "--threads", "N", "all",
      [&](auto& t) { a.threads = static_cast<int>(parse_integer("--threads", t, 1, 1024)); },
      "how many work");
  command.add_flag("--json", a.diff.json, "print JSON")->group("Comparison");
  command.add_flag("-q,--quiet", a.quiet, "print nothing but errors")->group("Comparison");
}

}  // namespace penumbra::app
