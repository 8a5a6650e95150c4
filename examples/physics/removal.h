// Removal of the vertices that responses inserted, by the criterion of [JCD10] 7.3.1: "whenever the computed
// transformation become negligible with non-colliding new added particles, the system automatically removes them".
//
// How we read the sentence. The transformation is R and T of equation 1. What it does to a vertex is its pull: the
// way from the vertex to its goal R v0 + T. The transformation is negligible with an added vertex when the pull is
// negligible there and at all vertices that an edge joins to it, since these are the ones between which the removal
// straightens the body. An added vertex collides when the last move of the body inserted it, or when a contact of
// that move names it, one of its edges or one of its faces.
//
// With a pull of at most d at all of them, a removal changes the shape by no more than 2 d: on the matched shape an
// added vertex lies on the edge or face that it was inserted in.
#ifndef DARTSWEEP_PHYSICS_REMOVAL_H
#define DARTSWEEP_PHYSICS_REMOVAL_H

#include <vector>

#include "library.h"

namespace physics {

// The vertices that responses inserted and that are still there, and the edges that they were inserted in.
class InsertedVertices {
 public:
  bool contains(std::size_t i) const { return i < ends_.size() && ends_[i].count == 2; }
  bool empty() const { return count_ == 0; }
  // The neighbours of an inserted vertex on the edge that it was inserted in, whatever was inserted or removed there
  // since.
  const std::size_t* ends(std::size_t i) const { return ends_[i].end; }
  std::size_t slots() const { return ends_.size(); }

  void split(std::size_t a, std::size_t b, std::size_t added);
  // `gone` was merged into `kept`. An original vertex may go, too.
  void merge(std::size_t gone, std::size_t kept);

 private:
  struct Ends {
    int count = 0;  // 2, or 0: not inserted
    std::size_t end[2] = {0, 0};
  };

  std::vector<Ends> ends_;
  std::size_t count_ = 0;
};

// Removes an inserted vertex that the criterion allows to remove, by dsw_body_collapse_edge into one of its `ends`.
// The library sweeps the way: where something stands there (DSW_STATUS_OCCUPIED), or the surface would not stay one
// (DSW_STATUS_NOT_MANIFOLD), the vertex stays. `pulls` and `colliding` are those of all vertices by index, `negligible`
// is the largest pull that counts as none, scene units. Returns whether a vertex was removed; `edit` then says which.
// Throws LibraryError for whatever else a call answers. O(inserted vertices * edges). Certain: when all inserted
// vertices are gone, in whatever order, the edges are the original ones, since `ends` lead along each original edge
// all the time.
bool remove_one(dsw_scene* scene, dsw_body_id body, const InsertedVertices& inserted, const std::vector<double>& pulls,
                double negligible, const std::vector<char>& colliding, dsw_body_edit* edit);

}  // namespace physics

#endif
