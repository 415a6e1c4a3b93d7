// The loops over rays: lanes take a new ray when enough of them are done. Included once per SIMD
// target.
#if defined(PENUMBRA_SDF_MARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_SDF_MARCH_INL_H
#undef PENUMBRA_SDF_MARCH_INL_H
#else
#define PENUMBRA_SDF_MARCH_INL_H
#endif

#include <cmath>

#include "sdf/sampler-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::sdf::HWY_NAMESPACE {

constexpr std::uint32_t all_lanes = 0xffff;
/// Idle lanes that make it worth while to fetch new rays.
constexpr int refill_at = 6;

/// Sixteen rays on their way.
struct Way {
  P o, d;
  F t, t_max;
};

struct LaneArrays {
  HWY_ALIGN float ox[lanes], oy[lanes], oz[lanes], dx[lanes], dy[lanes], dz[lanes], t[lanes],
      t_max[lanes];
  Way load_all() const {
    return {{load(ox), load(oy), load(oz)}, {load(dx), load(dy), load(dz)}, load(t), load(t_max)};
  }
};

/// No value is above this a `way` along the ray from p, where it is h. With room for rounding.
HWY_INLINE F most_after(const FieldData& field, const F& h, const F& way, const P& p) {
  if (!field.tape.warnings.empty()) return 1e30f;  // perhaps steeper than 1
  const F size = max(abs(p.x), max(abs(p.y), abs(p.z)));
  return mad(abs(h) + abs(way), 1.0001f, size * 1e-5f);
}

/// Method: Ray type; begin(lane, ray) puts its own state into arrays; reload() takes that over;
/// step(way, h, active) moves on and gives the lanes that are done; finish(lane, number).
template <class Method>
void march(const FieldData& field, std::span<const typename Method::Ray> rays, int step_limit,
           Method& method) {
  Sampler sampler(field);
  LaneArrays arrays = {};
  std::size_t number[lanes] = {}, next = 0;
  std::uint32_t active = 0;
  HWY_ALIGN float counts[lanes];
  Way way = arrays.load_all();
  F steps = 0.0f, most = 1e30f;
  HWY_ALIGN float mosts[lanes];
  const F limit = static_cast<float>(step_limit);
  while (true) {
    if (next < rays.size() && std::popcount(active) <= lanes - refill_at) {
      store(way.t, arrays.t), store(steps, counts), store(most, mosts);
      method.save();
      for (std::uint32_t idle = ~active & all_lanes; idle && next < rays.size(); ++next) {
        if (!method.wants(rays[next], next)) continue;
        const int lane = std::countr_zero(idle);
        idle &= idle - 1;
        const auto& ray = rays[next];
        arrays.ox[lane] = ray.origin.x, arrays.oy[lane] = ray.origin.y,
        arrays.oz[lane] = ray.origin.z;
        arrays.dx[lane] = ray.direction.x, arrays.dy[lane] = ray.direction.y,
        arrays.dz[lane] = ray.direction.z;
        method.begin(lane, ray, arrays.t[lane], arrays.t_max[lane]);
        counts[lane] = 0, mosts[lane] = 1e30f;
        number[lane] = next;
        active |= 1u << lane;
      }
      way = arrays.load_all(), steps = load(counts), most = load(mosts);
      method.load();
    }
    if (active == 0) break;
    const P p{mad(way.t, way.d.x, way.o.x), mad(way.t, way.d.y, way.o.y),
              mad(way.t, way.d.z, way.o.z)};
    const F h = sampler.distance(p, active, most), t = way.t;
    steps = steps + 1.0f;
    std::uint32_t done = method.step(way, h) & active;
    most = most_after(field, h, way.t - t, p);
    const std::uint32_t out = bits(steps >= limit) & active & ~done;
    if (HWY_LIKELY((done | out) == 0)) continue;
    method.keep(way, steps);
    for (std::uint32_t b = done | out; b; b &= b - 1) {
      const int lane = std::countr_zero(b);
      method.finish(lane, number[lane], out >> lane & 1);
    }
    active &= ~(done | out);
  }
}

/// Sphere tracing; `Any` stops at the first sign of a surface.
template <bool Any>
class Tracer {
 public:
  using Ray = MarchRay;
  explicit Tracer(std::span<MarchHit> out) : out_(out) {}

  bool wants(const Ray& ray, std::size_t i) {
    if (ray.t_min <= ray.t_max) return true;
    out_[i] = {ray.t_max, 0, false, false};
    return false;
  }
  void begin(int lane, const Ray& ray, float& t, float& t_max) {
    t = ray.t_min, t_max = ray.t_max;
    a_[lane] = ray.t_min, fa_[lane] = 0, slope_[lane] = -1, fb_[lane] = 0;
    scale_[lane] =
        3e-7f * std::max({std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)});
  }
  void save() { store(a, a_), store(fa, fa_), store(slope, slope_), store(b, b_), store(fb, fb_); }
  void load() {
    a = HWY_NAMESPACE::load(a_), fa = HWY_NAMESPACE::load(fa_);
    slope = HWY_NAMESPACE::load(slope_), b = HWY_NAMESPACE::load(b_);
    fb = HWY_NAMESPACE::load(fb_), scale = HWY_NAMESPACE::load(scale_);
  }

  // a: the last place known to be free, fa its distance (0: none yet); b, fb < 0: a place inside,
  // once known (fb = 0: not yet). scale: the rounding of positions at the origin.
  HWY_INLINE std::uint32_t step(Way& w, const F& h) {
    const F zero = 0.0f, epsilon = mad(w.t, 2e-7f, scale);
    const F way = w.t - a;
    const M narrowing = fb < zero;
    // Nothing lies between two places whose spheres meet. Shorter ways than a ten-thousandth of
    // the distance seen are taken on trust, so that grazing rays arrive.
    const M tiny = fa < F(1e-4f) * w.t;
    const M apart = and_not(narrowing, way > mad(abs(h) + fa, 1.000001f, epsilon));
    const M inside = h < zero;
    const M failed = and_not(tiny & inside, apart);
    const M touches = and_not(failed, abs(h) <= epsilon);
    const M crossed = and_not(failed, inside);

    if (Any) {
      const M miss = and_not(failed | crossed | touches, w.t + h >= w.t_max);
      hits = bits(touches | crossed);
      forward(w, h, way, failed);
      return hits | bits(miss);
    }
    const M miss = and_not(failed | crossed | touches | narrowing, w.t + h >= w.t_max);
    const M start = fa <= zero;  // inside from the start
    if (HWY_LIKELY(!any(crossed | narrowing))) {
      hits = bits(touches);
      place = w.t;
      forward(w, h, way, failed);
      return hits | bits(miss);
    }
    return narrow(w, h, way, failed, touches, crossed, narrowing, miss, start, epsilon);
  }

  void keep(const Way&, const F& steps) { store(place, at_), store(steps, steps_); }
  void finish(int lane, std::size_t i, bool out_of_steps) {
    const bool is_hit = !out_of_steps && (hits >> lane & 1);
    out_[i] = {at_[lane], static_cast<std::uint16_t>(steps_[lane]), is_hit, out_of_steps};
  }

 private:
  // On from w.t, or back to a plain step from a.
  HWY_INLINE void forward(Way& w, const F& h, const F& way, const M& failed) {
    const M first = fa <= F(0.0f);
    const F seen = select(first, -1.0f, clamp((h - fa) / max(way, 1e-30f), -1.0f, 0.95f));
    const F mean = mad(seen - slope, 0.7f, slope);
    const F touching = h * (2.0f / (1.0f - mean));
    const F root = h * (1.02f / max(-mean, 1.0f / 64));
    const F longer = select((h < F(1e-4f) * w.t) & (mean < F(0.0f)), max(root, h), touching);
    const F plain = fa;
    slope = select(failed, -1.0f, mean);
    a = select(failed, a, w.t);
    fa = select(failed, fa, h);
    const F length = select(failed, plain, max(longer, h));
    w.t = min(a + length, max(w.t_max, a));
  }

  HWY_NOINLINE std::uint32_t narrow(Way& w, const F& h, const F& way, const M& failed,
                                    const M& touches, const M& crossed, const M& narrowing,
                                    const M& miss, const M& start, const F& epsilon) {
    const M busy = narrowing | crossed;
    const F here = w.t;
    const Tracer before = *this;
    Way moved = w;
    forward(moved, h, way, failed);
    // False position; the end that stays counts half the next time (Illinois).
    const M outside = and_not(crossed, narrowing);
    const F na = select(outside, here, before.a), nb = select(crossed, here, before.b);
    F nfa = select(outside, h, before.fa), nfb = select(crossed, h, before.fb);
    nfa = select(crossed & narrowing, nfa * 0.5f, nfa);
    nfb = select(outside, nfb * 0.5f, nfb);
    const F t = na + (nb - na) * (nfa / (nfa - nfb));
    const M closed = busy & (nb - na <= epsilon);
    a = select(busy, na, a), fa = select(busy, nfa, fa);
    b = select(busy, nb, before.b), fb = select(busy, nfb, before.fb);
    w.t = select(busy, t, moved.t);
    const M from_inside = crossed & start & (before.fb >= F(0.0f));
    const M hit = touches | closed | from_inside;
    place = select(closed, t, here);
    hits = bits(hit);
    return hits | bits(miss);
  }

  F a, fa, slope, b, fb, scale, place;
  std::uint32_t hits = 0;
  std::span<MarchHit> out_;
  HWY_ALIGN float a_[lanes] = {}, fa_[lanes] = {}, slope_[lanes] = {}, b_[lanes] = {},
                  fb_[lanes] = {}, scale_[lanes] = {}, at_[lanes] = {}, steps_[lanes] = {};
};

/// What the published loops share.
class ShadowState {
 public:
  using Ray = ShadowRay;
  explicit ShadowState(const ShadowOptions& options, std::span<ShadowResult> out)
      : options_(options), out_(out) {}

  bool wants(const Ray& ray, std::size_t i) {
    out_[i] = {};
    return ray.mint < ray.maxt;
  }
  void begin(int lane, const Ray& ray, float& t, float& t_max) {
    t = ray.mint, t_max = ray.maxt;
    w_[lane] = ray.w, res_[lane] = 1, ph_[lane] = 1e20f;
  }
  void save() { store(res, res_), store(ph, ph_); }
  void load() {
    w = HWY_NAMESPACE::load(w_), res = HWY_NAMESPACE::load(res_), ph = HWY_NAMESPACE::load(ph_);
  }
  void keep(const Way&, const F& steps) { store(res, res_), store(steps, steps_); }

 protected:
  void write(int lane, std::size_t i, float fraction, bool out_of_steps) {
    out_[i] = {fraction, static_cast<std::uint16_t>(steps_[lane]), out_of_steps};
  }
  const ShadowOptions& options_;
  std::span<ShadowResult> out_;
  F w, res, ph;
  HWY_ALIGN float w_[lanes] = {}, res_[lanes] = {}, ph_[lanes] = {}, steps_[lanes] = {};
};

template <ShadowMarch Kind>
class Shadow : public ShadowState {
 public:
  using ShadowState::ShadowState;

  HWY_INLINE std::uint32_t step(Way& way, const F& h) {
    if constexpr (Kind == ShadowMarch::hard) return hard(way, h);
    if constexpr (Kind == ShadowMarch::classic) return classic(way, h);
    if constexpr (Kind == ShadowMarch::improved) return improved(way, h);
    if constexpr (Kind == ShadowMarch::blog) return blog(way, h);
    if constexpr (Kind == ShadowMarch::inner)
      return inner(way, h, options_.least_step, options_.most_step);
    return inner_abs(way, h);
  }
  void finish(int lane, std::size_t i, bool out_of_steps) {
    float s = res_[lane];
    if (Kind == ShadowMarch::inner || Kind == ShadowMarch::inner_abs) {
      s = std::max(s, -1.0f);
      s = 0.25f * (1 + s) * (1 + s) * (2 - s);
    }
    write(lane, i, s, out_of_steps);
  }

 private:
  HWY_INLINE std::uint32_t hard(Way& way, const F& h) {
    const M dark = h < F(options_.hit);
    res = select(dark, 0.0f, res);
    way.t = way.t + h;
    return bits(dark | (way.t >= way.t_max));
  }
  // Lanes without light, w = 0, keep res: h / 0 is infinite.
  HWY_INLINE std::uint32_t classic(Way& way, const F& h) {
    const M dark = h < F(options_.hit);
    res = select(dark, 0.0f, min(res, h / (w * way.t)));
    way.t = way.t + h;
    return bits(dark | (way.t >= way.t_max));
  }
  HWY_INLINE std::uint32_t improved(Way& way, const F& h) {
    const M dark = h < F(options_.hit);
    const F y = h * h / (2.0f * ph);
    const F d = sqrt(h * h - y * y), ahead = way.t - y;
    const M holds = (y < h) & (ahead > F(0.0f));
    const F ratio = select(holds, d, h) / (w * select(holds, ahead, way.t));
    res = select(dark, 0.0f, min(res, ratio));
    ph = h;
    way.t = way.t + h;
    return bits(dark | (way.t >= way.t_max));
  }
  HWY_INLINE std::uint32_t blog(Way& way, const F& h) {
    way.t = way.t + h;
    const M dark = h < F(options_.blog_hit);
    res = select(dark, 0.0f, min(res, h / (way.t * w)));
    return bits(dark | (way.t >= way.t_max));
  }
  HWY_INLINE std::uint32_t inner(Way& way, const F& h, float least, float most) {
    res = min(res, h / (w * way.t));
    way.t = way.t + clamp(h, least, most);
    return bits((res < F(-1.0f)) | (way.t >= way.t_max));
  }
  HWY_INLINE std::uint32_t inner_abs(Way& way, const F& h) {
    res = min(res, h / (w * way.t));
    way.t = way.t + abs(h);
    return bits((res < F(-1.0f)) | (way.t >= way.t_max));
  }
};

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
