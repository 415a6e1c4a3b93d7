// Cone queries side by side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "geometry/cone_query.h"

namespace penumbra {

/// Queries to one light, a column for each of their numbers: either all have a plane or none, and
/// all are to a light at finite distance or all to a sun.
class ConeBatch {
 public:
  /// Of a vector the first of three.
  enum Column { origin = 0, direction = 3, horizon = 6, distance = 9, outer, epsilon, shared };
  enum PlaneColumn { plane_normal = shared, plane_distance = plane_normal + 3, plane_epsilon, all };

  /// Empties it and makes room for `most` queries, and for a vector of lanes written at the end.
  void clear(std::size_t most, bool has_plane, int excluded_instance) {
    constexpr std::size_t vector = 16;
    stride_ = most + vector;
    size_ = 0;
    has_plane_ = has_plane, excluded_instance_ = excluded_instance;
    const std::size_t needed = stride_ * (has_plane ? std::size_t{all} : std::size_t{shared});
    if (values_.size() < needed) values_.resize(needed);
  }

  std::size_t size() const { return size_; }
  int excluded_instance() const { return excluded_instance_; }
  bool has_plane() const { return has_plane_; }
  /// Columns are written first; then the size is set.
  void set_size(std::size_t size) { size_ = size; }
  /// From one column to the next.
  std::size_t stride() const { return stride_; }
  float* column(std::size_t c) { return values_.data() + c * stride_; }
  const float* column(std::size_t c) const { return values_.data() + c * stride_; }

  void push_back(const ConeQuery& q) {
    set(origin, q.origin), set(direction, q.direction), set(horizon, q.horizon);
    column(distance)[size_] = q.distance, column(outer)[size_] = q.outer;
    column(epsilon)[size_] = q.epsilon;
    if (has_plane_) {
      set(plane_normal, q.plane_normal);
      column(plane_distance)[size_] = q.plane_distance;
      column(plane_epsilon)[size_] = q.plane_epsilon;
    }
    ++size_;
  }

  Vec3 vector(std::size_t c, std::size_t i) const {
    return {column(c)[i], column(c + 1)[i], column(c + 2)[i]};
  }

  ConeQuery query(std::size_t i) const {
    ConeQuery q;
    q.origin = vector(origin, i), q.direction = vector(direction, i);
    q.horizon = vector(horizon, i);
    q.distance = column(distance)[i], q.outer = column(outer)[i], q.epsilon = column(epsilon)[i];
    q.excluded_instance = excluded_instance_;
    if (has_plane_) {
      q.has_plane = true, q.plane_normal = vector(plane_normal, i);
      q.plane_distance = column(plane_distance)[i], q.plane_epsilon = column(plane_epsilon)[i];
    }
    return q;
  }

 private:
  void set(std::size_t c, const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) column(c + axis)[size_] = v[axis];
  }

  std::vector<float> values_;
  std::size_t stride_ = 0, size_ = 0;
  bool has_plane_ = false;
  int excluded_instance_ = -1;
};

}  // namespace penumbra
