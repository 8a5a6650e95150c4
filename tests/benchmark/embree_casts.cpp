#include "embree_casts.h"

#include <embree3/rtcore.h>

namespace dsw::bench {

static_assert(kNone == RTC_INVALID_GEOMETRY_ID, "what Embree writes for a ray that meets nothing");

void EmbreeCasts::prepare(const Segments& segments, std::size_t room) {
  rays_.resize(segments.count());
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      rays_[i].from[k] = static_cast<float>(segments.from[3 * i + k]);
      rays_[i].direction[k] = static_cast<float>(segments.to[3 * i + k] - segments.from[3 * i + k]);
    }
  }
  results_.resize(segments.batch + room);
}

void EmbreeCasts::run(RTCScene scene, std::size_t first, std::size_t count) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  for (std::size_t i = 0; i < count; ++i) {
    const Ray& ray = rays_[first + i];
    RTCRayHit query;
    query.ray.org_x = ray.from[0];
    query.ray.org_y = ray.from[1];
    query.ray.org_z = ray.from[2];
    query.ray.dir_x = ray.direction[0];
    query.ray.dir_y = ray.direction[1];
    query.ray.dir_z = ray.direction[2];
    query.ray.tnear = 0.0f;
    query.ray.tfar = 1.0f;
    query.ray.time = 0.0f;
    query.ray.mask = ~0u;
    query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &query);
    results_[i] = {query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? kNone : query.hit.primID, query.ray.tfar};
  }
}

}  // namespace dsw::bench
