// From argv to Arguments.
#pragma once

#include <optional>
#include <string>

#include "arguments.h"

namespace penumbra::app {

/// Reads the command line. No value: the answer (help, version) is in `answer` and nothing is to be
/// done. Throws InputError, naming the option and, where a name is unknown, the nearest one.
std::optional<Arguments> parse_command_line(int argc, const char* const* argv, std::string& answer);

}  // namespace penumbra::app
