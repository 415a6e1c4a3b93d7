// ConeTree's queries: the walk from the root, nearest to the axis first.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/cone_traversal.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include "geometry/cone_group-inl.h"
#include "geometry/cone_sinks.h"
#include "geometry/cone_walk-inl.h"

#if HWY_ONCE
namespace penumbra {

HWY_EXPORT(walk_for_least);
HWY_EXPORT(walk_for_objects);
HWY_EXPORT(walk_for_group);

float ConeTree::least_clearance(const ConeQuery& query, const SearchLimit& limit,
                                ConeCounts& counts) const {
  LeastSink sink(query.outer, limit);
  if (data_->root.kind() != ChildKind::none)
    HWY_DYNAMIC_DISPATCH(walk_for_least)(*data_, query, sink, counts);
  return sink.best();
}

void ConeTree::least_clearances(const ConeBatch& queries, const SearchLimit& limit,
                                std::span<float> clearances, ConeCounts& counts) const {
  if (queries.size() == 0) return;
  if (data_->root.kind() != ChildKind::none)
    HWY_DYNAMIC_DISPATCH(walk_for_group)(*data_, queries, clearances, limit, counts);
  else
    std::copy_n(queries.column(ConeBatch::outer), queries.size(), clearances.begin());
}

void ConeTree::object_clearances(const ConeQuery& query, std::vector<ObjectClearance>& out,
                                 ConeCounts& counts) const {
  out.clear();
  ObjectSink sink(query.outer, *data_, out);
  if (data_->root.kind() != ChildKind::none)
    HWY_DYNAMIC_DISPATCH(walk_for_objects)(*data_, query, sink, counts);
}

}  // namespace penumbra
#endif
