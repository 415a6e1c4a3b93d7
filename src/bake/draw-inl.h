// Triangles into bits. Included once per SIMD target.
#include "bake/raster_kernels.h"

// Per-target include guard.
#if defined(PENUMBRA_BAKE_DRAW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_BAKE_DRAW_INL_H_
#undef PENUMBRA_BAKE_DRAW_INL_H_
#else
#define PENUMBRA_BAKE_DRAW_INL_H_
#endif

#include "bake/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::bake::HWY_NAMESPACE {

/// Triangles ready to be filled, eight side by side: corners sorted by y, then x, so that an edge
/// is the same line for both of its triangles. At row r the long edge, from the first corner to the
/// last, is at x[0] + (r − y[0]) slope[0], the two short ones likewise.
struct Edges {
  HWY_ALIGN float x[3][8], y[3][8], slope[3][8];
  HWY_ALIGN std::int32_t first[8], last[8];  ///< rows
  HWY_ALIGN float short_is_left[8];          ///< 1 or 0
  HWY_ALIGN std::int32_t from[8], to[8];     ///< words of a row that it may reach
};

class Drawer {
 public:
  Drawer(const TriangleList& triangles, const Projection& projection, BitRaster& raster,
         std::vector<std::uint32_t>& awkward)
      : triangles_(triangles), m_(projection), raster_(raster), awkward_(awkward) {}

  bool draw() {
    for (std::size_t i = 0; i < triangles_.count; i += lanes) draw_vector(i);
    return any_;
  }

 private:
  struct Projected {
    F x, y, w;
  };

  HWY_INLINE Projected project(std::size_t i, int corner) const {
    const auto& c = triangles_.corner[corner];
    const F x = hn::Sub(load(&c[0][i]), all(m_.origin.x));
    const F y = hn::Sub(load(&c[1][i]), all(m_.origin.y));
    const F z = hn::Sub(load(&c[2][i]), all(m_.origin.z));
    return {affine(m_.x, m_.x_0, x, y, z), affine(m_.y, m_.y_0, x, y, z),
            affine(m_.w, m_.w_0, x, y, z)};
  }

  HWY_INLINE static F least(F a, F b, F c) { return hn::Min(a, hn::Min(b, c)); }
  HWY_INLINE static F greatest(F a, F b, F c) { return hn::Max(a, hn::Max(b, c)); }

  void draw_vector(std::size_t first) {
    const Projected a = project(first, 0), b = project(first, 1), c = project(first, 2);
    const F right = all(static_cast<float>(raster_.width() - 1) + edge_slack);
    const F above = all(static_cast<float>(raster_.height() - 1));
    const F zero = all(0), slack = all(edge_slack);
    // Wholly beyond one side of the pyramid, or over the apex: true for any signs of w.
    M in = hn::FirstN(D(), triangles_.count - first);
    in = hn::And(in, hn::Gt(greatest(a.w, b.w, c.w), all(m_.least_w)));
    in = hn::And(in, hn::Ge(greatest(hn::MulAdd(slack, a.w, a.x), hn::MulAdd(slack, b.w, b.x),
                                     hn::MulAdd(slack, c.w, c.x)),
                            zero));
    in = hn::And(in, hn::Ge(greatest(a.y, b.y, c.y), zero));
    in = hn::And(in, hn::Le(least(hn::NegMulAdd(right, a.w, a.x), hn::NegMulAdd(right, b.w, b.x),
                                  hn::NegMulAdd(right, c.w, c.x)),
                            zero));
    in = hn::And(in, hn::Le(least(hn::NegMulAdd(above, a.w, a.y), hn::NegMulAdd(above, b.w, b.y),
                                  hn::NegMulAdd(above, c.w, c.y)),
                            zero));
    if (hn::AllFalse(D(), in)) return;
    const F one = all(1);
    const F ia = hn::Div(one, a.w), ib = hn::Div(one, b.w), ic = hn::Div(one, c.w);
    F x[3] = {hn::Mul(a.x, ia), hn::Mul(b.x, ib), hn::Mul(c.x, ic)};
    F y[3] = {hn::Mul(a.y, ia), hn::Mul(b.y, ib), hn::Mul(c.y, ic)};
    const F size = hn::Max(greatest(hn::Abs(x[0]), hn::Abs(x[1]), hn::Abs(x[2])),
                           greatest(hn::Abs(y[0]), hn::Abs(y[1]), hn::Abs(y[2])));
    const M plain =
        hn::And(hn::Gt(least(a.w, b.w, c.w), all(m_.least_w)), hn::Le(size, all(guard_band)));
    for (std::uint32_t bits = bits_of(hn::AndNot(plain, in)); bits != 0; bits &= bits - 1)
      awkward_.push_back(static_cast<std::uint32_t>(first) +
                         static_cast<std::uint32_t>(std::countr_zero(bits)));
    fill_plain(x, y, hn::And(plain, in));
  }

  HWY_INLINE static void sort_two(F& xa, F& ya, F& xb, F& yb) {
    const M swap = hn::Or(hn::Gt(ya, yb), hn::And(hn::Eq(ya, yb), hn::Gt(xa, xb)));
    const F x = hn::IfThenElse(swap, xb, xa), y = hn::IfThenElse(swap, yb, ya);
    xb = hn::IfThenElse(swap, xa, xb), yb = hn::IfThenElse(swap, ya, yb);
    xa = x, ya = y;
  }

  HWY_INLINE void fill_plain(F x[3], F y[3], M in) {
    sort_two(x[0], y[0], x[1], y[1]);
    sort_two(x[1], y[1], x[2], y[2]);
    sort_two(x[0], y[0], x[1], y[1]);
    const F first = hn::Max(hn::Ceil(y[0]), all(0));
    const F last = hn::Min(hn::Floor(y[2]), all(static_cast<float>(raster_.height() - 1)));
    const F slack = all(edge_slack), right = all(static_cast<float>(raster_.width() - 1));
    const F from = hn::Max(hn::Ceil(hn::Sub(least(x[0], x[1], x[2]), slack)), all(0));
    const F to = hn::Min(hn::Floor(hn::Add(greatest(x[0], x[1], x[2]), slack)), right);
    // Between two rows, or between two columns: nothing to fill.
    in = hn::And(in, hn::And(hn::Le(first, last), hn::Le(from, to)));
    std::uint32_t bits = bits_of(in);
    if (bits == 0) return;
    const F rise[3] = {hn::Sub(y[2], y[0]), hn::Sub(y[1], y[0]), hn::Sub(y[2], y[1])};
    const F run[3] = {hn::Sub(x[2], x[0]), hn::Sub(x[1], x[0]), hn::Sub(x[2], x[1])};
    // Is the middle corner left of the long edge? Without a division.
    const M left = hn::Lt(hn::Mul(run[1], rise[0]), hn::Mul(run[0], rise[1]));
    const F nowhere = hn::IfThenElse(left, all(-1e30f), all(1e30f));
    Edges e;
    for (int k = 0; k < 3; ++k) {
      // A level edge bounds no row; the other short one does.
      const M level = hn::Le(rise[k], all(1e-6f));
      const int start = k == 2 ? 1 : 0;
      hn::Store(hn::IfThenElseZero(hn::Not(level), hn::Div(run[k], rise[k])), D(), e.slope[k]);
      hn::Store(hn::IfThenElse(level, k == 0 ? x[0] : nowhere, x[start]), D(), e.x[k]);
      hn::Store(y[start], D(), e.y[k]);
    }
    hn::Store(hn::IfThenElseZero(left, all(1)), D(), e.short_is_left);
    hn::Store(hn::ConvertTo(DI(), first), DI(), e.first);
    hn::Store(hn::ConvertTo(DI(), last), DI(), e.last);
    hn::Store(hn::ShiftRight<6>(hn::ConvertTo(DI(), from)), DI(), e.from);
    hn::Store(hn::ShiftRight<6>(hn::ConvertTo(DI(), to)), DI(), e.to);
    any_ = true;
    for (; bits != 0; bits &= bits - 1) {
      const auto t = static_cast<std::size_t>(std::countr_zero(bits));
      if (e.from[t] == e.to[t])
        fill_word(e, t);
      else
        fill_words(e, t);
    }
  }

  /// The texels between the edges in some rows, from `low` to `high`, as whole numbers.
  struct Ends {
    F first, last;
  };
  HWY_INLINE static Ends ends(const Edges& e, std::size_t t, F rows, F low, F high) {
    F x[3];
    for (int k = 0; k < 3; ++k)
      x[k] = hn::MulAdd(hn::Sub(rows, all(e.y[k][t])), all(e.slope[k][t]), all(e.x[k][t]));
    const bool left = e.short_is_left[t] != 0;
    const F bent = left ? hn::Max(x[1], x[2]) : hn::Min(x[1], x[2]);
    const F a = hn::Max(hn::Sub(left ? bent : x[0], all(edge_slack)), low);
    const F b = hn::Min(hn::Add(left ? x[0] : bent, all(edge_slack)), high);
    return {hn::Ceil(a), hn::Floor(b)};
  }

  static constexpr int half = lanes > 4 ? 4 : static_cast<int>(lanes);

  /// Of a triangle within one word of each row, as most are, without a branch on its shape.
  HWY_INLINE void fill_word(const Edges& e, std::size_t t) {
    const int first = e.first[t], word = e.from[t];
    const F low = all(static_cast<float>(64 * word));
    const F high = all(static_cast<float>(std::min(64 * word + 63, raster_.width() - 1)));
    const F end = all(static_cast<float>(e.last[t]));
    std::uint64_t* at = raster_.row(first) + word;
    const std::ptrdiff_t step = raster_.words();
    HWY_ALIGN std::int32_t from[8], to[8];
    for (int r = first; r <= e.last[t]; r += static_cast<int>(lanes)) {
      const F rows = hn::Iota(D(), static_cast<float>(r));
      const Ends x = ends(e, t, rows, low, high);
      const M any = hn::And(hn::Le(x.first, x.last), hn::Le(rows, end));
      // Of an empty row the first is past the last, and so the bits between them none.
      const F a = hn::IfThenElse(any, hn::Sub(x.first, low), all(63));
      const F b = hn::IfThenElseZero(any, hn::Sub(x.last, low));
      hn::Store(hn::ConvertTo(DI(), a), DI(), from);
      hn::Store(hn::ConvertTo(DI(), b), DI(), to);
      at = or_rows<0, half>(at, step, from, to);
      // The raster has rows to spare.
      if (lanes > half && r + half <= e.last[t]) at = or_rows<half, half>(at, step, from, to);
    }
  }

  template <int first, int count>
  HWY_INLINE static std::uint64_t* or_rows(std::uint64_t* at, std::ptrdiff_t step,
                                           const std::int32_t* from, const std::int32_t* to) {
    for (int k = first; k < first + count; ++k, at += step)
      *at |= ((std::uint64_t{2} << to[k]) - 1) & (~std::uint64_t{0} << from[k]);
    return at;
  }

  HWY_INLINE void fill_words(const Edges& e, std::size_t t) {
    const F low = all(0), high = all(static_cast<float>(raster_.width() - 1));
    const int first = e.first[t], last = e.last[t];
    std::uint64_t* row = raster_.row(first);
    HWY_ALIGN std::int32_t from[8], to[8];
    for (int r = first; r <= last; r += static_cast<int>(lanes)) {
      const Ends x = ends(e, t, hn::Iota(D(), static_cast<float>(r)), low, high);
      // Without an upper limit on the first nor a lower one on the last: they stay ordered.
      hn::Store(hn::ConvertTo(DI(), hn::Min(x.first, all(1e6f))), DI(), from);
      hn::Store(hn::ConvertTo(DI(), hn::Max(x.last, all(-1e6f))), DI(), to);
      const int count = std::min(static_cast<int>(lanes), last - r + 1);
      for (int k = 0; k < count; ++k, row += raster_.words())
        if (from[k] <= to[k]) BitRaster::fill(row, from[k], to[k]);
    }
  }

  const TriangleList& triangles_;
  const Projection& m_;
  BitRaster& raster_;
  std::vector<std::uint32_t>& awkward_;
  bool any_ = false;
};

bool draw_in(const TriangleList& triangles, const Projection& projection, BitRaster& raster,
             std::vector<std::uint32_t>& awkward) {
  return Drawer(triangles, projection, raster, awkward).draw();
}

}  // namespace penumbra::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
