#pragma once
// What is near each simplex of a body: found by floods, and remembered from call to call.

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

/** Finds what is near; keeps its memory from call to call. Throws std::bad_alloc. */
template <int D>
class NearLists {
 public:
  /** @param has_features whether lists have triangles, edges and vertices once each, or obstacles alone. */
  explicit NearLists(const Environment<D>& env, bool has_features = true)
      : env_(env), flood_(env), fresh_(env.memory), has_features_(has_features) {}

  /** The obstacles within a distance of a part, and perhaps more. `notes` are of its body. Valid until the next call. */
  const NearList<D>& near(const Body<D>& body, const Part<D>& part, double reach, NearNotes<D>& notes);
  /** Those in a region; remembers nothing. */
  const NearList<D>& in(Cell start, const NearRegion<D>& region);

 private:
  /** Whether a list that is known holds all that is within reach now. Notes where the first corner is. */
  bool holds(const Body<D>& body, const Part<D>& part, double reach, NearNote<D>& note) const noexcept;

  const Environment<D>& env_;
  ObstacleFlood<D> flood_;
  NearList<D> fresh_;
  bool has_features_;
};

}  // namespace dsw
