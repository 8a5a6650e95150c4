// Embree 3 as a peer.
#ifndef DARTSWEEP_TESTS_BENCHMARK_EMBREE_H
#define DARTSWEEP_TESTS_BENCHMARK_EMBREE_H

#include "engine.h"

namespace dsw::bench {

struct EmbreeSetting {
  bool high_quality = false;  // spatial splits
  bool robust = false;
  bool quads = false;     // quadrilaterals instead of triangle pairs; needs walls of four vertices
  bool packet = false;    // 8 rays at a time
  bool occluded = false;  // asks only whether, not when: less than the other engines answer
};

std::unique_ptr<Engine> make_embree(const EmbreeSetting& setting, const WallMesh& walls);

/** Every setting that answers single rays. */
std::vector<std::unique_ptr<Engine>> make_embrees(const WallMesh& walls);

}  // namespace dsw::bench

#endif
