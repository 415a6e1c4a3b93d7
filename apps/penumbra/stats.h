// The JSON of --stats.
#pragma once

#include <json/value.h>

#include "arguments.h"
#include "console.h"
#include "render/render.h"

namespace penumbra::app {

/// What every command reports: program, command line, scene counts, threads, memory.
/// `structure_bytes`: of what was built to look things up.
Json::Value common_stats(const Arguments& arguments, const Scene& scene,
                         std::size_t structure_bytes);

void add_shadow_counts(Json::Value& stats, const ShadowCounts& counts);

/// Adds the peak of memory and writes the file; throws WorkError.
/// Warns of rays and marches that ran out of steps.
void warn_of_unfinished(const ShadowCounts& counts, Console& console);

void write_stats(const std::string& file, Json::Value stats);

}  // namespace penumbra::app
