#include "proximity/near_lists.h"

#include <algorithm>
#include <cmath>

#include "walk/cast.h"

namespace dsw {
namespace {

// How many simplices share a list at most, if their slots follow each other: a power of 2.
constexpr uint32_t kSharing = 8;
// They share one if what is flooded for all is less than this part of what would be flooded for each.
constexpr double kLessFlooded = 0.75;
// How far obstacles are listed and selected beyond the reach, times the reach. Longer lists are made less often. All
// features that are selected are looked at in each call, so fewer of them are selected.
constexpr double kListedMore = 2, kSelectedMore = 1, kSelectedMoreFeatures = 0.25;
// Obstacles are listed less far beyond the reach if the environment has changed since the last list, as it may change
// again.
constexpr double kListedMoreAfterChange = 0.25;

/** From 0.6 to 1.4, spread evenly over successive numbers. What was found for a body at one time is out of date at
 * different times, so that no call has to find all of it again. */
double spread(uint64_t number) noexcept {
  constexpr uint64_t kGolden = 0x9e3779b97f4a7c15;  // 2^64 times the golden section
  return 0.6 + 0.8 * 0x1p-64 * static_cast<double>(number * kGolden);
}

template <int D>
Array<NearNote<D>>& notes_of(NearNotes<D>& all, Simplex::Kind kind) noexcept {
  return kind == Simplex::kVertex ? all.of_vertices : kind == Simplex::kEdge ? all.of_edges : all.of_faces;
}

template <int D>
bool is_outer(const Body<D>& body, const Simplex& s) noexcept {
  const bool exists = s.kind == Simplex::kVertex ? body.has_vertex(s.index)
                      : s.kind == Simplex::kEdge ? body.has_edge(s.index)
                                                 : body.has_face(s.index);
  return exists && !is_covered(body, s);
}

/** Simplices that share a list. */
template <int D>
struct Sharers {
  uint32_t count = 0;
  Simplex simplices[kSharing];
  Cell starts[kSharing];

  void add(const Body<D>& body, const Part<D>& part) noexcept {
    simplices[count] = part.simplex;
    starts[count++] = body.vertices[part.corners.vertices[0]].cell;
  }
};

/** The region of a part and of those that share a list with it: as many as it pays for. */
template <int D>
NearRegion<D> find_sharers(const Body<D>& body, const Part<D>& part, double room, Sharers<D>& sharers) noexcept {
  for (uint32_t size = kSharing; size > 1; size /= 2) {
    sharers.count = 0;
    const uint32_t begin = part.simplex.index / size * size;
    for (uint32_t i = begin; i < begin + size; ++i) {
      const Simplex s{part.simplex.kind, i};
      if (i == part.simplex.index || is_outer(body, s)) sharers.add(body, Part<D>(body, s));
    }
    if (sharers.count == 1) continue;
    const Part<D> first(body, sharers.simplices[0]), last(body, sharers.simplices[sharers.count - 1]);
    const double* const ends[] = {first.points[0], last.points[last.corners.count - 1]};
    NearRegion<D> all(ends, 2, room);
    double each = 0;
    for (uint32_t i = 0; i < sharers.count; ++i) {
      const Part<D> sharer(body, sharers.simplices[i]);
      for (uint32_t k = 0; k < sharer.corners.count; ++k) all.add(sharer.points[k]);
      each += NearRegion<D>(sharer.points, sharer.corners.count, room).volume();
    }
    if (all.volume() < kLessFlooded * each) return all;
  }
  sharers.count = 0;
  sharers.add(body, part);
  return {part.points, part.corners.count, room};
}

}  // namespace

template <int D>
void Anchor<D>::set(const Part<D>& part, const SelectionLimits& known) noexcept {
  for (uint32_t i = 0; i < part.corners.count; ++i) std::copy_n(part.points[i], D, corners[i]);
  limits = known;
}

template <int D>
uint64_t NearNotes<D>::memory_bytes() const {
  uint64_t bytes = array_bytes(of_vertices) + array_bytes(of_edges) + array_bytes(of_faces);
  for (const auto* notes : {&of_vertices, &of_edges, &of_faces}) {
    for (const NearNote<D>& each : *notes) bytes += each.list.memory_bytes() + each.near.memory_bytes();
  }
  return bytes;
}

// All that a new flood would enter lies within the room of the anchors. The flood that made the list has entered it,
// too, if that flood has come to the cell where the new one would start. It has if both start in the same cell. It also
// has if a straight way leads there from the anchor through passable cells, since that way lies within the room.
template <int D>
bool NearLists<D>::is_current(const Body<D>& body, const Part<D>& part, const Array<NearNote<D>>& notes,
                              NearNote<D>& note) const noexcept {
  if (note.number == 0 || note.number != notes[note.owner].list_number) return false;
  if (note.version != env_.change_version) return false;
  const Cell now = body.vertices[part.corners.vertices[0]].cell;
  if (now == note.connected || now == note.start) return true;
  const CastResult there = cast(env_, note.listed.corners[0], part.points[0], note.start);
  if (there.end == CastEnd::kHit || there.cell != now) return false;
  note.connected = now;
  return true;
}

template <int D>
void NearLists<D>::make_list(const Body<D>& body, const Part<D>& part, double room, Array<NearNote<D>>& notes,
                             uint64_t number) {
  Sharers<D> sharers;
  const NearRegion<D> region = find_sharers(body, part, room, sharers);
  const uint32_t owner = sharers.simplices[0].index;
  NearList<D>& list = notes[owner].list;
  notes[owner].list_number = 0;  // until the list is whole
  list.clear();
  flood_.find(sharers.starts, sharers.count, region, list);
  list.finish({env_.points, D}, has_features_);
  notes[owner].list_number = number;
  for (uint32_t i = 0; i < sharers.count; ++i) {
    NearNote<D>& note = notes[sharers.simplices[i].index];
    note.listed.set(Part<D>(body, sharers.simplices[i]), {room, room});
    note.selected.forget();
    note.version = env_.change_version;
    note.number = number;
    note.owner = owner;
    note.start = note.connected = sharers.starts[i];
  }
}

template <int D>
bool NearLists<D>::is_alone(const Body<D>& body, const Part<D>& part, double reach, NearNotes<D>& all) const noexcept {
  Array<NearNote<D>>& notes = notes_of(all, part.simplex.kind);
  if (part.simplex.index >= notes.size()) return false;
  NearNote<D>& note = notes[part.simplex.index];
  const bool is_alone = has_features_ ? note.near.is_alone() : note.near.empty();
  return is_alone && note.selected.holds(reach, note.selected.way_to(part)) && is_current(body, part, notes, note);
}

template <int D>
NearView<D> NearLists<D>::near(const Body<D>& body, const Part<D>& part, uint32_t places, double reach,
                               NearNotes<D>& all, double wanted) {
  Array<NearNote<D>>& notes = notes_of(all, part.simplex.kind);
  while (notes.size() < (part.simplex.index / kSharing + 1) * size_t{kSharing}) notes.emplace_back(env_.memory);
  NearNote<D>& note = notes[part.simplex.index];
  const bool is_selected = (places & ~note.places) == 0 && note.selected.holds(reach, note.selected.way_to(part));
  bool has_list = is_selected || note.listed.holds(reach, note.listed.way_to(part));
  has_list = has_list && is_current(body, part, notes, note);
  if (!has_list || !is_selected) {
    const double far = std::max(reach, wanted);
    const double varied = spread(++all.found);
    const bool is_changed = note.number != 0 && note.version != env_.change_version;
    const double listed_more = is_changed ? kListedMoreAfterChange : kListedMore;
    if (!has_list) make_list(body, part, (1 + listed_more * varied) * far, notes, all.found);
    note.selected.forget();  // until the selection is whole
    const NearList<D>& list = notes[note.owner].list;
    const double left = note.listed.limits.room - note.listed.way_to(part);
    const double more = (has_features_ ? kSelectedMoreFeatures : kSelectedMore) * varied * far;
    const SelectionLimits limits{far + more, more};
    note.places = places;
    note.selected.set(part, has_features_ ? note.near.select_features(list, part, places, limits, left)
                                          : note.near.select_all(list, part, limits, left));
  }
  return {notes[note.owner].list, note.near};
}

template <int D>
const NearList<D>& NearLists<D>::in(Cell start, const NearRegion<D>& region) {
  fresh_.clear();
  flood_.find(&start, 1, region, fresh_);
  fresh_.finish({env_.points, D}, has_features_);
  return fresh_;
}

template struct NearNotes<2>;
template struct NearNotes<3>;
template class NearLists<2>;
template class NearLists<3>;

}  // namespace dsw
