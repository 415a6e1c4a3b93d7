// Contestants that take turns, so that what else the machine does hits all of them alike.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace penumbra::bench {

/// Seconds that `work` takes.
double seconds(const std::function<void()>& work);

double median(std::vector<double> values);

class Race {
 public:
  /// Returns the contestant's number.
  std::size_t add(std::string name, std::function<void()> work);
  /// A warm-up each, then `repeats` rounds in which each takes a turn: it runs once, or for a
  /// twentieth of a second, of which the least time counts.
  void run(int repeats);

  const std::string& name(std::size_t i) const { return contestants_[i].name; }
  /// The median of a contestant's times in seconds.
  double time(std::size_t i) const { return median(contestants_[i].times); }
  /// The median over the rounds of time a / time b.
  double ratio(std::size_t a, std::size_t b) const;
  /// The one of these with the least median.
  std::size_t fastest(const std::vector<std::size_t>& among) const;

 private:
  struct Contestant {
    std::string name;
    std::function<void()> work;
    std::vector<double> times;
  };
  std::vector<Contestant> contestants_;
};

}  // namespace penumbra::bench
