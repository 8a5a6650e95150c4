#pragma once
// What of a list is near one simplex of a body.

#include "proximity/near_list.h"
#include "proximity/part.h"

namespace dsw {

/** Where a part is in a simplex: a corner, the edge from a corner to the next one, or the whole of a face. */
enum PlaceInSimplex : uint32_t { kFirstCorner = 0, kFirstSide = 3, kWholeFace = 6, kPlacesInSimplex = 7 };

/** How long a selection is right: while no corner has moved farther than `way`, for what is within `room` less the way. */
struct SelectionLimits {
  double room, way;
};

/** Numbers of obstacles, or of features for each part of the simplex, ascending. Keeps its memory. */
template <int D>
class NearSelection {
 public:
  explicit NearSelection(const Memory* memory) : numbers_(memory) {}

  // All that is within `wanted.room` of a simplex, and perhaps more. `most`: the room of the list. Where nothing is within
  // that, the selection is right for as long as the list. Throws std::bad_alloc.

  /** Selects what the list has spheres of: obstacles, if it has no features. */
  SelectionLimits select_all(const NearList<D>& list, const Part<D>& part, const SelectionLimits& wanted, double most);
  /** Selects the features that can have a row with a part of the simplex. `places`: a bit for each part that counts. */
  SelectionLimits select_features(const NearList<D>& list, const Part<D>& part, uint32_t places,
                                  const SelectionLimits& wanted, double most);

  bool empty() const noexcept { return numbers_.empty(); }
  /** Whether nothing is within the room of the list, whatever part is asked for. */
  bool is_alone() const noexcept { return is_alone_; }
  const Array<uint32_t>& obstacles() const noexcept { return numbers_; }
  const uint32_t* features(uint32_t place) const noexcept { return numbers_.data() + first_[place]; }
  const uint32_t* features_end(uint32_t place) const noexcept { return numbers_.data() + first_[place + 1]; }
  uint64_t memory_bytes() const { return array_bytes(numbers_); }

 private:
  Array<uint32_t> numbers_;
  uint32_t first_[kPlacesInSimplex + 1] = {};
  bool is_alone_ = false;
};

}  // namespace dsw
