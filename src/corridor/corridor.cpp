#include "corridor/corridor.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/compiler.h"
#include "base/dimensions.h"
#include "base/search.h"
#include "base/slot_pool.h"
#include "corridor/convex_cells.h"
#include "corridor/edge_turn.h"
#include "corridor/facet_pass.h"
#include "corridor/line_sides.h"
#include "predicates/filtered.h"
#include "predicates/tally.h"
#include "walk/shear.h"
#include "walk/standard_facets.h"

namespace dsw {
namespace {

template <int D>
using LineTests = std::conditional_t<D == 3, Shear, LineSides>;
uint64_t missed(Shear& line, const FacetSpan<3>& triangles) noexcept { return kMissedTriangles(line, triangles); }
uint64_t missed(LineSides& line, const FacetSpan<2>& sides) noexcept { return line.missed(sides); }

/** The first facet that a line does not pass, or how many there are. */
template <int D>
size_t first_missed(LineTests<D>& line, const FacetSpan<D>& facets) noexcept {
  for (size_t begin = 0; begin < facets.size(); begin += kMostMissed) {
    const uint64_t bits = missed(line, facets.part(begin, std::min(kMostMissed, facets.size() - begin)));
    if (bits != 0) return begin + lowest_bit(bits);
  }
  return facets.size();
}

/** Whether rows hold facets of a cell like this one: their corners are all that a line test needs. */
bool is_for_rows(const Map<3>& map, Cell c) noexcept { return map.form(c) == Form::kSimplex; }
bool is_for_rows(const Map<2>& map, Cell c) noexcept { return map.convex(c); }

/** The vertices of a facet that is kept in rows, in the order of its shape. */
template <int D>
struct Corners {
  uint32_t vertices[D];

  Corners(const Map<D>& map, uint32_t facet) noexcept {
    if constexpr (D == 3) {
      const uint32_t* const w = map.words.data() + facet / kUnitWords<3> * size_t{kUnitWords<3>};
      const uint8_t(&local)[3] = kTetrahedronFacets[facet % kUnitWords<3> - (kUnitWords<3> - 4)];
      for (int i = 0; i < 3; ++i) vertices[i] = w[local[i]] & kVertexMask;
    } else {
      const Cell c = map.cell_of({facet});
      const uint32_t side = map.local_of({facet}, c), next = side + 1;
      vertices[0] = map.vertex(c, side);
      vertices[1] = map.vertex(c, next == map.vertices_of(c) ? 0 : next);
    }
  }
};

/** Cells whose facets may be in rows, for turn_at. */
template <int D>
struct CellsOfRows : ConvexCells<D> {
  explicit CellsOfRows(const Map<D>& map_of_cells) : ConvexCells<D>{map_of_cells} {}

  bool suits(Cell c) const noexcept { return is_for_rows(this->map, c); }
};

/** What is known of facets in rows from `begin` to before `end`. */
template <int D>
void read_rows(const Environment<D>& env, Corridor<D>& corridor, size_t begin, size_t end) noexcept {
  for (size_t n = begin; n < end; ++n) {
    const Corners<D> corners(env.map, corridor.facets[n]);
    for (int i = 0; i < D; ++i) corridor.rows.set(n, i, env.point(corners.vertices[i]));
  }
}

/** Tells of facets in rows whether all are passable and their cells valid, in the plane also still convex. */
template <int D>
bool are_passable(const Environment<D>& env, const Array<uint32_t>& facets) noexcept {
  const Map<D>& map = env.map;
  uint32_t marks = 0;
  for (const uint32_t f : facets) {
    const Cell c = D == 3 ? Cell{f / kUnitWords<3>} : map.cell_of({f});
    if (D == 2 && !map.convex(c)) return false;
    marks |= map.record(c)[0] | map.words[f];
  }
  if ((marks & kMarkBit) != 0) return false;
  return !env.has_moved() ||
         dsw::all_of(facets.begin(), facets.end(), [&](uint32_t f) { return admits(env, map.cell_of({f})); });
}

/** Tells of facets that are not in rows whether all are passable and their cells valid. */
bool are_open(const Environment<3>& env, const Array<uint32_t>& facets) noexcept {
  const Map<3>& map = env.map;
  return dsw::all_of(facets.begin(), facets.end(), [&](uint32_t f) {
    const Cell c = map.cell_of({f});
    return ((map.record(c)[0] | map.words[f]) & kMarkBit) == 0 && admits(env, c);
  });
}
bool are_open(const Environment<2>&, const Array<uint32_t>&) noexcept { return false; }

/** Whether the facets are passable in the present version; where it is another one than before, reads them anew. */
template <int D>
bool renew(const Environment<D>& env, Corridor<D>& corridor) noexcept {
  if (corridor.portal.version == env.obstacle_version) return true;
  const Array<uint32_t>& facets = corridor.facets;
  if (corridor.in_rows ? !are_passable(env, facets) : !are_open(env, facets)) return false;
  if (corridor.in_rows) read_rows(env, corridor, 0, facets.size());
  corridor.note_portal(env);
  corridor.portal.version = env.obstacle_version;
  corridor.place_count = 0;
  return true;
}

/** Whether a line certainly passes facets that are not in rows, of cells that are exactly convex. */
bool pass(const Environment<3>& env, const double* from, const double* to, const Array<uint32_t>& facets) noexcept {
  const Map<3>& map = env.map;
  for (const uint32_t f : facets) {
    const Cell c = map.cell_of({f});
    if (!map.convex(c)) return false;
    const uint32_t* const w = map.record(c);
    const uint32_t facet = map.local_of({f}, c);
    if (has_standard_facets(form_of(w[0]))) {
      uint32_t vertices[4];
      standard_corners(w, facet, vertices);
      const double* const corners[4] = {env.point(vertices[0]), env.point(vertices[1]), env.point(vertices[2]),
                                        env.point(vertices[3])};
      if (!kPassesFacet(corners, from, to)) return false;
      continue;
    }
    const filter::Vec<3> way = filter::difference<3>(to, from);
    const Shape shape = map.shape(c);
    for (uint32_t d = shape.facet_first(facet); d < shape.facet_first(facet + 1); ++d) {
      const double *const x = env.point(c, shape.dart_vertex(d)), *const y =
                                                                      env.point(c, shape.dart_vertex(shape.beta1(d)));
      if (!passes_ridge(x, y, from, way)) return false;
    }
  }
  return true;
}

bool pass(const Environment<2>&, const double*, const double*, const Array<uint32_t>&) noexcept { return false; }

/** What a line passes on the wrong side of a facet that it does not pass. */
RidgeName missed_ridge(const Environment<3>& env, Shear& line, const Corners<3>& corners) noexcept {
  Shear::Point points[3];
  for (int i = 0; i < 3; ++i) points[i] = line(env.point(corners.vertices[i]));
  int side = 0;
  while (side < 2 && Shear::side(points[side], points[side + 1]) > 0) ++side;
  return {{corners.vertices[side], corners.vertices[(side + 1) % 3]}};
}
RidgeName missed_ridge(const Environment<2>& env, LineSides& line, const Corners<2>& corners) noexcept {
  const uint32_t vertex = corners.vertices[line.side(env.point(corners.vertices[0])) < 0 ? 1 : 0];
  return {{vertex, vertex}};
}

}  // namespace

HalfFacet other_at(const Map<3>& map, Cell c, HalfFacet entered, const RidgeName& edge) noexcept {
  const uint32_t* const w = map.record(c);
  HalfFacet other;
  for (uint32_t f = 0; f < 4; ++f) {
    const HalfFacet h{c.unit * kUnitWords<3> + kUnitWords<3> - 4 + f};
    const uint32_t tip = w[kTetrahedronTips[f]] & kVertexMask;
    const bool has_edge = (tip != edge.vertices[0]) & (tip != edge.vertices[1]);
    if (has_edge & (h.word != entered.word)) other = h;
  }
  return other;
}
HalfFacet other_at(const Map<2>& map, Cell c, HalfFacet entered, const RidgeName& vertex) noexcept {
  const uint32_t count = map.vertices_of(c), side = map.local_of(entered, c);
  const bool begins_there = map.vertex(c, side) == vertex.vertices[0];
  return map.half_facet(c, (side + (begins_there ? count - 1 : 1)) % count);
}

template <int D>
void Corridor<D>::replace(const Environment<D>& env, size_t begin, size_t end, const uint32_t* by, size_t count) {
  const size_t removed = end - begin, size = facets.size() - removed + count;
  const bool all = (in_rows || removed == facets.size()) &&
                   dsw::all_of(by, by + count, [&](uint32_t f) { return is_for_rows(env.map, env.map.cell_of({f})); });
  if (size > facets.size()) reserve_more(facets, size - facets.size());
  if (all) rows.reserve(size);
  const auto at = facets.erase(facets.begin() + static_cast<std::ptrdiff_t>(begin),
                               facets.begin() + static_cast<std::ptrdiff_t>(end));
  facets.insert(at, by, by + count);
  place_count = 0;
  if (all) {
    rows.replace(begin, in_rows ? removed : 0, count);
    in_rows = true;
    read_rows(env, *this, begin, begin + count);
  } else {
    rows.clear();
    in_rows = false;
  }
  note_portal(env);
}

template <int D>
bool Corridor<D>::pass(const Environment<D>& env, HalfFacet crossed, bool first) {
  const bool is_shorter = has_at(env, crossed, first);
  if (is_shorter) {
    remove(env, first);
  } else {
    add(env, first ? env.map.opposite(crossed) : crossed, first);
  }
  return !is_shorter;
}

template <int D>
void Corridor<D>::note_portal(const Environment<D>& env) noexcept {
  portal.forget();
  if (facets.empty() || !known()) return;
  const Map<D>& map = env.map;
  const HalfFacet facet{facets.front()}, beyond = map.opposite({facets.back()});
  if (!beyond.valid()) return;
  const Cell c = map.cell_of(facet);
  portal.front = c;
  portal.back = map.cell_of(beyond);
  if (facets.size() != 1) {
    if (in_rows) portal.corners[0] = Portal<D>::kInRows;
    return;
  }
  if constexpr (D == 3) {
    if (has_standard_facets(map.form(c))) standard_corners(map.record(c), map.local_of(facet, c), portal.corners);
  } else {
    if (in_rows) std::copy_n(Corners<2>(map, facet.word).vertices, 2, portal.corners);
  }
}

namespace {

/** Whether a line certainly passes a facet that is the only one. */
bool pass_only(const Environment<3>& env, const uint32_t (&v)[4], const double* from, const double* to) noexcept {
  const double* const corners[4] = {env.point(v[0]), env.point(v[1]), env.point(v[2]), env.point(v[3])};
  return kPassesFacet(corners, from, to);
}
bool pass_only(const Environment<2>& env, const uint32_t (&v)[2], const double* from, const double* to) noexcept {
  LineSides line(from, to);
  return line.pass(env.point(v[0]), env.point(v[1])) && line.passed_all();
}

bool keeps_to(const Environment<3>& env, const uint32_t (&v)[4], const EdgeWay& edge) noexcept {
  const double* const corners[4] = {env.point(v[0]), env.point(v[1]), env.point(v[2]), env.point(v[3])};
  return kKeepsToFacet(corners, edge);
}
bool keeps_to(const Environment<2>& env, const uint32_t (&v)[2], const EdgeWay& edge) noexcept {
  const auto passes = [&](const double* a, const double* b) {
    return pass_only(env, v, edge.from_first ? a : b, edge.from_first ? b : a);
  };
  return passes(edge.first, edge.other) && passes(edge.first_to, edge.other) && passes(edge.first_to, edge.other_to) &&
         (!edge.at_once || passes(edge.first, edge.other_to));
}

/** Whether an edge keeps to a facet that is not in rows. */
bool keeps_to_one(const Environment<3>& env, HalfFacet facet, const EdgeWay& edge) noexcept {
  const Map<3>& map = env.map;
  const Cell c = map.cell_of(facet);
  if (!map.convex(c) || !has_standard_facets(map.form(c))) return false;
  uint32_t corners[4];
  standard_corners(map.record(c), map.local_of(facet, c), corners);
  return keeps_to(env, corners, edge);
}
bool keeps_to_one(const Environment<2>&, HalfFacet, const EdgeWay&) noexcept { return false; }

/** Whether a line certainly passes all facets of a corridor in rows. */
bool pass_rows(const Corridor<3>& corridor, const double* from, const double* to) noexcept {
  return kPassesTriangles(from, to, corridor.rows.span(0, corridor.facets.size()));
}
bool pass_rows(const Corridor<2>& corridor, const double* from, const double* to) noexcept {
  LineSides line(from, to);
  const FacetSpan<2> facets = corridor.rows.span(0, corridor.facets.size());
  return first_missed<2>(line, facets) == facets.size() && line.passed_all();
}

}  // namespace

template <int D>
bool follows(const Environment<D>& env, Corridor<D>& corridor, const double* from, const double* to, Cell first,
             Cell last) noexcept {
  const Array<uint32_t>& facets = corridor.facets;
  if (!corridor.portal.is_only() && corridor.has_place(env.obstacle_version, from, to, first, last)) return true;
  if (facets.empty()) return first == last && env.map.convex(first);
  if (corridor.portal.version != env.obstacle_version && !(corridor.known() && renew(env, corridor))) return false;
  if (!corridor.portal.leads(env, first, last)) return false;
  // Asking one facet again costs no more than its last places.
  if (corridor.portal.is_only()) return pass_only(env, corridor.portal.corners, from, to);
  if (!(corridor.in_rows ? pass_rows(corridor, from, to) : pass(env, from, to, facets))) return false;
  corridor.note_place(from, to, first, last);
  return true;
}

template <int D>
bool keeps_to_portal(const Environment<D>& env, const Portal<D>& portal, const EdgeWay& edge) noexcept {
  return keeps_to(env, portal.corners, edge);
}

/** The portal is known to lead from cell to cell, so this asks less than `follows` would. */
template <int D>
bool keeps_to_rows(Corridor<D>& corridor, const EdgeWay& edge, bool swept) noexcept {
  struct Line {
    const double *from, *to;
  };
  const auto line = [&](const double* a, const double* b) { return edge.from_first ? Line{a, b} : Line{b, a}; };
  const auto passes = [&](const Line& each) { return pass_rows(corridor, each.from, each.to); };
  const Portal<D>& portal = corridor.portal;
  const Line before = line(edge.first, edge.other), between = line(edge.first_to, edge.other),
             after = line(edge.first_to, edge.other_to);
  if (swept && !corridor.has_place(portal.version, before.from, before.to, portal.front, portal.back) &&
      !passes(before)) {
    return false;
  }
  if (!passes(between) || (edge.other_to != edge.other && !passes(after))) return false;
  corridor.note_place(after.from, after.to, portal.front, portal.back);
  return true;
}

template <int D>
uint64_t missed_facets(const Environment<D>& env, const Corridor<D>& corridor, const EdgeWay& edge) noexcept {
  const size_t count = corridor.facets.size();
  uint64_t bits = 0;
  if (corridor.in_rows && count != 0) {
    for (const double* from : {edge.first, edge.first_to}) {
      for (const double* to : {edge.other, edge.other_to}) {
        LineTests<D> line(from, to);
        const uint64_t of_line = missed(line, corridor.rows.span(0, count));
        bits |= line.passed_all() ? of_line : ~uint64_t{0} >> (kMostMissed - count);
      }
    }
    return bits;
  }
  for (size_t n = 0; n < count; ++n) {
    if (!keeps_to_one(env, {corridor.facets[n]}, edge)) bits |= uint64_t{1} << n;
  }
  return bits;
}

template <int D>
bool keeps_to_facets(const Environment<D>& env, const Corridor<D>& corridor, const EdgeWay& edge) noexcept {
  return D == 3 && !corridor.in_rows && dsw::all_of(corridor.facets.begin(), corridor.facets.end(), [&](uint32_t f) {
           return keeps_to_one(env, {f}, edge);
         });
}

namespace {

/** A ridge of a facet, in space an edge, in the plane a vertex (both points are the same), that a line passes on the
 * facet's side if `side` is the sign of its line test. */
struct FacetRidge {
  const double *a, *b;
  int side;
};

/** Calls visit(ridge) for those of a facet until it returns false. */
template <int D, class Visit>
bool for_each_facet_ridge(const Environment<D>& env, HalfFacet facet, Visit visit) {
  int side = D == 3 ? 1 : -1;  // in the plane a line passes the first on the left
  return ConvexCells<D>{env.map}.for_each_ridge(facet, [&](uint32_t a, uint32_t b) {
    const bool goes_on = visit(FacetRidge{env.point(a), env.point(b), side});
    side = 1;
    return goes_on;
  });
}

bool is_same_ridge(const FacetRidge& a, const FacetRidge& b) noexcept {
  return (a.a == b.a && a.b == b.b) || (a.a == b.b && a.b == b.a);
}

/** Whether a ridge is that of an event of the moving edge itself. */
template <int D>
bool is_of_event(const EdgeMotion& m, const FacetRidge& ridge, const SweepEvent& event) noexcept {
  const double* const* const at = event.points;
  if (event.kind != EventKind::kEdge || at[0] != m.q) return false;
  if (D == 2) return at[1] == ridge.a;
  return (at[1] == ridge.a && at[2] == ridge.b) || (at[1] == ridge.b && at[2] == ridge.a);
}

/** Whether a ridge that the moving edge does not pass at the end of its way is met later than an event. */
template <int D>
bool is_met_later(const EdgeMotion& m, const FacetRidge& ridge, const SweepEvent& event) noexcept {
  const SweepEvent met{{m.q, ridge.a, D == 3 ? ridge.b : nullptr}, EventKind::kEdge};
  return compare_events<D>(m.p, m.to, met, event).sign > 0;
}

/** On which side a line passes the ridges of a facet in rows, in their order; 0: a filter cannot tell, ask exactly. */
void ridge_sides(const Environment<3>& env, Shear& line, HalfFacet facet, int (&sides)[3]) noexcept {
  const Corners<3> corners(env.map, facet.word);
  Shear::Point points[3];
  for (int i = 0; i < 3; ++i) points[i] = line(env.point(corners.vertices[i]));
  const bool in_range = line.is_in_range(line.largest());
  const double bound = Shear::bound(line.largest());
  for (int i = 0; i < 3; ++i) {
    const double side = Shear::side(points[i], points[(i + 1) % 3]);
    sides[i] = in_range && std::fabs(side) > bound ? (side > 0 ? 1 : -1) : 0;
  }
}
void ridge_sides(const Environment<2>&, LineSides&, HalfFacet, int (&)[3]) noexcept {}  // exact tests cost no more

}  // namespace

template <int D>
bool passes_before(const Environment<D>& env, const Corridor<D>& corridor, const EdgeMotion& m, bool p_first,
                   const SweepEvent& event) noexcept {
  const double *const from = p_first ? m.to : m.q, *const to = p_first ? m.q : m.to;
  const size_t count = corridor.facets.size();
  const bool in_rows = corridor.in_rows && corridor.portal.version == env.obstacle_version;
  if (D == 2 && !in_rows) return false;
  FacetRidge later{nullptr, nullptr, 0};  // the last that was found to be met later: the next facet may have it, too
  // If facets are in rows, only those that are not certainly passed are asked one by one; otherwise all facets are.
  for (size_t begin = 0; begin < count; begin += kMostMissed) {
    const size_t some = std::min(kMostMissed, count - begin);
    uint64_t ask = ~uint64_t{0} >> (kMostMissed - some);
    LineTests<D> line(from, to);
    if (in_rows) {
      const uint64_t bits = missed(line, corridor.rows.span(begin, some));
      if (line.passed_all()) ask = bits;
    }
    for (; ask != 0; ask &= ask - 1) {
      const HalfFacet facet{corridor.facets[begin + lowest_bit(ask)]};
      int sides[3] = {0, 0, 0}, next = 0;
      if (in_rows) ridge_sides(env, line, facet, sides);
      const bool is_passed = for_each_facet_ridge(env, facet, [&](const FacetRidge& ridge) {
        const int known = in_rows ? sides[next++] : 0;
        if (known != 0 && known == ridge.side) return true;
        if (is_of_event<D>(m, ridge, event) || is_same_ridge(ridge, later)) return true;
        const double* const ends[2] = {ridge.a, ridge.b};
        if (known == 0 && line_side<D>(from, to, ends, NoTally{}).sign == ridge.side) return true;
        if (!is_met_later<D>(m, ridge, event)) return false;
        later = ridge;
        return true;
      });
      if (!is_passed) return false;
    }
  }
  return true;
}

bool turn_in_rows(const Environment<3>& env, Corridor<3>& corridor, size_t begin, const RidgeName& edge) {
  return turn_at(env, corridor, begin, edge, CellsOfRows<3>(env.map));
}

template <int D>
bool turn(const Environment<D>& env, Corridor<D>& corridor, const double* from, const double* to, RidgeName& pivot) {
  if (!corridor.known() || !renew(env, corridor)) return false;
  if constexpr (D == 3) {
    if (!corridor.in_rows) return turn_round_edge(env, corridor, from, to, pivot);
  }
  if (!corridor.in_rows) return false;
  const Array<uint32_t>& facets = corridor.facets;
  LineTests<D> line(from, to);
  const size_t begin = first_missed<D>(line, corridor.rows.span(0, facets.size()));
  if (begin == facets.size()) return false;
  if constexpr (D == 3) {
    if (!line.is_in_range(line.largest())) return false;  // instruction sets differ in what overflows
  }
  pivot = missed_ridge(env, line, Corners<D>(env.map, facets[begin]));
  return turn_at(env, corridor, begin, pivot, CellsOfRows<D>(env.map));
}

bool share_corridor(const Map<3>& map, CorridorView ab, CorridorView bc, CorridorView ca) noexcept {
  // Facet i of a corridor in the direction of the view.
  const auto at = [&](const CorridorView& s, size_t i) {
    return s.turned ? map.opposite({s.facets[s.count - 1 - i]}).word : s.facets[i];
  };
  const auto is_sum = [&](const CorridorView& whole, const CorridorView& first, const CorridorView& second) {
    if (whole.count != first.count + second.count) return false;
    for (size_t i = 0; i < whole.count; ++i) {
      if (at(whole, i) != (i < first.count ? at(first, i) : at(second, i - first.count))) return false;
    }
    return true;
  };
  const auto turn = [](CorridorView s) { return CorridorView{s.facets, s.count, !s.turned}; };
  return is_sum(turn(ca), ab, bc) || is_sum(turn(ab), bc, ca) || is_sum(turn(bc), ca, ab);
}

template struct Corridor<2>;
template struct Corridor<3>;
DSW_INSTANTIATE(missed_facets);
DSW_INSTANTIATE(follows);
DSW_INSTANTIATE(keeps_to_portal);
DSW_INSTANTIATE(keeps_to_rows);
DSW_INSTANTIATE(keeps_to_facets);
DSW_INSTANTIATE(passes_before);
DSW_INSTANTIATE(turn);

}  // namespace dsw
