#pragma once
// The corridor of facets that an edge passes through on its way: kept from move to move, it is the edge's own forecast.

#include <algorithm>

#include "base/compiler.h"
#include "corridor/facet_pass.h"
#include "corridor/moving_part.h"
#include "corridor/ridge.h"
#include "environment/environment.h"
#include "predicates/sweep_events.h"
#include "walk/cast.h"
#include "walk/facet_rows.h"
#include "walk/prefetch.h"

namespace dsw {

/** A way from one cell to another through facets that are passable, in some version of an environment: true of that
 * whatever an edge does. */
template <int D>
struct Portal {
  static constexpr uint64_t kNever = ~uint64_t{0};
  static constexpr uint32_t kInRows = ~uint32_t{0} - 1, kNoCorner = ~uint32_t{0};

  uint64_t version = kNever;
  Cell front, back;  // invalid: no way is known, or it passes no facet
  /** The corners of the only facet, in its order; a triangle repeats the last one. kInRows: there are several in rows.
   * kNoCorner: there is no facet, or they are of other cells. */
  uint32_t corners[D == 3 ? 4 : 2];

  Portal() noexcept { forget(); }
  void forget() noexcept {
    front = back = {};
    corners[0] = kNoCorner;
  }
  bool is_only() const noexcept { return corners[0] < kInRows; }
  /** Whether it leads from one cell to another, both of them exactly convex. */
  bool leads(const Environment<D>& env, Cell first, Cell last) const noexcept {
    return front == first && back == last && env.map.convex(first) && env.map.convex(last) && !is_closed(env, last);
  }
};

/** Half-facets in order. A copy has room for one, so that it can be forgotten without memory. */
struct PassedFacets : Array<uint32_t> {
  explicit PassedFacets(const Allocator<uint32_t>& allocator) : Array<uint32_t>(allocator) {}
  PassedFacets(const PassedFacets& other) : Array<uint32_t>(other) { reserve(1); }
  PassedFacets(PassedFacets&&) noexcept = default;
  PassedFacets& operator=(const PassedFacets& other) {
    reserve(std::max<size_t>(other.size(), 1));
    Array<uint32_t>::operator=(other);
    return *this;
  }
  PassedFacets& operator=(PassedFacets&&) = default;
  ~PassedFacets() = default;
};

/** The half-facets that an edge was last known to pass, each seen from the cell that is left; one kNoFacet: unknown. */
template <int D>
struct Corridor {
  Portal<D> portal;  // through the facets
  PassedFacets facets;
  bool in_rows = true;  // they are of tetrahedra, in the plane of convex polygons
  FacetRows<D> rows;    // the facets, of that version; only if they are in rows

  /** A segment that is known to pass them in that version, from cell to cell. */
  struct Place {
    double from[D] = {}, to[D] = {};
    Cell first, last;

    bool is(const double* a, const double* b, Cell of_a, Cell of_b) const noexcept {
      return a[0] == from[0] && b[0] == to[0] && std::equal(a, a + D, from) && std::equal(b, b + D, to) &&
             first == of_a && last == of_b;
    }
  };
  Place places[2];  // the last two: where an edge stands, and where it goes
  uint32_t place_count = 0, last_place = 0;

  // The facets as they were when a call on the body began, if they have changed since; see keep_forecasts.
  PassedFacets kept;
  uint64_t kept_in = 0;  // the number of that call
  bool kept_in_rows = true;

  /** Before the facets change in a call. Throws std::bad_alloc. */
  void keep(uint64_t call) {
    if (kept_in == call) return;
    kept.assign(facets.begin(), facets.end());
    kept_in_rows = in_rows;
    kept_in = call;
  }
  /** Makes the facets those of before the call. */
  void go_back(uint64_t call) noexcept {
    if (kept_in != call) return;
    facets.swap(kept);
    in_rows = kept_in_rows;
    kept_in = 0;
    rows.clear();
    if (in_rows) rows.replace(0, 0, facets.size());  // read anew with the portal, as its version says
    portal = {};
    place_count = 0;
  }

  bool has_place(uint64_t of_version, const double* from, const double* to, Cell first, Cell last) const noexcept {
    if (place_count == 0 || portal.version != of_version) return false;
    return places[last_place].is(from, to, first, last) ||
           (place_count == 2 && places[1 - last_place].is(from, to, first, last));
  }
  void note_place(const double* from, const double* to, Cell first, Cell last) noexcept {
    last_place = 1 - last_place;
    place_count = std::min(place_count + 1, 2u);
    Place& place = places[last_place];
    for (int k = 0; k < D; ++k) {
      place.from[k] = from[k];
      place.to[k] = to[k];
    }
    place.first = first;
    place.last = last;
  }

  explicit Corridor(const Allocator<uint32_t>& allocator) : facets(allocator), rows(allocator), kept(allocator) {}

  void clear() noexcept {
    facets.clear();
    rows.clear();
    in_rows = true;
    portal.forget();
    place_count = 0;
  }
  /** Makes what is known unknown. There is room for one facet. */
  void forget() noexcept {
    facets.resize(1);
    facets[0] = kNoFacet;
    rows.clear();
    in_rows = false;
    portal.forget();
    place_count = 0;
  }
  bool known() const noexcept { return facets.empty() || facets[0] != kNoFacet; }
  /** Puts `count` facets where those from `begin` to before `end` are. Throws std::bad_alloc, and then what was known
   * still is; not if there are none more than before. */
  void replace(const Environment<D>& env, size_t begin, size_t end, const uint32_t* by, size_t count);
  void assign(const Environment<D>& env, const Array<uint32_t>& passed) {
    replace(env, 0, facets.size(), passed.data(), passed.size());
  }
  /** One more or one less, first or last. */
  void add(const Environment<D>& env, HalfFacet facet, bool first) {
    const size_t at = first ? 0 : facets.size();
    replace(env, at, at, &facet.word, 1);
  }
  void remove(const Environment<D>& env, bool first) noexcept {
    const size_t at = first ? 0 : facets.size() - 1;
    replace(env, at, at + 1, nullptr, 0);
  }
  /** Whether an end that passes a facet, seen from the cell that it leaves, goes along the corridor. */
  bool has_at(const Environment<D>& env, HalfFacet crossed, bool first) const noexcept {
    const HalfFacet left = first ? crossed : env.map.opposite(crossed);
    return !facets.empty() && (first ? facets.front() : facets.back()) == left.word;
  }
  /** The path of the first or the last end has passed a facet, seen from the cell that it has left. Whether the corridor
   * has one facet more now; else it has one less. Throws std::bad_alloc. */
  bool pass(const Environment<D>& env, HalfFacet crossed, bool first);
  /** To be called when facets have changed, or been read anew. */
  void note_portal(const Environment<D>& env) noexcept;
};

/** Whether a segment from a point in `first` to a point in `last` leaves its cells through just these half-facets, all
 * passable. Cells are exactly convex with flat facets. False also where a filter cannot tell: then the segment must be
 * cast. Much cheaper than a cast: nothing waits for a decision. Notes the place; returns true at once for the last two places
 * that have passed several facets. O(facets). */
template <int D>
bool follows(const Environment<D>& env, Corridor<D>& corridor, const double* from, const double* to, Cell first,
             Cell last) noexcept;

/** What keeps_to_rows will read of a corridor whose portal is known. */
template <int D>
DSW_PREFETCH void prefetch_way(const Environment<D>& env, const Corridor<D>& corridor) noexcept {
  prefetch_record(env, corridor.portal.front);
  prefetch_record(env, corridor.portal.back);
  if (corridor.portal.is_only() || !corridor.in_rows) return;
  const FacetSpan<D> rows = corridor.rows.span(0, corridor.facets.size());
  for (int corner = 0; corner < D; ++corner) {
    for (int axis = 0; axis < D; ++axis) {
      prefetch_line(rows.row(corner, axis));
      prefetch_line(rows.row(corner, axis) + rows.size());
    }
  }
}

/** Whether an edge passes the facet of a portal before, between and after the moves of its ends, which stay in the
 * cells at it. As `follows` for each of the lines. */
template <int D>
bool keeps_to_portal(const Environment<D>& env, const Portal<D>& portal, const EdgeWay& edge) noexcept;
/** Whether an edge passes all facets of a corridor in rows, of the present version, between and after the moves of its
 * ends. The ends stay in the first and the last cell of the portal. Notes where the edge arrives.
 * @param swept whether the edge must pass the facets where it starts, too. */
template <int D>
bool keeps_to_rows(Corridor<D>& corridor, const EdgeWay& edge, bool swept) noexcept;
/** Tells whether an edge passes all facets of a corridor between and after the moves of its ends, as keeps_to_rows
 * does, if the facets are not in rows and are passable in the present version. */
template <int D>
bool keeps_to_facets(const Environment<D>& env, const Corridor<D>& corridor, const EdgeWay& edge) noexcept;

/** Whether edge p q meets no ridge of its corridor before `event` while p goes to `to`. The corridor is that of the
 * edge at the start; facets that the path of p passes have been added or removed. On which side the line through p and
 * q passes a ridge is linear in time. So a ridge that has the right side at the end is never met; of the others the
 * time is compared. The ridge of `event` itself is left out. Exact. False in the plane where the corridor is not kept in rows.
 * @param p_first whether the corridor begins at p. */
template <int D>
bool passes_before(const Environment<D>& env, const Corridor<D>& corridor, const EdgeMotion& m, bool p_first,
                   const SweepEvent& event) noexcept;

template <int D>
PathFacets path_facets(const Map<D>& map, Cell start, const CastResult& path) noexcept;

/** Looks at an edge both of whose ends move at once, and at a corridor of at most kMostMissed facets: bit n is set
 * unless all lines of the edge certainly pass facet n. */
template <int D>
uint64_t missed_facets(const Environment<D>& env, const Corridor<D>& corridor, const EdgeWay& edge) noexcept;

/** The other facet of a cell of rows at a pivot of `entered`. */
HalfFacet other_at(const Map<3>& map, Cell c, HalfFacet entered, const RidgeName& edge) noexcept;
HalfFacet other_at(const Map<2>& map, Cell c, HalfFacet entered, const RidgeName& vertex) noexcept;

/** Turns a corridor that is kept in rows round the first pivot that the segment passes on the wrong side: what it then
 * passes is the other half of the facets there. The corridor may still not be that of the segment. False, and nothing
 * is changed: there is no such pivot, or no passable way round it. Throws std::bad_alloc. */
template <int D>
bool turn(const Environment<D>& env, Corridor<D>& corridor, const double* from, const double* to, RidgeName& pivot);
/** Turns one that is kept in rows round an edge of its facet `begin`, the first that has it. */
bool turn_in_rows(const Environment<3>& env, Corridor<3>& corridor, size_t begin, const RidgeName& edge);

/** A corridor as it was noted, or passed the other way round. */
struct CorridorView {
  const uint32_t* facets = nullptr;
  size_t count = 0;
  bool turned = false;
};

/** Whether the three sides of a triangle, a to b, b to c and c to a, lie in the same corridor: one of them
 * passes what the two others pass, one after the other. Each has been found by `follows`, so it passes every facet
 * where all lines of that look the same way; there the facet is convex, and the cells are, so the triangle lies in the
 * corridor and no edge of a cell pierces it. Asked of faces, so not in the plane. */
bool share_corridor(const Map<3>& map, CorridorView ab, CorridorView bc, CorridorView ca) noexcept;

/** Notes the half-facets that casts pass. A cast allocates nothing: what finds no room makes the corridor unknown, and
 * room for the next time is made by `finish`. */
template <int D>
class CorridorWriter {
 public:
  explicit CorridorWriter(const Memory* memory) : facets_(memory) {}

  /** Both must outlive the cast. Throws std::bad_alloc the first time. */
  void attach(const Environment<D>& env, CastRequest& request) {
    facets_.reserve(kFirstRoom);
    env_ = &env;
    facets_.clear();
    passed_ = 0;
    request.crossing = write;
    request.crossing_user = this;
  }
  /** Casts a segment, and notes what it passes. Whether it is free and ends in `end`, if that is valid. Throws
   * std::bad_alloc the first time. */
  bool cast_segment(const Environment<D>& env, const double* from, const double* to, Cell start, Cell end,
                    CastCounters* counters);
  /** Whether there was room for all that a cast passed. If not, makes room for the next cast. Throws std::bad_alloc. */
  bool had_room() {
    if (passed_ == facets_.size()) return true;
    facets_.reserve(2 * passed_);
    return false;
  }
  bool passed_none() const noexcept { return passed_ == 0; }
  /** What a cast passed, until the next one. */
  const Array<uint32_t>& passed() const noexcept { return facets_; }
  /** Copies the corridor of a cast that reached its target. Throws std::bad_alloc. */
  void finish(Corridor<D>& corridor);

 private:
  static constexpr size_t kFirstRoom = 16;
  static void write(void* user, Cell from, uint32_t simplex, Cell to) noexcept;

  const Environment<D>* env_ = nullptr;
  Array<uint32_t> facets_;
  size_t passed_ = 0;
};

}  // namespace dsw
