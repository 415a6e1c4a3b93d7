#include "race.h"

#include <algorithm>
#include <chrono>

namespace penumbra::bench {

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::size_t Race::add(std::string name, std::function<void()> work) {
  contestants_.push_back({std::move(name), std::move(work), {}});
  return contestants_.size() - 1;
}

namespace {

// A turn: what takes little is done several times, of which the least counts.
double turn(const std::function<void()>& work) {
  constexpr double least_turn = 0.05;
  double least = seconds(work), all = least;
  while (all < least_turn) {
    const double again = seconds(work);
    least = std::min(least, again), all += again;
  }
  return least;
}

}  // namespace

void Race::run(int repeats) {
  for (Contestant& c : contestants_) c.work();
  for (int i = 0; i < repeats; ++i)
    for (Contestant& c : contestants_) c.times.push_back(turn(c.work));
}

double Race::ratio(std::size_t a, std::size_t b) const {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < contestants_[a].times.size(); ++i)
    ratios.push_back(contestants_[a].times[i] / contestants_[b].times[i]);
  return median(ratios);
}

std::size_t Race::fastest(const std::vector<std::size_t>& among) const {
  return *std::min_element(among.begin(), among.end(),
                           [&](std::size_t a, std::size_t b) { return time(a) < time(b); });
}

}  // namespace penumbra::bench
