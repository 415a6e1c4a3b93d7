// Films, by ffmpeg if the machine has it.
#pragma once

#include <string>

namespace penumbra::app {

/// True if the name ends as a film does that can be made: .mp4, .mov, .mkv, .webm, .gif.
bool is_film(const std::string& file);

/// Throws InputError if there is no ffmpeg.
void check_ffmpeg();

/// Joins PNG frames named by `pattern` (as ffmpeg takes it, numbered from 0) to a film, which is
/// made in `folder` (on the same disk) first. Throws WorkError; then `film` is as it was before.
void make_film(const std::string& pattern, int frames, double frames_per_second,
               const std::string& folder, const std::string& film);

}  // namespace penumbra::app
