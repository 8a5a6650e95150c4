#pragma once
// What of a body is joined to some of its vertices by short ways along its edges.

#include "body/body.h"

namespace dsw {

/** Parts of a body that are joined by a way of at most so many radii need not keep a distance. */
constexpr double kJoinedRadii = 4;

/** A vertex, and how far it is along the body from what is looked at. */
struct WayAlong {
  uint32_t vertex;
  double length;
};

template <int D>
class Joined {
 public:
  explicit Joined(const Memory* memory) : ways_(memory), reached_(memory) {}

  /** Finds what is joined to some vertices, each at the end of a way. Throws std::bad_alloc. */
  void find(const Body<D>& body, const WayAlong* from, uint32_t count);
  bool has(uint32_t vertex) const noexcept { return vertex < ways_.size() && ways_[vertex] < Box<2>::kInfinity; }

 private:
  void shorten(uint32_t vertex, double length);

  Array<double> ways_;       // by vertex: the shortest that is known, or infinity
  Array<uint32_t> reached_;  // those that are known; may stand twice
};

}  // namespace dsw
