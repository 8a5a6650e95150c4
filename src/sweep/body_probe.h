#pragma once
// Whether bodies stay free when something becomes impassable.

#include "body/near.h"
#include "corridor/sweep.h"
#include "walk/packet.h"

namespace dsw {

/** Whether a face that stands still is free, if its edges are: the triangle that its first edge sweeps over it. `flood`
 * has the cells that it meets, and if it is not free all contacts. Throws std::bad_alloc. */
bool is_face_free(const Environment<3>& env, SweepFlood<3>& flood, const Body<3>& body, uint32_t face);

/** What has become impassable. */
enum class Obstacle { kCells, kFacets, kMarkedEdges };

/** Looks for what of a body, which stands still, meets obstacles in some places. At every level vertices lie in cells;
 * edges are stopped by facets from EDGES on; at FACES facets and marked edges pierce faces. The shift lets neither an
 * edge meet a marked edge nor anything a single vertex. */
template <int D>
class BodyProbe {
 public:
  /** Throws std::bad_alloc, as all that follows. */
  BodyProbe(const Environment<D>& env, Obstacle kind);

  /** O(size of the body, or if it keeps boxes what of it is near; and volumes met by edges and faces in the places). */
  bool is_free(const Body<D>& body, const Places<D>& changed);

  /** Appends the ends of the edges that are not free at a level; if all are, two corners of each face that is not. */
  void find_blocked(const Body<D>& body, SweepLevel level, Array<uint32_t>& pairs);

  /** Takes back the marks of the cells that the body meets. All have just been set. Returns how many there were. */
  size_t leave_out(Environment<D>& env, const Body<D>& body, const Places<D>& changed);

  uint64_t looked_at = 0;  // vertices, edges and faces

 private:
  template <class Visit>
  bool visit_vertices(const Body<D>& body, const Places<D>& changed, Visit visit);
  template <class Visit>
  bool visit_edges(const Body<D>& body, const Places<D>& changed, SweepLevel level, Visit visit);
  template <class Visit>
  bool visit_faces(const Body<D>& body, const Places<D>& changed, SweepLevel level, Visit visit);

  const Environment<D>& env_;
  Obstacle kind_;
  SweepFlood<D> flood_;
  Packet<D> packet_;
  Array<uint32_t> near_{env_.memory};
};

}  // namespace dsw
