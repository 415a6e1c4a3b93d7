// Sums of what the samples give to the texels they reach. Included once per SIMD target.
#include "bake/raster_kernels.h"

// Per-target include guard.
#if defined(PENUMBRA_BAKE_ACCUMULATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_BAKE_ACCUMULATE_INL_H_
#undef PENUMBRA_BAKE_ACCUMULATE_INL_H_
#else
#define PENUMBRA_BAKE_ACCUMULATE_INL_H_
#endif

#include "bake/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::bake::HWY_NAMESPACE {

template <Falloff falloff>
HWY_INLINE F weight_of(F r2, F a, F scale, F k) {
  switch (falloff) {
    case Falloff::surface:
      return hn::Div(hn::Mul(scale, hn::Max(a, all(0))), hn::Mul(r2, hn::Add(r2, k)));
    case Falloff::two_sided:
      return hn::Div(hn::Mul(scale, hn::Abs(a)), hn::Mul(r2, hn::Add(r2, k)));
    case Falloff::strip: {
      const F across = hn::Sqrt(hn::Max(hn::NegMulAdd(a, a, r2), all(0)));
      return hn::Div(hn::Mul(scale, across), hn::Mul(r2, hn::Add(r2, k)));
    }
    case Falloff::point:
      return hn::Div(scale, hn::Mul(r2, hn::Sqrt(r2)));
    case Falloff::solid_angle:
      return hn::Div(hn::Mul(scale, hn::Max(a, all(0))), hn::Mul(r2, hn::Sqrt(r2)));
    case Falloff::turned:
      return hn::IfThenElseZero(hn::Gt(a, all(0)), scale);
    case Falloff::constant:
      return scale;
  }
}

/// Bits of one vector's texels → lanes where none is set.
HWY_INLINE M clear_lanes(std::uint32_t bits) {
  HWY_ALIGN static constexpr std::int32_t powers[8] = {1, 2, 4, 8, 16, 32, 64, 128};
  const I here = hn::And(hn::Set(DI(), static_cast<std::int32_t>(bits)), hn::Load(DI(), powers));
  return hn::RebindMask(D(), hn::Eq(here, hn::Zero(DI())));
}

template <Falloff falloff, bool with_whole>
class Accumulator {
 public:
  explicit Accumulator(const TexelWeights& w)
      : w_(w),
        along2_(dot(w.step_x, w.step_x)),
        slope_(dot(w.normal, w.step_x)),
        scale_(all(w.scale)),
        k_(all(w.k)) {}

  void row(int j, int width, const std::uint64_t* bits, float* lit, float* whole) {
    // r² = along² (i − middle)² + nearest²: a sum of squares keeps its digits near the foot point.
    const Vec3 d = w_.first + w_.step_y * static_cast<float>(j);
    const float middle = along2_ > 0 ? -dot(d, w_.step_x) / along2_ : 0.0f;
    const Vec3 foot = d + w_.step_x * middle;
    middle_ = all(middle);
    nearest2_ = all(std::max(dot(foot, foot), 1e-12f));
    start_ = all(dot(w_.normal, d));
    for (int i = 0; i < width; i += 64) {
      const std::uint64_t word = bits ? *bits++ : 0;
      if (!with_whole && word == ~std::uint64_t{0}) continue;
      const int end = std::min(i + 64, width);
      if (word == 0)
        add_clear(i, end, lit, whole);
      else
        add_masked(i, end, word, lit, whole);
    }
  }

 private:
  HWY_INLINE F weight(int i) const {
    const F at = hn::Iota(D(), static_cast<float>(i));
    const F off = hn::Sub(at, middle_);
    const F r2 = hn::MulAdd(hn::Mul(off, off), all(along2_), nearest2_);
    return weight_of<falloff>(r2, hn::MulAdd(at, all(slope_), start_), scale_, k_);
  }
  HWY_INLINE static void add(F value, float* to) { hn::StoreU(hn::Add(load(to), value), D(), to); }
  HWY_INLINE void add_clear(int i, int end, float* lit, float* whole) const {
    for (; i < end; i += static_cast<int>(lanes)) {
      const F value = weight(i);
      add(value, lit + i);
      if (with_whole) add(value, whole + i);
    }
  }
  HWY_INLINE void add_masked(int i, int end, std::uint64_t word, float* lit, float* whole) const {
    constexpr std::uint32_t every = (1u << lanes) - 1;
    for (; i < end; i += static_cast<int>(lanes), word >>= lanes) {
      const std::uint32_t bits = static_cast<std::uint32_t>(word) & every;
      if (!with_whole && bits == every) continue;
      const F value = weight(i);
      add(hn::IfThenElseZero(clear_lanes(bits), value), lit + i);
      if (with_whole) add(value, whole + i);
    }
  }

  const TexelWeights& w_;
  float along2_, slope_;
  F scale_, k_;
  F middle_, nearest2_, start_;
};

template <Falloff falloff, bool with_whole>
void accumulate_rows(const TexelWeights& weights, const BitRaster* occluded, TexelSums& lit,
                     TexelSums* whole) {
  Accumulator<falloff, with_whole> rows(weights);
  for (int j = 0; j < lit.height; ++j)
    rows.row(j, lit.width, occluded ? occluded->row(j) : nullptr, lit.row(j),
             with_whole ? whole->row(j) : nullptr);
}

template <bool with_whole>
void accumulate_by(const TexelWeights& weights, const BitRaster* occluded, TexelSums& lit,
                   TexelSums* whole) {
  switch (weights.falloff) {
    case Falloff::surface:
      return accumulate_rows<Falloff::surface, with_whole>(weights, occluded, lit, whole);
    case Falloff::two_sided:
      return accumulate_rows<Falloff::two_sided, with_whole>(weights, occluded, lit, whole);
    case Falloff::strip:
      return accumulate_rows<Falloff::strip, with_whole>(weights, occluded, lit, whole);
    case Falloff::point:
      return accumulate_rows<Falloff::point, with_whole>(weights, occluded, lit, whole);
    case Falloff::solid_angle:
      return accumulate_rows<Falloff::solid_angle, with_whole>(weights, occluded, lit, whole);
    case Falloff::turned:
      return accumulate_rows<Falloff::turned, with_whole>(weights, occluded, lit, whole);
    case Falloff::constant:
      return accumulate_rows<Falloff::constant, with_whole>(weights, occluded, lit, whole);
  }
}

void accumulate_in(const TexelWeights& weights, const BitRaster* occluded, TexelSums& lit,
                   TexelSums* whole) {
  if (whole)
    accumulate_by<true>(weights, occluded, lit, whole);
  else
    accumulate_by<false>(weights, occluded, lit, nullptr);
}

void normalise_in(TexelSums& sums, const TexelSums& whole, const TexelSums* by) {
  for (std::size_t i = 0; i < sums.values.size(); i += lanes) {
    const F all_of_it = load(&whole.values[i]), sum = load(&sums.values[i]);
    const F scaled = by ? hn::Mul(sum, load(&by->values[i])) : sum;
    const M any = hn::Gt(all_of_it, all(0));
    hn::StoreU(hn::IfThenElseZero(any, hn::Div(scaled, all_of_it)), D(), &sums.values[i]);
  }
}

void emit_in(const TexelSums& sums, const Vec3& emission, bool add, Vec3* out, std::size_t stride) {
  const F r = all(emission.x), g = all(emission.y), b = all(emission.z);
  const int whole_vectors = sums.width / static_cast<int>(lanes) * static_cast<int>(lanes);
  for (int j = 0; j < sums.height; ++j) {
    const float* row = sums.row(j);
    Vec3* to = out + stride * static_cast<std::size_t>(j);
    for (int i = 0; i < whole_vectors; i += static_cast<int>(lanes)) {
      const F e = load(row + i);
      F x = hn::Mul(e, r), y = hn::Mul(e, g), z = hn::Mul(e, b);
      if (add) {
        F ox, oy, oz;
        hn::LoadInterleaved3(D(), &to[i].x, ox, oy, oz);
        x = hn::Add(x, ox), y = hn::Add(y, oy), z = hn::Add(z, oz);
      }
      hn::StoreInterleaved3(x, y, z, D(), &to[i].x);
    }
    for (int i = whole_vectors; i < sums.width; ++i)
      to[i] = add ? to[i] + emission * row[i] : emission * row[i];
  }
}

}  // namespace penumbra::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
