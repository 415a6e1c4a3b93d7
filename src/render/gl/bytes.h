// Results as bytes, for the way from a child process of the same program.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "render/gl/probe.h"
#include "render/render.h"

namespace penumbra {

std::string to_bytes(const RenderResult& result);
std::string to_bytes(const ProbeAnswers& answers);
RenderResult render_result_from(const std::string& bytes);
ProbeAnswers probe_answers_from(const std::string& bytes);

}  // namespace penumbra
