#pragma once
// The walls that a vertex has touched on its way, as planes that it stays before.

#include "base/vec.h"

namespace dsw {

/** Walls that one vertex has touched in one move, the latest first. Tells how near to its target they let it come. What
 * it says is a proposal: a sweep decides whether the way there is free. */
template <int D>
class TouchedWalls {
 public:
  void clear() { count_ = 0; }

  /** Adds the wall of a contact.
   * @param touching where the vertex was at the contact.
   * @param off distance to keep from the wall. */
  void add(const Vec& normal, const Vec& touching, double off);

  /** The point nearest to `target` that lies before all of the walls, for a vertex that stands at `at`. False: that
   * point is no way off, so the vertex is in a corner. */
  bool find_nearest(const Vec& at, const Vec& target, Vec* nearest) const;

 private:
  static constexpr int kMost = 6;
  struct Wall {
    Vec normal, touching;
    double off;
  };
  /** Steps from where the vertex stands are before a wall if dot(normal, step) is not less than `least`. */
  struct HalfSpace {
    Vec normal;
    double least, slack;
  };
  class Search;

  Wall walls_[kMost];
  int count_ = 0;
};

}  // namespace dsw
