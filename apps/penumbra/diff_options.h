// What `diff` is asked.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "compare/flip.h"

namespace penumbra::app {

struct Arguments;

struct DiffArguments {
  std::string reference, test;  ///< picture files
  std::string channel;          ///< of EXR files; empty = R, G and B, or the only one
  std::string map;              ///< PNG file; empty = none
  float pixels_per_degree = kPixelsPerDegree;
  std::optional<float> max_error, max_rmse, max_flip, min_psnr, min_ssim;
  bool json = false;

  bool has_limit() const { return max_error || max_rmse || max_flip || min_psnr || min_ssim; }
};

void add_diff_options(CLI::App& command, Arguments& arguments);

}  // namespace penumbra::app
