// Embree 3.13 and Embree 4 behind one set of names. All that differs between them is here.
#pragma once

#if __has_include(<embree4/rtcore.h>) && !defined(PENUMBRA_EMBREE3)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace penumbra::rtc {

#if RTC_VERSION_MAJOR >= 4

using Context = RTCRayQueryContext;
/// What a scene needs for queries with a filter of their own.
inline constexpr auto query_filter = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
inline void init(Context& context) { rtcInitRayQueryContext(&context); }

inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray_hit) {
  RTCIntersectArguments args;
  rtcInitIntersectArguments(&args);
  args.context = &context;
  rtcIntersect1(scene, &ray_hit, &args);
}
/// Rays that go much the same way.
inline void intersect(const int* valid, RTCScene scene, Context& context, RTCRayHit8& ray_hits) {
  RTCIntersectArguments args;
  rtcInitIntersectArguments(&args);
  args.context = &context;
  args.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &ray_hits, &args);
}

/// `filter` may be null.
inline RTCOccludedArguments occluded_arguments(Context& context, RTCFilterFunctionN filter,
                                               bool coherent) {
  RTCOccludedArguments args;
  rtcInitOccludedArguments(&args);
  args.context = &context;
  args.filter = filter;
  int flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  if (filter) flags |= RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
  args.flags = static_cast<RTCRayQueryFlags>(flags);
  return args;
}
inline void occluded(RTCScene scene, Context& context, RTCFilterFunctionN filter, RTCRay& ray) {
  RTCOccludedArguments args = occluded_arguments(context, filter, false);
  rtcOccluded1(scene, &ray, &args);
}
inline void occluded(const int* valid, RTCScene scene, Context& context, RTCFilterFunctionN filter,
                     RTCRay8& rays) {
  RTCOccludedArguments args = occluded_arguments(context, filter, true);
  rtcOccluded8(valid, scene, &rays, &args);
}
inline void occluded(const int* valid, RTCScene scene, Context& context, RTCFilterFunctionN filter,
                     RTCRay16& rays) {
  RTCOccludedArguments args = occluded_arguments(context, filter, true);
  rtcOccluded16(valid, scene, &rays, &args);
}

#else

using Context = RTCIntersectContext;
/// What a scene needs for queries with a filter of their own.
inline constexpr auto query_filter = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
inline void init(Context& context) { rtcInitIntersectContext(&context); }

inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray_hit) {
  rtcIntersect1(scene, &context, &ray_hit);
}
/// Rays that go much the same way.
inline void intersect(const int* valid, RTCScene scene, Context& context, RTCRayHit8& ray_hits) {
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context, &ray_hits);
}

/// `filter` may be null.
inline void occluded(RTCScene scene, Context& context, RTCFilterFunctionN filter, RTCRay& ray) {
  context.filter = filter;
  rtcOccluded1(scene, &context, &ray);
}
inline void occluded(const int* valid, RTCScene scene, Context& context, RTCFilterFunctionN filter,
                     RTCRay8& rays) {
  context.filter = filter;
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded8(valid, scene, &context, &rays);
}
inline void occluded(const int* valid, RTCScene scene, Context& context, RTCFilterFunctionN filter,
                     RTCRay16& rays) {
  context.filter = filter;
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &context, &rays);
}

#endif

}  // namespace penumbra::rtc
