#pragma once
// A cell on paper: what an operation wants a cell to become, before anything is changed.

#include <algorithm>

#include "base/search.h"
#include "base/short_array.h"
#include "environment/environment.h"

namespace dsw {

constexpr uint32_t kNoPair = 0xffffffffu;

/** The vertices of one facet: seldom more than a dozen. */
using Vertices = ShortArray<uint32_t, 12>;

/** One facet. Vertices are those of the environment. A side of the plane's polygons has its two ends for a loop, in the
 * polygon's order, and no triangles. */
struct FacetDraft {
  Vertices loop;        // counter-clockwise seen from outside
  Vertices triangles;   // three vertices each, oriented likewise, that fill the loop
  HalfFacet near, far;  // what it comes from, and what is behind it: as before the edit, where both may be about to go
  uint32_t pair = kNoPair;  // of a new facet between two new cells: a number that both sides have
  bool marked = false;
  uint32_t exit_patch = 0;  // of the exit that it is, if it stays on the outer boundary; 0: none

  explicit FacetDraft(const Memory* memory) : loop(memory), triangles(memory) {}

  uint32_t place_of(uint32_t vertex) const {
    const auto size = static_cast<uint32_t>(loop.size());
    uint32_t place = 0;  // most loops are short: no call of a function
    while (place < size && loop[place] != vertex) ++place;
    return place;
  }
  bool has(uint32_t vertex) const { return place_of(vertex) != loop.size(); }
  /** The vertex `steps` after the one in a place of the loop; both together less than twice round it. */
  uint32_t after(uint32_t place, size_t steps = 1) const {
    const size_t at = place + steps;
    return loop[at < loop.size() ? at : at - loop.size()];
  }
};

struct CellDraft {
  Array<FacetDraft> facets;
  Cell from;         // what it comes from; invalid: out of nothing. Label, tag and index are those of this
  Array<Cell> also;  // further cells that it comes from
  bool keeps_index = true;
  bool marked = false;
  int32_t region = 0;
  uint32_t tag = 0;
  uint32_t parent = kNoCell;  // of `from`; set when the edit is prepared

  explicit CellDraft(const Memory* memory) : facets(memory), also(memory) {}
};

/** A facet as it is. */
template <int D>
FacetDraft draft_of(const Environment<D>& env, HalfFacet h);
/** A cell as it is. */
template <int D>
CellDraft draft_of(const Environment<D>& env, Cell c);

/** Number of the draft's facet that comes from `h`. */
inline uint32_t facet_from(const CellDraft& draft, HalfFacet h) {
  uint32_t f = 0;
  while (draft.facets[f].near != h) ++f;
  return f;
}

/** Whether two facets seen from opposite sides have the same vertices. */
bool face_each_other(const FacetDraft& a, const FacetDraft& b);
/** Whether the triangles of two such facets are the same, too. */
bool cut_alike(const FacetDraft& a, const FacetDraft& b);
/** Gives a facet the triangles of the one that it faces. */
void cut_like(FacetDraft& facet, const FacetDraft& other);

/** Gives a facet as it is seen from the other side. */
FacetDraft turned(const FacetDraft& facet);

/** The part of a facet's loop from one of its vertices to another, without triangles. */
FacetDraft part_of(const FacetDraft& whole, uint32_t from, uint32_t to);
/** Shares a facet's triangles out between its parts; false where one lies in none. */
bool share_triangles(const FacetDraft& whole, FacetDraft& a, FacetDraft& b);
/** Puts a vertex between two neighbours of a facet's loop, into the triangle there; whether they are neighbours. */
bool insert_between(FacetDraft& facet, uint32_t a, uint32_t b, uint32_t middle);
/** Puts a vertex on an edge of a draft: into the two facets at a dart of the cell that was drafted. The draft has the
 * cell's facets in their order. */
void insert_vertex(CellDraft& draft, const Shape& shape, uint32_t dart, uint32_t a, uint32_t b, uint32_t middle);
/** Puts a vertex on the edge that joins two vertices, if the cell has it; in the plane a side, which becomes two. */
void insert_vertex(CellDraft& draft, uint32_t a, uint32_t b, uint32_t middle);
/** Shares a cell's facets out, which it loses: to `left` those on the left of a closed loop of its edges, seen from
 * outside; in the plane those on the left of the way from one vertex to another. False if that is all. */
bool part_along(CellDraft& whole, const Vertices& loop, CellDraft& left, CellDraft& right);

/** Numbers of a polygon's sides, each after the one before it, from side `first` on. False where they do not close one
 * loop. */
bool order_sides(const CellDraft& draft, uint32_t first, Array<uint32_t>& out);

/** Whether the triangles of a facet are positive seen from a point, and negative from `beyond` unless that is null. */
bool is_cut_well(const Environment<3>& env, const FacetDraft& facet, const double* apex, const double* beyond);
/** Adds triangles to a facet that fill `hole` and are such; false if there are none. Throws TOO_LARGE where it is not
 * worth the search. */
bool cut_anew(const Environment<3>& env, FacetDraft& facet, const Vertices& hole, const double* apex,
              const double* beyond);

/** Numbers vertices in the order of first use, in which they are listed. Most are found where the last one was that
 * has the same last bits. */
class Numbering {
 public:
  explicit Numbering(Array<uint32_t>& listed) : listed_(listed) { std::fill_n(last_, kPlaces, Last{kNoCell, 0}); }
  uint32_t operator()(uint32_t vertex) {
    Last& last = last_[vertex % kPlaces];
    if (last.vertex != vertex) last = {vertex, find(vertex)};
    return last.number;
  }

 private:
  static constexpr uint32_t kPlaces = 64;

  struct Last {
    uint32_t vertex, number;
  };

  uint32_t find(uint32_t vertex) {
    const auto at = dsw::find(listed_.begin(), listed_.end(), vertex);
    const auto number = static_cast<uint32_t>(at - listed_.begin());
    if (at == listed_.end()) listed_.push_back(vertex);
    return number;
  }

  Array<uint32_t>& listed_;  // empty at first
  Last last_[kPlaces];
};

/** Vertices of a draft, each once, in the order of first use. */
void list_vertices(const CellDraft& draft, Array<uint32_t>& out);
/** The mean of a draft's vertices in that order. */
template <int D>
void centre(const Environment<D>& env, const CellDraft& draft, double* out);

}  // namespace dsw
