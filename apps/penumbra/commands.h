// The subcommands.
#pragma once

#include <string_view>

#include "arguments.h"
#include "console.h"

namespace penumbra::app {

void run_render(Arguments& arguments, Console& console);
void run_probe(Arguments& arguments, Console& console);
void run_bake(Arguments& arguments, Console& console);
void run_animate(Arguments& arguments, Console& console);
void run_export(Arguments& arguments, Console& console);
void run_info(const Arguments& arguments);
void run_new(const Arguments& arguments);
/// The exit status: 0 within the limits, 1 beyond.
int run_diff(const Arguments& arguments);

/// Writes all of it to standard output; throws WorkError.
void print(std::string_view text);

}  // namespace penumbra::app
