#include "report/advice.h"

#include <fmt/format.h>

#include <algorithm>

namespace penumbra::report {
namespace {

std::string name_of(const Candidate& c) {
  return c.light_samples ? fmt::format("{} with {} points", c.name, *c.light_samples) : c.name;
}

std::string time_of(const Candidate& c, const Candidate* hard) {
  if (hard == nullptr || &c == hard || !(hard->seconds > 0))
    return fmt::format("{:.3g} s a picture", c.seconds);
  return fmt::format("{:.2g} × the time of hard", c.seconds / hard->seconds);
}

/// The fastest of those that `counts` says yes to.
template <class Counts>
const Candidate* fastest(const std::vector<Candidate>& all, const Counts& counts) {
  const Candidate* best = nullptr;
  for (const Candidate& c : all)
    if (counts(c) && (best == nullptr || c.seconds < best->seconds)) best = &c;
  return best;
}

}  // namespace

Advice advise(const std::vector<Candidate>& candidates, double limit, bool has_penumbra) {
  if (candidates.empty()) return {"", {}, "no method could be measured here"};
  const auto hard = std::find_if(candidates.begin(), candidates.end(),
                                 [](const Candidate& c) { return c.name == "hard"; });
  const Candidate* yardstick = hard == candidates.end() ? nullptr : &*hard;
  const Candidate* chosen =
      fastest(candidates, [&](const Candidate& c) { return c.error <= limit; });
  if (!has_penumbra)
    return {chosen->name, chosen->light_samples,
            fmt::format("use {} here: no pixel sees a part of a light alone, and it is the "
                        "fastest at {}",
                        name_of(*chosen), time_of(*chosen, nullptr))};
  const bool good_enough = chosen != nullptr;
  if (!good_enough)
    chosen = &*std::min_element(
        candidates.begin(), candidates.end(),
        [](const Candidate& a, const Candidate& b) { return a.error < b.error; });
  std::string text = fmt::format("use {} here: penumbra error {:.2g} at {}", name_of(*chosen),
                                 chosen->error, time_of(*chosen, yardstick));
  if (!good_enough) text += fmt::format("; none keeps within {:.2g}, it comes nearest", limit);
  const Candidate* next = fastest(candidates, [&](const Candidate& c) {
    return good_enough && &c != chosen && c.error <= limit;
  });
  const Candidate* worse = fastest(candidates, [&](const Candidate& c) {
    return good_enough && c.seconds < chosen->seconds && c.error > limit;
  });
  if (next != nullptr)
    text += fmt::format("; {} would take {}", name_of(*next), time_of(*next, yardstick));
  if (worse != nullptr)
    text += fmt::format("; {}, which is faster, errs by {:.2g}", name_of(*worse), worse->error);
  return {chosen->name, chosen->light_samples, text};
}

}  // namespace penumbra::report
