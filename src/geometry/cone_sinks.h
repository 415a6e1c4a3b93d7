// Where a walk's finds go, and how far it still has to look. Private to the geometry room.
#pragma once

#include <hwy/base.h>

#include <algorithm>
#include <vector>

#include "geometry/cone_tree_data.h"

namespace penumbra {

/// Keeps the least clearance; the cone shrinks to it, or further by what the limit allows.
class LeastSink {
 public:
  static constexpr bool by_object = false;

  LeastSink(float outer, const SearchLimit& limit)
      : limits_(limit),
        outer_(outer),
        bins_per_clearance_(SearchLimit::size / outer),
        best_(outer),
        limit_(outer) {}

  float best() const { return best_; }
  float limit() const { return limit_; }
  bool done() const { return limit_ <= 0; }
  /// True if the limit changed.
  HWY_INLINE bool offer(float clearance) {
    if (!(clearance < best_)) return false;
    best_ = clearance;
    const auto bin = static_cast<std::size_t>(best_ * bins_per_clearance_);
    limit_ = std::min(best_,
                      outer_ * limits_.fraction[std::min<std::size_t>(bin, SearchLimit::size - 1)]);
    return true;
  }

 private:
  const SearchLimit& limits_;
  float outer_, bins_per_clearance_, best_, limit_;
};

/// Keeps the least clearance of every object; the cone stays as it is until the ray is blocked.
class ObjectSink {
 public:
  static constexpr bool by_object = true;

  ObjectSink(float outer, const ConeTree::Data& data, std::vector<ObjectClearance>& out)
      : data_(data), out_(out), outer_(outer) {}

  const ConeTree::Data& data() const { return data_; }
  float limit() const { return blocked_ ? 0 : outer_; }
  bool done() const { return blocked_; }
  bool offer(float clearance, std::uint32_t object) {
    if (!(clearance < outer_)) return false;
    blocked_ = blocked_ || clearance <= 0;
    const auto known = std::find_if(out_.begin(), out_.end(), [object](const ObjectClearance& c) {
      return c.object == object;
    });
    if (known == out_.end())
      out_.push_back({object, clearance});
    else
      known->clearance = std::min(known->clearance, clearance);
    return false;
  }

 private:
  const ConeTree::Data& data_;
  std::vector<ObjectClearance>& out_;
  float outer_;
  bool blocked_ = false;
};

}  // namespace penumbra
