#pragma once
// Boxes round the simplices of a blade, halved until few are left: which of them can meet what is in a box, and how far
// the nearest one is. Boxes are closed, so that what lies apart stays apart whatever the shift.

#include "cutting/blade.h"
#include "environment/environment.h"

namespace dsw {

template <int D>
class BladeTree {
 public:
  struct Box {
    double lower[D], upper[D];

    Box();
    /** The box round the vertices of a cell. */
    Box(const Environment<D>& env, Cell c);
    void add(const double* point);
    bool overlaps(const Box& other) const;
    bool holds(const double* point) const;
  };

  /** O(n log² n). Throws std::bad_alloc. */
  BladeTree(const Memory* memory, const Blade<D>& blade);

  /** The box round the whole blade. */
  const Box& box() const { return nodes_[0].box; }

  /** The least distance_to_simplex() of all. `nearest` is where it may be, and where it was then. */
  double distance(const double* from, uint32_t* nearest) const;

  uint32_t simplex_count() const { return blade_.simplex_count(); }
  /** Box of one simplex. */
  Box box(uint32_t simplex) const;

  /** Calls visit(simplex) for those whose boxes overlap a box. */
  template <class Visit>
  void for_each_in(const Box& box, Visit visit) const {
    for (uint32_t i = 0; i < nodes_.size();) {
      const Node& node = nodes_[i];
      if (!node.box.overlaps(box)) {
        i = node.next;
        continue;
      }
      for (uint32_t k = node.first; k < node.end; ++k) {
        if (leaves_[k].box.overlaps(box)) visit(leaves_[k].simplex);
      }
      ++i;
    }
  }

 private:
  struct Leaf {
    Box box;
    uint32_t simplex;
    double trust;  // see trust_of
  };
  /** In depth-first order; `next` is the first one that is not below it. Simplices only where nothing is below. */
  struct Node {
    Box box;
    uint32_t first, end, next;
    double trust;  // least below
  };

  void build(uint32_t first, uint32_t end);

  const Blade<D>& blade_;
  Array<Leaf> leaves_;
  Array<Node> nodes_;
};

}  // namespace dsw
