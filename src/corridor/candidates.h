#pragma once
// Features of the environment that a part may touch, with the walls that have them.

#include "map/map.h"

namespace dsw {

/** A corner, a side or the whole of a triangle of a wall (in the plane of its segment), or a marked edge or vertex: what a part
 * of a body can touch. A list of what is near (proximity/near_list.h) has parts of other bodies as well. */
struct WallFeature {
  uint32_t
      vertices[3];  // of the environment: the first `count`; for a whole facet vertices[0] may be its word. In a list
                    // that is finished their numbers there
  uint32_t count;
  HalfFacet facet;  // an impassable facet at it, seen from a passable cell; invalid if there is none
  Cell cell;        // of a marked edge or vertex: a cell at it

  /** Names something that has the feature: of facets the lowest one, of cells the one with the lowest index. */
  template <int D>
  void add_name(const Map<D>& map, HalfFacet of_wall, Cell of_mark) noexcept {
    if (of_wall.valid()) {
      if (!facet.valid() || canonical(map, of_wall).word < canonical(map, facet).word) facet = of_wall;
    } else if (!cell.valid() || map.index(of_mark) < map.index(cell)) {
      cell = of_mark;
    }
  }
};

/** A feature of walls, or something thin that is marked. */
struct Candidate {
  WallFeature name;
  uint32_t first_plane, plane_end;  // the walls that have it, in CandidateView::numbers
};

/** The triangle of a wall, in the plane its segment. */
template <int D>
struct WallPlane {
  const double* corners[D];
};

/** A view of what a part may touch. */
template <int D>
struct CandidateView {
  const Candidate *first, *last;
  const uint32_t* numbers;  // of planes
  const WallPlane<D>* planes;
  uint32_t plane_count;

  const Candidate* begin() const noexcept { return first; }
  const Candidate* end() const noexcept { return last; }
};

}  // namespace dsw
