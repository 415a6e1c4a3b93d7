// The shafts round four queries that follow one another, round four such groups, and so on up to
// one round all of them, eight shafts at a time. Included once per SIMD target.
#if defined(PENUMBRA_CONE_SHAFTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_CONE_SHAFTS_INL_H
#undef PENUMBRA_CONE_SHAFTS_INL_H
#else
#define PENUMBRA_CONE_SHAFTS_INL_H
#endif

#include <vector>

#include "geometry/cone_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::HWY_NAMESPACE {

/// Two corners of a box, or of boxes side by side.
struct Box {
  Point lo, hi;
};

HWY_INLINE Point min(const Point& a, const Point& b) {
  return {hn::Min(a.x, b.x), hn::Min(a.y, b.y), hn::Min(a.z, b.z)};
}
HWY_INLINE Point max(const Point& a, const Point& b) {
  return {hn::Max(a.x, b.x), hn::Max(a.y, b.y), hn::Max(a.z, b.z)};
}
HWY_INLINE Point plus(const Point& a, const Point& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Point minus(const Point& a, const Point& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Point times(const Point& a, Floats s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
HWY_INLINE Floats dot(const Point& a, const Point& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Box join(const Box& a, const Box& b) { return {min(a.lo, b.lo), max(a.hi, b.hi)}; }
HWY_INLINE Point middle(const Box& b) { return times(plus(b.lo, b.hi), all(0.5f)); }

/// What a shaft is made of, for a vector of groups.
struct ShaftParts {
  Box from, to, normals;
  Floats epsilon, lift;
};

HWY_INLINE ShaftParts join(const ShaftParts (&of)[4]) {
  ShaftParts out = of[0];
  for (int k = 1; k < 4; ++k) {
    out.from = join(out.from, of[k].from), out.to = join(out.to, of[k].to);
    out.normals = join(out.normals, of[k].normals);
    out.epsilon = hn::Min(out.epsilon, of[k].epsilon);
  }
  // The center is moved: a horizon sees it higher by at most what its normal makes of the way.
  const Point center = middle(out.from);
  out.lift = all(-infinite);
  for (const ShaftParts& part : of) {
    const Point way = minus(center, middle(part.from));
    const Point a = {hn::Mul(part.normals.lo.x, way.x), hn::Mul(part.normals.lo.y, way.y),
                     hn::Mul(part.normals.lo.z, way.z)};
    const Point b = {hn::Mul(part.normals.hi.x, way.x), hn::Mul(part.normals.hi.y, way.y),
                     hn::Mul(part.normals.hi.z, way.z)};
    const Point most = max(a, b);
    out.lift = hn::Max(out.lift, hn::Add(part.lift, hn::Add(most.x, hn::Add(most.y, most.z))));
  }
  return out;
}

/// All shafts of a batch. Kept for the next batch, for its memory.
class ConeShafts {
 public:
  /// `bounds`: of everything in the tree. At least one query.
  void build(const ConeBatch& queries, const Bounds& bounds) {
    const Lanes d;
    const std::size_t n = hn::Lanes(d);
    endless_ = std::isinf(queries.column(ConeBatch::distance)[0]);
    bounds_ = &bounds;
    std::size_t count = (queries.size() + 3) / 4;
    for (levels_ = 0;; ++levels_, count = (count + 3) / 4) {
      if (static_cast<std::size_t>(levels_) == level_.size()) level_.emplace_back();
      Level& level = level_[levels_];
      level.clear(count, n);
      for (std::size_t first = 0; first < count; first += n)
        store(level, first,
              levels_ == 0 ? parts_of(queries, first) : parts_of(level_[levels_ - 1], first));
      if (count == 1) break;
    }
  }

  /// The level of the shaft round everything, at which it is alone; at level l a shaft is round
  /// 4^(l + 1) queries, fewer at the end.
  int top() const { return levels_; }
  std::size_t size(int level) const { return level_[level].count; }

  HWY_INLINE ConeShaft shaft(int level, std::size_t i) const {
    const Level& from = level_[level];
    const auto vector = [&](int column) {
      return Vec3{from.column(column)[i], from.column(column + 1)[i], from.column(column + 2)[i]};
    };
    ConeShaft out;
    out.from_lo = vector(outer_from), out.from_hi = vector(outer_from + 3);
    for (int axis = 0; axis < 3; ++axis) {
      out.inv_lo[axis] = from.column(inverse + axis)[i];
      out.inv_hi[axis] = from.column(inverse + 3 + axis)[i];
      out.lo_is_near[axis] = out.inv_lo[axis] > 0, out.hi_is_far[axis] = out.inv_hi[axis] > 0;
    }
    out.reach = from.column(reach)[i];
    out.center = (vector(box_from) + vector(box_from + 3)) * 0.5f;
    out.normal_lo = vector(box_normals), out.normal_hi = vector(box_normals + 3);
    out.lift = from.column(lift)[i];
    // Half of it: what sums round away must not hide what a single query would see.
    out.epsilon = from.column(epsilon)[i] / 2;
    return out;
  }

 private:
  enum Column {
    box_from = 0,
    box_to = 6,
    box_normals = 12,
    epsilon = 18,
    lift,
    columns_to_join,
    outer_from = columns_to_join,
    inverse = outer_from + 6,
    reach = inverse + 6,
    columns
  };

  struct Level {
    std::size_t count = 0, stride = 0;
    std::vector<float> values;

    /// Room for whole vectors of four groups each.
    void clear(std::size_t groups, std::size_t lanes) {
      count = groups, stride = (groups + 4 * lanes - 1) / (4 * lanes) * (4 * lanes);
      if (values.size() < stride * columns) values.resize(stride * columns);
    }
    float* column(int c) { return values.data() + static_cast<std::size_t>(c) * stride; }
    const float* column(int c) const {
      return values.data() + static_cast<std::size_t>(c) * stride;
    }
  };

  /// Four vectors: the first, second, third and fourth of every four numbers.
  struct Four {
    Floats v[4];
  };

  static HWY_INLINE Four load_four(const float* at) {
    Four out;
    hn::LoadInterleaved4(Lanes(), at, out.v[0], out.v[1], out.v[2], out.v[3]);
    return out;
  }
  static HWY_INLINE void load_four(const float* const (&at)[3], Point (&out)[4]) {
    const Four x = load_four(at[0]), y = load_four(at[1]), z = load_four(at[2]);
    for (int k = 0; k < 4; ++k) out[k] = {x.v[k], y.v[k], z.v[k]};
  }

  /// Of the groups from `first` on, of which the last stands for those that do not exist.
  ShaftParts parts_of(const ConeBatch& queries, std::size_t first) const {
    constexpr std::size_t most = 4 * tree_width;
    const std::size_t n = 4 * hn::Lanes(Lanes()), begin = 4 * first;
    const float* at[ConeBatch::shared];
    HWY_ALIGN float filled[ConeBatch::shared][most];
    const bool whole = begin + n <= queries.size();
    for (std::size_t c = 0; c < ConeBatch::shared; ++c) {
      at[c] = queries.column(c) + begin;
      if (whole) continue;
      for (std::size_t i = 0; i < n; ++i)
        filled[c][i] = queries.column(c)[std::min(begin + i, queries.size() - 1)];
      at[c] = filled[c];
    }
    Point origin[4], direction[4], horizon[4];
    load_four({at[0], at[1], at[2]}, origin);
    load_four({at[3], at[4], at[5]}, direction);
    load_four({at[6], at[7], at[8]}, horizon);
    const Four distance = load_four(at[ConeBatch::distance]);
    const Four outer = load_four(at[ConeBatch::outer]);
    const Four own_epsilon = load_four(at[ConeBatch::epsilon]);
    ShaftParts out;
    for (int k = 0; k < 4; ++k) {
      const Box from{origin[k], origin[k]}, normals{horizon[k], horizon[k]};
      const Box to = end_of(origin[k], direction[k], outer.v[k], distance.v[k]);
      out.from = k == 0 ? from : join(out.from, from);
      out.to = k == 0 ? to : join(out.to, to);
      out.normals = k == 0 ? normals : join(out.normals, normals);
      out.epsilon = k == 0 ? own_epsilon.v[k] : hn::Min(out.epsilon, own_epsilon.v[k]);
    }
    const Point center = middle(out.from);
    out.lift = all(-infinite);
    for (int k = 0; k < 4; ++k)
      out.lift = hn::Max(out.lift, dot(horizon[k], minus(center, origin[k])));
    return out;
  }

  /// The box round a cone's far end; of a sun's cone, whose end is nowhere, that of how much its
  /// slice grows in a metre.
  HWY_INLINE Box end_of(const Point& origin, const Point& v, Floats outer, Floats distance) const {
    const auto sine = [&](Floats c) {
      return hn::Mul(hn::Sqrt(hn::Max(hn::NegMulAdd(c, c, all(1)), all(0))), outer);
    };
    const Point spread{sine(v.x), sine(v.y), sine(v.z)};
    const Box slice{minus(v, spread), plus(v, spread)};
    if (endless_) return slice;
    return {plus(origin, times(slice.lo, distance)), plus(origin, times(slice.hi, distance))};
  }

  ShaftParts parts_of(const Level& from, std::size_t first) const {
    Four column[columns_to_join];
    for (int c = 0; c < columns_to_join; ++c) column[c] = load_four(from.column(c) + 4 * first);
    ShaftParts parts[4];
    for (int k = 0; k < 4; ++k) {
      const auto box = [&](int c) {
        return Box{{column[c].v[k], column[c + 1].v[k], column[c + 2].v[k]},
                   {column[c + 3].v[k], column[c + 4].v[k], column[c + 5].v[k]}};
      };
      parts[k] = {box(box_from), box(box_to), box(box_normals), column[epsilon].v[k],
                  column[lift].v[k]};
    }
    return join(parts);
  }

  void store(Level& level, std::size_t first, const ShaftParts& parts) const {
    const Lanes d;
    const auto put = [&](int c, Floats v) { hn::StoreU(v, d, level.column(c) + first); };
    const auto put_box = [&](int c, const Box& b) {
      put(c, b.lo.x), put(c + 1, b.lo.y), put(c + 2, b.lo.z);
      put(c + 3, b.hi.x), put(c + 4, b.hi.y), put(c + 5, b.hi.z);
    };
    put_box(box_from, parts.from), put_box(box_to, parts.to);
    put_box(box_normals, parts.normals);
    put(epsilon, parts.epsilon), put(lift, parts.lift);

    const Box from = widened(parts.from), to = widened(parts.to);
    put_box(outer_from, from);
    Box ways = to;
    Floats far = all(1);
    if (endless_) {
      const Point size = minus(parts.from.hi, parts.from.lo);
      const Vec3 middle_of_all = bounds_->center();
      const Point away = minus(middle(parts.from),
                               {all(middle_of_all.x), all(middle_of_all.y), all(middle_of_all.z)});
      far = hn::Mul(all(2), hn::Add(hn::Add(hn::Sqrt(dot(away, away)), all(bounds_->diagonal())),
                                    hn::Sqrt(dot(size, size))));
    } else {
      ways = {minus(to.lo, from.lo), minus(to.hi, from.hi)};
    }
    const auto inverted = [](const Point& p) {
      return Point{reciprocal(p.x), reciprocal(p.y), reciprocal(p.z)};
    };
    put_box(inverse, {inverted(ways.hi), inverted(ways.lo)});
    put(reach, far);
    pad(level, first);
  }

  /// A shaft that is alone at the end of its level is there for its whole vector.
  static void pad(Level& level, std::size_t first) {
    const std::size_t end = first + hn::Lanes(Lanes());
    if (end < level.count) return;
    for (int c = 0; c < columns_to_join; ++c)
      std::fill(level.column(c) + level.count, level.column(c) + level.stride,
                level.column(c)[level.count - 1]);
  }

  /// Wider by some roundings of the sums that made it.
  static HWY_INLINE Box widened(const Box& b) {
    const auto most = [](const Point& p) {
      return hn::Max(hn::Max(hn::Abs(p.x), hn::Abs(p.y)), hn::Abs(p.z));
    };
    const Floats slack = hn::Mul(all(0x1p-20f), hn::Max(most(b.lo), most(b.hi)));
    const Point by{slack, slack, slack};
    return {minus(b.lo, by), plus(b.hi, by)};
  }

  // A face parallel to the axis bounds nothing or everything; a huge number does both.
  static HWY_INLINE Floats reciprocal(Floats x) {
    return hn::IfThenElse(hn::Lt(hn::Abs(x), all(1e-18f)), all(1e18f), hn::Div(all(1), x));
  }

  std::vector<Level> level_;
  int levels_ = 0;
  bool endless_ = false;
  const Bounds* bounds_ = nullptr;
};

}  // namespace penumbra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
