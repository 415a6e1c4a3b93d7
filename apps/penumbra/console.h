// What a person sees on stderr while the program works.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "base/progress.h"

namespace penumbra::app {

/// Progress as a one-line bar with time left on a terminal, as a line per phase elsewhere; remarks
/// and warnings as lines. Says nothing if quiet. Thread-safe.
class Console : public Progress {
 public:
  explicit Console(bool quiet);

  void start(std::string_view phase, std::uint64_t total) override;
  void advance(std::uint64_t steps) override;
  void finish() override;

  void remark(const std::string& text);
  void warn(const std::string& text);
  /// Ends a bar that an error has interrupted.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  double seconds() const;
  void draw(std::uint64_t done);
  void line(const std::string& text);

  const bool quiet_, terminal_;
  std::mutex mutex_;
  std::string phase_;
  std::uint64_t total_ = 0;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<Clock::rep> next_draw_{0};
  Clock::time_point begin_;
  bool bar_drawn_ = false;
};

}  // namespace penumbra::app
