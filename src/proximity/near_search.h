#pragma once
// All near pairs of a body: which obstacles are near each of its parts is remembered from call to call.

#include "pairs/partners.h"
#include "proximity/near_pair.h"
#include "proximity/obstacles_near.h"

namespace dsw {

/** What was found near a simplex of a body. It is true while no corner has moved farther than the room that is left,
 * and the first corner is where the flood has come. */
template <int D>
struct NearNote {
  double anchors[3][D] = {};  // where the corners were
  double room = -1;           // all obstacles within this distance of the anchors are listed; negative: none are known
  uint64_t version = 0;       // of the environment then
  Cell start, connected;      // that held the first corner then, and when it was asked for last
  NearList<D> list;

  explicit NearNote(const Memory* memory) : list(memory) {}
};

/** Notes by slot. A part is asked for with the simplex that covers it: a face itself, an edge one of its faces, a
 * vertex one of its edges. So most vertices, and edges of surfaces, need no note. */
template <int D>
struct NearNotes {
  Array<NearNote<D>> of_vertices, of_edges, of_faces;

  explicit NearNotes(const Memory* memory) : of_vertices(memory), of_edges(memory), of_faces(memory) {}
  uint64_t memory_bytes() const;
};

/** A pair with an obstacle of the environment, or of another body. */
template <int D>
struct FoundPair : NearPair<D> {
  uint32_t partner = kNone;  // its number among the partners
};

template <int D>
class NearSearch {
 public:
  NearSearch(const Environment<D>& env, const Body<D>& body, NearNotes<D>& notes);

  /** Appends the pairs with obstacles of the environment within a distance. Throws std::bad_alloc. */
  void find_walls(double reach, Array<FoundPair<D>>& found);
  /** The same with parts of a partner, which may be the body itself. */
  void find_partner(const Partners<D>& partners, uint32_t number, double reach, Array<FoundPair<D>>& found);

 private:
  /** Calls visit(cover, parts that it covers). */
  template <class Visit>
  void for_each_cover(Visit visit) const;
  template <class Visit>
  void for_each_covered(const Simplex& cover, Visit visit) const;
  NearNote<D>& note_of(const Simplex& cover);
  /** Whether a list that is known holds all that is within reach now. Notes where the first corner is. */
  bool holds(const Part<D>& cover, double reach, double way, NearNote<D>& note) const noexcept;
  void refresh(const Part<D>& cover, double reach, NearNote<D>& note);
  /** By casts. */
  bool is_in_sight(const Part<D>& part, const NearPair<D>& pair) const noexcept;
  bool is_accepted(const Body<D>& other, const Part<D>& part, const uint32_t* corners, uint32_t count) const noexcept;
  void collect(const Body<D>& other, const Part<D>& cover, double reach);

  const Environment<D>& env_;
  const Body<D>& body_;
  NearNotes<D>& notes_;
  ObstacleFlood<D> flood_;
  NearList<D> others_;  // of a partner
  PairScratch scratch_;
};

}  // namespace dsw
