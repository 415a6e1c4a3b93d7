// Command lines as text.
#pragma once

#include <string>
#include <string_view>

#include "arguments.h"

namespace penumbra::app {

/// The command line as it was typed, quoted for a shell.
std::string all_words(const Arguments& arguments);

/// Of a call of compare: the call of render that draws the picture of one of its methods.
std::string render_words(const Arguments& arguments, std::string_view method);

}  // namespace penumbra::app
