#include "compare_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "options.h"
#include "report/methods.h"
#include "values.h"

namespace penumbra::app {
namespace {

constexpr int kDefaultValues = 5;

struct Range {
  std::string_view name;  // in the order of SweepParameter
  double least, most;
};
constexpr std::array<Range, 3> kRanges{
    {{"light-size", 1e-6, 1e6}, {"distance", 1e-3, 1e3}, {"samples", 1, 65536}}};

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for (const report::MethodText& method : report::methods()) names.push_back(method.name);
  return names;
}

[[noreturn]] void refuse_sweep(const std::string& text, const std::string& what) {
  throw InputError(fmt::format("--sweep {}: {}", text, what),
                   "write NAME=FIRST..LAST or NAME=FIRST..LAST:COUNT, as in light-size=0.01..1:5");
}

double read_end(const std::string& text, const std::string& number, const Range& range) {
  double value = 0;
  if (!read_number(number, value)) refuse_sweep(text, fmt::format("'{}' is not a number", number));
  if (value < range.least || value > range.most)
    refuse_sweep(text, fmt::format("{} is not from {:g} to {:g}", number, range.least, range.most));
  return value;
}

void whole_numbers_once(std::vector<double>& values) {
  for (double& value : values) value = std::round(value);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

void add_sweep(Arguments& a, const std::string& text) {
  const report::SweepRequest request = read_sweep(text);
  for (const report::SweepRequest& other : a.compare.sweeps)
    if (other.parameter == request.parameter)
      throw InputError(fmt::format("--sweep: {} is swept twice", to_string(request.parameter)),
                       "sweep it once, with more values");
  a.compare.sweeps.push_back(request);
}

}  // namespace

std::vector<ShadowKind> read_methods(const std::string& text) {
  const std::vector<std::string_view> names = method_names();
  std::vector<ShadowKind> kinds;
  for (const std::string& name : split(text, ',')) {
    const ShadowKind kind = report::methods()[parse_choice("--shadows", name, names)].kind;
    if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end())
      throw InputError(fmt::format("--shadows: {} is named twice", name), "name each method once");
    kinds.push_back(kind);
  }
  return kinds;
}

report::SweepRequest read_sweep(const std::string& text) {
  const std::size_t equals = text.find('='), dots = text.find("..");
  if (equals == text.npos) refuse_sweep(text, "there is no =");
  std::array<std::string_view, kRanges.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kRanges[i].name;
  const std::size_t which = parse_choice("--sweep", text.substr(0, equals), names);
  if (dots == text.npos || dots < equals) refuse_sweep(text, "there is no ..");
  const std::size_t colon = text.find(':', dots);
  const std::string count = colon == text.npos ? "" : text.substr(colon + 1);
  const std::string last = text.substr(dots + 2, colon == text.npos ? text.npos : colon - dots - 2);
  const double from = read_end(text, text.substr(equals + 1, dots - equals - 1), kRanges[which]);
  const double to = read_end(text, last, kRanges[which]);
  if (from == to) refuse_sweep(text, "both ends are the same");
  double values = kDefaultValues;
  if (colon != text.npos &&
      (!read_number(count, values) || values != std::floor(values) || values < 2 || values > 100))
    refuse_sweep(text, fmt::format("'{}' is not a whole number from 2 to 100", count));
  report::SweepRequest request;
  request.parameter = static_cast<report::SweepParameter>(which);
  request.values = report::log_spaced(from, to, static_cast<int>(values));
  if (request.parameter == report::SweepParameter::samples) whole_numbers_once(request.values);
  return request;
}

void add_compare_options(CLI::App& command, Arguments& a) {
  const auto add = [&](const char* name, const char* value, const char* shown, auto read,
                       const char* help) {
    return add_value(command, a, name, value, shown, read, help)->group("Comparison");
  };
  add(
      "--repeats", "N", "3",
      [&](auto& t) {
        a.compare.repeats = static_cast<int>(parse_integer("--repeats", t, 1, 1000));
      },
      "timed pictures of each method; without it none is begun after five seconds of them");
  add(
      "--sweep", "NAME=FIRST..LAST:N", "", [&](auto& t) { add_sweep(a, t); },
      "also measure at N values (5), spaced by their logarithms; repeatable. NAME: light-size or\n"
      "distance (factors on all lights), samples (of area and heckbert-herf)")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

}  // namespace penumbra::app
