// Ctrl-C.
#pragma once

namespace penumbra::app {

/// From now on an interrupt sets cancel_requested. Work that has not stopped by itself 0.8 s later
/// (in a library that cannot be asked to) is ended: unfinished files are removed and the process
/// exits with 130. To be called once, before other threads begin.
void stop_on_interrupt();

/// While one lives, Ctrl-C asks for what there is: it sets cancel_requested without an end after
/// 0.8 s, and work that catches Cancelled and calls take_interrupt() goes on with what it has. A
/// second Ctrl-C ends the process at once, as above. One at a time.
class FinishOnInterrupt {
 public:
  FinishOnInterrupt();
  ~FinishOnInterrupt();
  FinishOnInterrupt(const FinishOnInterrupt&) = delete;
  FinishOnInterrupt& operator=(const FinishOnInterrupt&) = delete;

  /// True if Ctrl-C asked for what there is; then cancel_requested is false again.
  bool take_interrupt() const;
};

/// True if Ctrl-C was pressed.
bool was_interrupted();

}  // namespace penumbra::app
