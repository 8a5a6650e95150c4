#include "proximity/near_lists.h"

#include <algorithm>
#include <cmath>

#include "walk/cast.h"

namespace dsw {
namespace {

/** Not less than how far a point has moved. */
template <int D>
double way_between(const double* a, const double* b) noexcept {
  double largest = 0;
  for (int k = 0; k < D; ++k) largest = std::max(largest, std::fabs(a[k] - b[k]));
  return 1.8 * largest;  // more than the square root of 3
}

/** Of a simplex; made if there is none. */
template <int D>
NearNote<D>& note_of(NearNotes<D>& all, const Simplex& simplex, const Memory* memory) {
  Array<NearNote<D>>& notes = simplex.kind == Simplex::kVertex ? all.of_vertices
                              : simplex.kind == Simplex::kEdge ? all.of_edges
                                                               : all.of_faces;
  while (notes.size() <= simplex.index) notes.emplace_back(memory);
  return notes[simplex.index];
}

// How far obstacles are noted, times the reach. Between 2 and 4 it makes no difference to a wire that is pushed: longer
// lists are made less often.
constexpr double kNotedRoom = 2;

}  // namespace

template <int D>
uint64_t NearNotes<D>::memory_bytes() const {
  uint64_t bytes = array_bytes(of_vertices) + array_bytes(of_edges) + array_bytes(of_faces);
  for (const auto* notes : {&of_vertices, &of_edges, &of_faces}) {
    for (const NearNote<D>& each : *notes) bytes += each.list.memory_bytes();
  }
  return bytes;
}

// All that a new flood would enter lies within the room of the anchors. The flood that made the list has entered it,
// too, if that flood has come to the cell where the new one would start. It has if both start in the same cell. It also
// has if a straight way leads there from the anchor through passable cells, since that way lies within the room.
template <int D>
bool NearLists<D>::holds(const Body<D>& body, const Part<D>& part, double reach, NearNote<D>& note) const noexcept {
  if (note.room < 0 || note.version != env_.change_version) return false;
  double way = 0;
  for (uint32_t i = 0; i < part.corners.count; ++i) {
    way = std::max(way, way_between<D>(part.points[i], note.anchors[i]));
  }
  if (!((reach + way) * (1 + 0x1p-40) <= note.room)) return false;
  const Cell now = body.vertices[part.corners.vertices[0]].cell;
  if (now == note.connected || now == note.start) return true;
  const CastResult there = cast(env_, note.anchors[0], part.points[0], note.start);
  if (there.end == CastEnd::kHit || there.cell != now) return false;
  note.connected = now;
  return true;
}

template <int D>
const NearList<D>& NearLists<D>::near(const Body<D>& body, const Part<D>& part, double reach, NearNotes<D>& notes) {
  NearNote<D>& note = note_of(notes, part.simplex, env_.memory);
  if (holds(body, part, reach, note)) return note.list;
  note.room = -1;  // until the list is whole
  note.list.clear();
  const double room = kNotedRoom * reach;
  note.start = note.connected = body.vertices[part.corners.vertices[0]].cell;
  flood_.find(note.start, NearRegion<D>(part.points, part.corners.count, room), note.list);
  note.list.finish({env_.points, D}, has_features_);
  for (uint32_t i = 0; i < part.corners.count; ++i) std::copy_n(part.points[i], D, note.anchors[i]);
  note.version = env_.change_version;
  note.room = room;
  return note.list;
}

template <int D>
const NearList<D>& NearLists<D>::in(Cell start, const NearRegion<D>& region) {
  fresh_.clear();
  flood_.find(start, region, fresh_);
  fresh_.finish({env_.points, D}, has_features_);
  return fresh_;
}

template struct NearNotes<2>;
template struct NearNotes<3>;
template class NearLists<2>;
template class NearLists<3>;

}  // namespace dsw
