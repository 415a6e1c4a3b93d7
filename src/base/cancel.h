// Ctrl-C: a flag that long loops look at.
#pragma once

#include <atomic>

namespace penumbra {

/// Set by the signal handler; safe to set from any thread or handler.
inline std::atomic<bool> cancel_requested{false};

/// Throws Cancelled if a stop was asked for. Cheap enough for every tile or thousand lines.
void throw_if_cancelled();

}  // namespace penumbra
