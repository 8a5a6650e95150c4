// Segments for Embree: in its format, single rays, and the first hits.
#ifndef DARTSWEEP_TESTS_BENCHMARK_EMBREE_CASTS_H
#define DARTSWEEP_TESTS_BENCHMARK_EMBREE_CASTS_H

#include "engine.h"

struct RTCSceneTy;

namespace dsw::bench {

class EmbreeCasts {
 public:
  struct Ray {
    float from[3], direction[3];
  };
  struct Result {
    std::uint32_t primitive;  // kNone: nothing is met
    float time;
  };

  /** @param room results more than a batch has. */
  void prepare(const Segments& segments, std::size_t room = 0);
  /** rtcIntersect1, one after the other. */
  void run(RTCSceneTy* scene, std::size_t first, std::size_t count);

  const Ray& ray(std::size_t i) const { return rays_[i]; }
  Result& result(std::size_t i) { return results_[i]; }
  const Result& result(std::size_t i) const { return results_[i]; }

 private:
  std::vector<Ray> rays_;
  std::vector<Result> results_;
};

}  // namespace dsw::bench

#endif
