// Peers that tell how far a segment is from the nearest wall.
#ifndef DARTSWEEP_TESTS_BENCHMARK_NEAR_PEERS_H
#define DARTSWEEP_TESTS_BENCHMARK_NEAR_PEERS_H

#include "engine.h"

namespace dsw::bench {

class NearPeer {
 public:
  virtual ~NearPeer() = default;
  virtual std::string name() const = 0;
  /** Infinity, or more than the radius, if nothing is within it. */
  virtual double distance(const double* from, const double* to, double radius) = 0;
};

/** A point query round the middle of the segment; the callback measures triangles in doubles. */
std::unique_ptr<NearPeer> make_near_embree(const WallMesh& walls);

/** A tree of boxes of the walls, and the segment as a triangle without area. Null where FCL is not installed. */
std::unique_ptr<NearPeer> make_near_fcl(const WallMesh& walls);

}  // namespace dsw::bench

#endif
