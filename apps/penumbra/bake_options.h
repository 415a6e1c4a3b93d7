// The options of bake.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "arguments.h"

namespace penumbra::app {

/// Of `--sample-grid`.
bake::SamplePlacement read_sample_grid(const std::string& text);

/// Adds the options that belong to bake alone; their values are checked as they are read.
void add_bake_options(CLI::App& command, Arguments& arguments);

}  // namespace penumbra::app
