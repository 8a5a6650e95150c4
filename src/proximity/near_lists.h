#pragma once
// What is near each simplex of a body: found by floods, and remembered from call to call.

#include "proximity/near_selection.h"
#include "proximity/obstacles_near.h"

namespace dsw {

/** Where the corners of a simplex were, and for how long it is known from there what is near. */
template <int D>
struct Anchor {
  double corners[3][D] = {};
  SelectionLimits limits{-1, -1};  // negative: nothing is known

  void set(const Part<D>& part, const SelectionLimits& known) noexcept;
  void forget() noexcept { limits = {-1, -1}; }
  /** Not less than how far any corner has moved. */
  double way_to(const Part<D>& part) const noexcept {
    double square = 0;
    bool is_moved = false;
    for (uint32_t i = 0; i < part.corners.count; ++i) {
      const Vec way = difference<D>(part.points[i], corners[i]);
      is_moved |= !is_zero(way);
      square = std::max(square, dot(way, way));
    }
    // Squares that underflow may lose the last term. What stands still has not moved.
    return is_moved ? std::sqrt(square) * (1 + 0x1p-50) + 0x1p-500 : 0;
  }
  /** Whether all within `reach` of the part is known, if its corners have moved `way`. */
  bool holds(double reach, double way) const noexcept {
    return (reach + way) * (1 + 0x1p-40) <= limits.room && way <= limits.way;
  }
};

/** What was found near a simplex of a body. One flood makes a list for several simplices; each selects from the list
 * what is near to it. */
template <int D>
struct NearNote {
  Anchor<D> listed, selected;
  uint64_t version = 0;   // of the environment when the list was made
  uint64_t number = 0;    // of the list; 0: none
  uint32_t owner = 0;     // which note has the list
  Cell start, connected;  // that held the first corner then, and when it was asked for last
  NearSelection<D> near;  // of the list
  uint32_t places = 0;    // that were selected for
  NearList<D> list;       // for this simplex and others, or empty
  uint64_t list_number = 0;

  explicit NearNote(const Memory* memory) : near(memory), list(memory) {}
};

/** Notes by slot. A part is asked for with the simplex that covers it: a face itself, an edge one of its faces, a
 * vertex one of its edges. So most vertices, and edges of surfaces, need no note. */
template <int D>
struct NearNotes {
  Array<NearNote<D>> of_vertices, of_edges, of_faces;
  uint64_t found = 0;  // how often something was found for a note

  explicit NearNotes(const Memory* memory) : of_vertices(memory), of_edges(memory), of_faces(memory) {}
  uint64_t memory_bytes() const;
};

/** A list, and what of it is near. */
template <int D>
struct NearView {
  const NearList<D>& list;
  const NearSelection<D>& near;
};

/** Finds what is near; keeps its memory from call to call. Throws std::bad_alloc. */
template <int D>
class NearLists {
 public:
  /** @param has_features whether lists have triangles, edges and vertices once each, or obstacles alone. */
  explicit NearLists(const Environment<D>& env, bool has_features = true)
      : env_(env), flood_(env), fresh_(env.memory), has_features_(has_features) {}

  /** Whether it is known that nothing is within a distance of a part. */
  bool is_alone(const Body<D>& body, const Part<D>& part, double reach, NearNotes<D>& notes) const noexcept;
  /** What is within a distance of a part, and perhaps more. `places`: the parts to select for; ignored without features.
   * `notes` are of its body. Valid until the next call.
   * @param wanted how far to look where it has to look. More than `reach` lets it look less often. */
  NearView<D> near(const Body<D>& body, const Part<D>& part, uint32_t places, double reach, NearNotes<D>& notes,
                   double wanted = 0);
  /** Finds the obstacles in a region; remembers nothing. */
  const NearList<D>& in(Cell start, const NearRegion<D>& region);

 private:
  /** Whether a list was made for a note and is not outdated, and its flood has come to where the part is now. */
  bool is_current(const Body<D>& body, const Part<D>& part, const Array<NearNote<D>>& notes,
                  NearNote<D>& note) const noexcept;
  void make_list(const Body<D>& body, const Part<D>& part, double room, Array<NearNote<D>>& notes, uint64_t number);

  const Environment<D>& env_;
  ObstacleFlood<D> flood_;
  NearList<D> fresh_;
  bool has_features_;
};

}  // namespace dsw
