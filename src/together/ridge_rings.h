#pragma once
// What of the environment an edge may touch while both of its ends move, found from ridge to ridge.

#include "flood/sequence.h"
#include "predicates/filtered.h"
#include "together/traveller.h"

namespace dsw {

/** An edge on its way, and the facets that the paths of its ends pass. */
struct EdgeTravel {
  const double *first, *first_to, *last, *last_to;  // the start and the end of its first and its last point
  const Array<uint32_t>*first_path, *last_path;
};

/** A ridge that an edge may touch: something at it is impassable. */
struct WallRidge {
  WallFeature name;
  HalfFacet walls[2];  // at it, seen from a passable cell; invalid: there are not so many
};

/** One for each thread. */
template <int D>
class RidgeRings {
 public:
  explicit RidgeRings(const Environment<D>& env) : env_(env) {}

  /** Finds what an edge may touch, apart from its ends. Where it starts it passes the facets of a sequence of the present
   * version. False: that is not known. So it is of sequences that are not kept in rows. Throws std::bad_alloc. */
  bool find(const EdgeSequence<D>& sequence, const EdgeTravel& edge);
  /** What was found last, in no order. */
  const Array<WallRidge>& walls() const noexcept { return walls_; }

 private:
  struct Ridge {
    uint32_t vertices[2];  // in space in order, in the plane both are the same
  };
  /** The way of an edge, as its lines ask for it: ways[k][i] leads from start or end i of its first point to last[k]. */
  struct Lines {
    double low[D], high[D];  // of the box of the edge's way
    const double* last[2];
    filter::Vec<D> ways[2][2];

    explicit Lines(const EdgeTravel& edge) noexcept;
  };
  bool is_new(const Ridge& ridge) noexcept;
  bool may_touch(const Ridge& ridge, const Lines& lines) const noexcept;
  void add_missed(const EdgeSequence<D>& sequence, const EdgeTravel& edge);
  bool add_ring(HalfFacet facet, const Ridge& ridge);
  bool go_round(HalfFacet facet, const Ridge& ridge, WallRidge& met);

  const Environment<D>& env_;
  static constexpr uint32_t kMostRidges = 96, kSlots = 256;  // so an empty slot is never far
  static constexpr uint64_t kNoRidge = ~uint64_t{0};
  uint64_t ridges_[kSlots];  // that were asked about, hashed
  uint32_t ridge_count_ = 0;
  Array<uint32_t> facets_{env_.memory};  // that the edge may pass
  Array<WallRidge> walls_{env_.memory};
};

}  // namespace dsw
