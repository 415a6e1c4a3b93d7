// The options of compare alone.
#pragma once

#include <CLI/CLI.hpp>

#include "arguments.h"

namespace penumbra::app {

void add_compare_options(CLI::App& command, Arguments& arguments);

/// "hard,parker": methods by name, each once. Throws InputError.
std::vector<ShadowKind> read_methods(const std::string& text);

/// "light-size=0.01..1:5": five values from 0.01 to 1. Throws InputError.
report::SweepRequest read_sweep(const std::string& text);

}  // namespace penumbra::app
