#include "console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace penumbra::app {
namespace {

constexpr auto kBetweenDraws = std::chrono::milliseconds(100);
constexpr int kBarWidth = 30;

std::string duration(double seconds) {
  if (seconds < 10) return fmt::format("{:.2f} s", seconds);
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  const auto whole = static_cast<long>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

void put(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

Console::Console(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) != 0) {}

double Console::seconds() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count();
}

void Console::line(const std::string& text) {
  if (bar_drawn_) put("\r\033[K");
  bar_drawn_ = false;
  put(text + '\n');
}

void Console::start(std::string_view phase, std::uint64_t total) {
  const std::lock_guard lock(mutex_);
  phase_ = phase;
  total_ = total;
  done_ = 0;
  begin_ = Clock::now();
  next_draw_ = (begin_ + kBetweenDraws).time_since_epoch().count();
  if (!quiet_ && terminal_) draw(0);
}

void Console::advance(std::uint64_t steps) {
  const std::uint64_t done = done_ += steps;
  if (quiet_ || !terminal_) return;
  const auto now = Clock::now().time_since_epoch();
  auto due = next_draw_.load(std::memory_order_relaxed);
  if (now.count() < due) return;
  const auto next = (now + Clock::duration(kBetweenDraws)).count();
  if (!next_draw_.compare_exchange_strong(due, next)) return;
  const std::lock_guard lock(mutex_);
  draw(done);
}

void Console::draw(std::uint64_t done) {
  std::string text = "\r\033[K" + phase_;
  if (total_ > 0) {
    const double part = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
    const auto full = static_cast<std::size_t>(part * kBarWidth);
    text += fmt::format(" [{}{}] {:3.0f} %", std::string(full, '='),
                        std::string(kBarWidth - full, ' '), part * 100);
    if (part > 0) text += fmt::format(", {} left", duration(seconds() * (1 - part) / part));
  }
  put(text);
  bar_drawn_ = true;
}

void Console::finish() {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  line(fmt::format("{}: {}", phase_, duration(seconds())));
}

void Console::remark(const std::string& text) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  line(text);
}

void Console::warn(const std::string& text) { remark("penumbra: warning: " + text); }

void Console::clear() {
  const std::lock_guard lock(mutex_);
  if (bar_drawn_) put("\r\033[K");
  bar_drawn_ = false;
}

}  // namespace penumbra::app
