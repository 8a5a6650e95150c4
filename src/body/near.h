#pragma once
// Where something changes, as boxes, and which parts of a body are near.

#include <algorithm>

#include "base/search.h"
#include "body/body.h"

namespace dsw {

/** Boxes of many things as fewer, larger ones, as long as these are hardly larger: of things that come one after the
 * other and lie beside each other. */
template <int D>
class BoxGroups {
 public:
  /** `apart`: else all go into one. */
  BoxGroups(const Memory* memory, bool apart) : apart_(apart), boxes_(memory) {}

  /** Throws std::bad_alloc. */
  void add(const Box<D>& box);
  /** Puts all into one. */
  void join() noexcept;
  const Array<Box<D>>& boxes() const noexcept { return boxes_; }

 private:
  bool apart_;
  Array<Box<D>> boxes_;
  double volume_ = 0;  // of what went into the last
};

/** The boxes that matter to a body. Without any: everywhere. */
template <int D>
struct Places {
  const Box<D>* boxes = nullptr;
  size_t count = 0;

  bool everywhere() const noexcept { return count == 0; }
  bool overlap(const double* const* points, int corners) const noexcept;
};

/** The numbers of boxes that overlap any of the places, ascending. Throws std::bad_alloc. */
template <int D>
void find_overlapping(const BoxGrid<D>& grid, const Places<D>& places, Array<uint32_t>& found);

/** Calls visit(number) for parts of a body until it returns false; whether it never did. A body that keeps boxes has
 * those near the places visited, by number; another one all of them. `near` is scratch, `looked_at` grows by how many
 * there are. Throws std::bad_alloc. */
template <int D, class Visit>
bool visit_near(const Body<D>& body, const BoxGrid<D> BodyBoxes<D>::*grid, size_t count, const Places<D>& places,
                Array<uint32_t>& near, uint64_t& looked_at, Visit visit) {
  if (body.boxes.empty() || places.everywhere()) {
    looked_at += count;
    for (uint32_t i = 0; i < count; ++i) {
      if (!visit(i)) return false;
    }
    return true;
  }
  find_overlapping(fresh_boxes(body).*grid, places, near);
  looked_at += near.size();
  return dsw::all_of(near.begin(), near.end(), visit);
}

}  // namespace dsw
