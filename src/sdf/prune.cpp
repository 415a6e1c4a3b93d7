#include "sdf/prune.h"

#include <algorithm>
#include <cmath>

namespace penumbra::sdf {
namespace {

constexpr float infinite = INFINITY;

struct Range {
  float lo, hi;
  Range negated() const { return {-hi, -lo}; }
};

/// A value matters only where it lies within; outside, anything on the same side will do.
struct Window {
  float lo = -infinite, hi = infinite;
};

struct Decision {
  bool keep_acc, keep_v;
  Window acc, v;
};

Decision decide(Join join, const Header& h, const Range& a, const Range& given_v, const Window& w) {
  const bool negative = join == Join::max_negative || join == Join::smax_negative;
  const Range v = negative ? given_v.negated() : given_v;
  Decision d{true, true, {}, {}};
  switch (join) {
    case Join::min:
      d.acc = {w.lo, std::min({w.hi, a.hi, v.hi})};
      d.keep_acc = a.lo <= d.acc.hi, d.keep_v = v.lo <= d.acc.hi;
      break;
    case Join::max:
    case Join::max_negative:
      d.acc = {std::max({w.lo, a.lo, v.lo}), w.hi};
      d.keep_acc = a.hi >= d.acc.lo, d.keep_v = v.hi >= d.acc.lo;
      break;
    case Join::smin:
      d.keep_acc = a.lo < v.hi + h.k, d.keep_v = v.lo < a.hi + h.k;
      break;
    case Join::smax:
    case Join::smax_negative:
      d.keep_acc = a.hi > v.lo - h.k, d.keep_v = v.hi > a.lo - h.k;
      break;
    default:
      d.keep_acc = false;
  }
  if (!d.keep_acc && !d.keep_v) d.keep_acc = d.keep_v = true;
  d.v = negative ? Window{-d.acc.hi, -d.acc.lo} : d.acc;
  return d;
}

class Pruner {
 public:
  Pruner(const Tape& tape, std::span<const Word> code, const std::vector<Ranges>& ranges, int lane,
         std::vector<Word>& out)
      : tape_(tape), code_(code), ranges_(ranges), lane_(lane), out_(out) {}

  // From the result backwards.
  void run() {
    out_.clear();
    for (std::size_t i = code_.size(); i-- > 0;) {
      if (is_count(code_[i])) continue;
      const std::uint32_t place = tape_.place(code_[i]);
      if (place >= skip_from_) continue;
      skip_from_ = none;
      look(i, place);
    }
    std::ranges::reverse(out_);
  }

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr std::size_t least_guarded = 3;

  // The accumulator of a restored value, between spill and restore.
  struct Group {
    Window outer;
    std::uint32_t skip_from;  ///< where the outer accumulator began if it is dropped, else `none`
  };

  void look(std::size_t i, std::uint32_t place) {
    const Word w = code_[i];
    const Header& h = tape_.header(w);
    switch (h.op) {
      case Op::spill:
        return leave_group(w);
      case Op::restore:
        return join(i, place, true);
      case Op::guard:
        return close_group(w, tape_.info[place].v_begin);
      case Op::multiply:
        out_.push_back(w);
        return scale_window(1 / reinterpret_cast<const float*>(&h)[4]);
      case Op::round:
        out_.push_back(w);
        return shift_window(reinterpret_cast<const float*>(&h)[4]);
      case Op::onion:
      case Op::displace:
      case Op::unbend:
        out_.push_back(w);
        window_ = {};
        return;
      default:
        if (is_shape(h.op)) return join(i, place, false);
        out_.push_back(w);
    }
  }

  // A guard pays where it has a few words left to skip.
  void close_group(Word w, std::uint32_t end) {
    std::size_t n = 0;
    while (n < out_.size()) {
      const Word& last = out_[out_.size() - 1 - n];
      if (!is_count(last) && tape_.place(last) >= end) break;
      ++n;
    }
    // A count stands before its guard here: without that it belongs to the words beyond.
    if (n > 0 && is_count(out_[out_.size() - n])) --n;
    if (n < least_guarded) return;
    out_.push_back(count_mark | static_cast<Word>(n));
    out_.push_back(w);
  }

  void scale_window(float s) { window_ = {window_.lo * s, window_.hi * s}; }
  // With room for the rounding of the subtraction that it undoes.
  void shift_window(float r) {
    const auto room = [](float x) { return std::isfinite(x) ? 1e-5f * std::abs(x) : 0; };
    window_ = {window_.lo + r - room(window_.lo), window_.hi + r + room(window_.hi)};
  }

  void join(std::size_t i, std::uint32_t place, bool restores) {
    const Word w = code_[i];
    const Join how = join_of(w);
    if (how == Join::load || how == Join::load_negative) {
      out_.push_back(w);  // a restore of this kind has no spill any more
      if (how == Join::load_negative) window_ = {-window_.hi, -window_.lo};
      return;
    }
    const Ranges& r = ranges_[i];
    const Decision d = decide(how, tape_.header(w), {r.acc_lo[lane_], r.acc_hi[lane_]},
                              {r.v_lo[lane_], r.v_hi[lane_]}, window_);
    const WordInfo& info = tape_.info[place];
    if (!d.keep_v) {
      skip_from_ = restores ? info.v_begin : place;
      window_ = d.acc;
    } else if (d.keep_acc) {
      out_.push_back(w);
      if (restores) groups_.push_back({d.acc, none});
      window_ = restores ? d.v : d.acc;
    } else {
      drop_acc(w, how, info, restores, d);
    }
  }

  void drop_acc(Word w, Join how, const WordInfo& info, bool restores, const Decision& d) {
    const bool negative = how == Join::max_negative || how == Join::smax_negative;
    if (!restores || negative)
      out_.push_back(word_of(w & offset_mask, negative ? Join::load_negative : Join::load));
    if (!restores) {
      skip_from_ = info.acc_begin;
      return;
    }
    groups_.push_back({{}, info.acc_begin});
    window_ = d.v;
  }

  void leave_group(Word w) {
    const Group group = groups_.back();
    groups_.pop_back();
    window_ = group.outer;
    if (group.skip_from == none)
      out_.push_back(w);
    else
      skip_from_ = group.skip_from;
  }

  const Tape& tape_;
  std::span<const Word> code_;
  const std::vector<Ranges>& ranges_;
  int lane_;
  std::vector<Word>& out_;
  Window window_;
  std::vector<Group> groups_;
  std::uint32_t skip_from_ = none;
};

}  // namespace

void prune(const Tape& tape, std::span<const Word> code, const std::vector<Ranges>& ranges,
           int lane, std::vector<Word>& out) {
  Pruner(tape, code, ranges, lane, out).run();
}

}  // namespace penumbra::sdf
