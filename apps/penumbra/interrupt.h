// Ctrl-C.
#pragma once

namespace penumbra::app {

/// From now on an interrupt sets cancel_requested. Work that has not stopped by itself 0.8 s later
/// (in a library that cannot be asked to) is ended: unfinished files are removed and the process
/// exits with 130. To be called once, before other threads begin.
void stop_on_interrupt();

}  // namespace penumbra::app
