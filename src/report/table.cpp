#include "report/table.h"

#include <fmt/format.h>

#include <cmath>

namespace penumbra::report {
namespace {

std::string time_text(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  if (seconds < 1) return fmt::format("{:.0f} ms", 1000 * seconds);
  return seconds < 100 ? fmt::format("{:.2f} s", seconds) : fmt::format("{:.0f} s", seconds);
}

/// With M for a million.
std::string count_text(double n) {
  if (n < 10000) return fmt::format("{:.0f}", n);
  if (n < 1e6) return fmt::format("{:.0f} k", n / 1e3);
  return n < 1e9 ? fmt::format("{:.1f} M", n / 1e6) : fmt::format("{:.2f} G", n / 1e9);
}

std::string row(const MethodResult& m, double hard) {
  if (!m.ok()) return fmt::format("{:<14}  could not run: {}\n", m.call.text.name, m.reason);
  const FieldErrors& e = m.measured.errors.all;
  const Cost& cost = m.measured.cost;
  const std::string ratio =
      std::isfinite(hard) ? fmt::format("{:.2f}", cost.seconds.median / hard) : "-";
  const std::string equal =
      m.equal_area ? fmt::format("{} in {}", count_text(static_cast<double>(m.equal_area->points)),
                                 time_text(m.equal_area->seconds))
                   : "-";
  return fmt::format(
      "{:<14} {:>8.4f} {:>8.4f} {:>+8.4f} {:>6.1f}% {:>6.4f} {:>6.4f} {:>8} {:>6} {}\n",
      m.call.text.name, e.penumbra_rmse, e.rmse, e.penumbra_bias, 100 * e.far_off_share(), m.flip,
      m.ssim.value_or(NAN), time_text(cost.seconds.median), ratio, equal);
}

double seconds_of_hard(const Comparison& c) {
  for (const MethodResult& m : c.methods)
    if (m.ok() && m.call.text.kind == ShadowKind::hard) return m.measured.cost.seconds.median;
  return NAN;
}

std::string reference_text(const Comparison& c) {
  const ReferenceQuality q = quality_of(c.reference, c.reference_options.target);
  return fmt::format(
      "reference: {} points a pixel and light in the mean, {} at most; standard error below {:g} "
      "at {:.2f} % of the pixels; {}{}\n",
      count_text(q.points_mean), count_text(q.points_most), c.reference_options.target,
      std::floor(10000 * q.share_within) / 100, time_text(c.reference.seconds),
      c.reference_was_cached ? ", kept from before" : "");
}

std::string sweep_text(const Sweep& sweep) {
  std::string out = fmt::format("\npenumbra error by {}\n{:<14}", to_string(sweep.parameter), "");
  for (const double value : sweep.values) out += fmt::format(" {:>8.3g}", value);
  out += '\n';
  for (const SweepMethod& m : sweep.methods) {
    out += fmt::format("{:<14}", m.name);
    for (const double error : m.penumbra_rmse)
      out += std::isfinite(error) ? fmt::format(" {:>8.4f}", error) : fmt::format(" {:>8}", "-");
    out += '\n';
  }
  return out;
}

}  // namespace

std::string table_text(const Comparison& c) {
  std::string out = reference_text(c);
  out += fmt::format("{:<14} {:^26} {:>7} {:>6} {:>6} {:>8} {:>6} {}\n", "",
                     "-- visible fraction --", "off by", "", "", "one", "", "same error by area");
  out += fmt::format("{:<14} {:>8} {:>8} {:>8} {:>7} {:>6} {:>6} {:>8} {:>6} {}\n", "method",
                     "penumbra", "all", "bias", "> 0.1", "FLIP", "SSIM", "picture", "x hard",
                     "points, time");
  const double hard = seconds_of_hard(c);
  for (const MethodResult& m : c.methods) out += row(m, hard);
  for (const Sweep& sweep : c.sweeps) out += sweep_text(sweep);
  return out + c.advice.text + '\n';
}

}  // namespace penumbra::report
