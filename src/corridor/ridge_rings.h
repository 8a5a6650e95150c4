#pragma once
// Which walls an edge may touch while both of its ends move, found from ridge to ridge.

#include "base/key_table.h"
#include "corridor/candidates.h"
#include "corridor/convex_cells.h"

namespace dsw {

/** One for each thread. */
template <int D>
class RidgeRings {
 public:
  explicit RidgeRings(const Environment<D>& env) : env_(env) {}

  /** Finds the ridges of walls that an edge may touch first. False: a cell is not exactly convex, or too many ridges would
   * be asked about. Throws std::bad_alloc.
   * @param corridor that of the edge at its start, in the present version. Cells at its ends are exactly convex, and where
   * the paths end.
   * @param paths the facets that both ends pass on their ways, and maybe more of them. */
  bool find(const Corridor<D>& corridor, const EdgeWay& edge, const Array<uint32_t> (&paths)[2]);
  /** What was found last, until the next search. */
  CandidateView<D> features() const noexcept;

 private:
  /** The four lines through the start or the end of one point of an edge, and the start or the end of the other. */
  struct Lines {
    double low[D], high[D];  // of the box of the edge's way
    const double* others[2];
    filter::Vec<D> ways[2][2];  // from the first point to the other: [of the other][of the first]

    explicit Lines(const EdgeWay& edge) noexcept;
  };
  /** The passable cells round a ridge, from wall to wall or all round. */
  struct Fan {
    RidgeName ridge;
    HalfFacet walls[2];  // seen from the fan; invalid: it goes all round
    Cell cell;           // with the lowest index
  };
  bool may_touch(const RidgeName& ridge, const Lines& lines) const noexcept;
  bool add_ridges(HalfFacet facet, const Lines& lines);
  bool add_fan(HalfFacet facet, const RidgeName& ridge);
  template <class Visit>
  bool go_round(HalfFacet facet, const RidgeName& ridge, HalfFacet& wall, Visit visit) const;
  bool is_in_fan(HalfFacet facet, const RidgeName& ridge) const;
  void add_features();

  const Environment<D>& env_;
  Array<uint32_t> facets_{env_.memory};  // that the edge may pass
  KeyTable ridges_{env_.memory};         // of these that were asked about
  Array<Fan> fans_{env_.memory};         // with walls or marks, of ridges that the edge may touch
  Array<Candidate> features_{env_.memory};
  Array<WallPlane<D>> planes_{env_.memory};
  Array<uint32_t> numbers_{env_.memory};
};

}  // namespace dsw
