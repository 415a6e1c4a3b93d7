// The options of the subcommands, in groups.
#pragma once

#include <CLI/CLI.hpp>

#include "arguments.h"

namespace penumbra::app {

/// Each adds options that write into `arguments`, which must outlive the parse; their values are
/// checked as they are read (InputError).
void add_shadow_options(CLI::App& command, Arguments& arguments);
void add_light_options(CLI::App& command, Arguments& arguments);
void add_picture_options(CLI::App& command, Arguments& arguments);
void add_run_options(CLI::App& command, Arguments& arguments);
/// --frames, --fps, --turntable and --resume.
void add_animation_options(CLI::App& command, Arguments& arguments);
/// --voxel-size and --bounds.
void add_conversion_options(CLI::App& command, Arguments& arguments);

/// The names among add_picture_options, which mean nothing to `probe`.
bool is_picture_option(const std::string& name);

/// An option with one value; the last one counts if it is repeated.
CLI::Option* add_value(CLI::App& command, Arguments& arguments, const std::string& names,
                       const char* value_name, const char* shown_default,
                       std::function<void(const std::string&)> read, const std::string& help);

}  // namespace penumbra::app
