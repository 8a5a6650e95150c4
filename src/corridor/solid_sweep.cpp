// The solid's points are, at each time t, those of the face p(t) q r, in the plane of the edge p(t) q, so that whatever
// lies inside is met once.
//
// Why vertices are enough. Let the face meet what is impassable for the first time at t. Before that it was free, so it
// meets only the rim of an obstacle: of its vertices, edges and facets one that the face at t supports. If that touches
// an edge of the face, then the sweep of this edge has it (q r stays and was free). Else it is inside of the face. The
// time at which the face meets a point runs through a segment or facet inside of the tetrahedron without an extreme in
// between, or stays the same: its least value is taken at a vertex, or where it leaves the tetrahedron, at an edge of
// the face. So it is a vertex, at the same time. In the plane read edge for face, end for edge, and path for sweep of
// an edge.
//
// Why the flood sees it. What is swept before t is free, connected and holds p: the cells it meets are reached through
// passable facets that the solid meets. The vertex lies on the rim of what is swept, so in one of those cells; and
// since cells meet in whole vertices, edges and facets, it is a vertex of that cell. Everything the flood finds is
// inside of the solid and met at its time, so nothing is found too early.

#include "corridor/solid_sweep.h"

#include "base/sort.h"
#include "environment/marking.h"
#include "predicates/filtered.h"
#include "predicates/point_box.h"
#include "predicates/swept_triangle.h"
#include "predicates/tally.h"

namespace dsw {

// Vertices of the tetrahedron: p, p', q, r. Face i lies opposite of vertex i; it is counter-clockwise seen from outside
// if r lies on the outer side of p p' q, else all four are turned round.
template <>
struct SolidSweep<3>::Solid {
  static constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  static constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

  const double* at[4];
  int turn;  // +1 or -1; 0 if it is flat
  SweptTriangle faces[4];

  explicit Solid(const FaceMotion& m)
      : at{m.p, m.to, m.q, m.r}, turn(orient<3>(at, at[3])), faces{face(0), face(1), face(2), face(3)} {}

  SweptTriangle face(int i) const {
    return SweptTriangle(EdgeMotion{at[kFaces[i][0]], at[kFaces[i][1]], at[kFaces[i][2]]});
  }

  /** Bits of the sides of the solid's box that v lies beyond. Faces 0 and 3 together have all vertices. */
  uint32_t beyond_box(const double* v) const { return faces[0].beyond_box(v) & faces[3].beyond_box(v); }

  /** Bit i: beyond face i. 0: inside. */
  uint32_t beyond(const double* v) const {
    uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits |= (faces[i].side(v) == turn ? 1u : 0u) << i;
    return bits;
  }
  SweepEvent event(const double* v) const { return {{at[2], at[3], v}, EventKind::kFace}; }

  int line(int x, int y, const double* a, const double* b) const {
    const double* const ridge[2] = {a, b};
    return line_side<3>(at[x], at[y], ridge, NoTally{}).sign;
  }

  /** Whether a segment that lies on both sides of face i passes through it. */
  bool face_pierced(int i, const double* a, const double* b) const {
    const int(&f)[3] = kFaces[i];
    const int first = line(f[0], f[1], a, b);
    return line(f[1], f[2], a, b) == first && line(f[2], f[0], a, b) == first;
  }

  /** Whether a triangle of the environment, with `codes` from beyond(), meets the tetrahedron. What they share is a
   * convex polygon. If none of its corners is one of the triangle or lies on an edge of it, then it is all that the
   * tetrahedron has of the plane, and every edge of the tetrahedron that crosses the plane crosses the triangle. An
   * edge that meets the tetrahedron with both ends outside passes through two faces: one may be left out. */
  bool meets(const double* const* triangle, const uint32_t* codes) const {
    if ((codes[0] & codes[1] & codes[2]) != 0) return false;
    if (codes[0] == 0 || codes[1] == 0 || codes[2] == 0) return true;
    int sides[4];
    for (int i = 0; i < 4; ++i) sides[i] = plane_side<3>(triangle, at[i], NoTally{}).sign;
    if (sides[0] == sides[1] && sides[1] == sides[2] && sides[2] == sides[3]) return false;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      if ((codes[k] & codes[next]) != 0) continue;
      for (int i = 0; i < 3; ++i) {
        if (((codes[k] ^ codes[next]) >> i & 1u) != 0 && face_pierced(i, triangle[k], triangle[next])) return true;
      }
    }
    for (const int(&e)[2] : kEdges) {
      if (sides[e[0]] == sides[e[1]]) continue;
      for (int k = 0; k < 3; ++k) {
        if (line(e[0], e[1], triangle[k], triangle[(k + 1) % 3]) != sides[e[1]]) return false;
      }
      return true;
    }
    return false;
  }
};

// Vertices of the triangle: p, p', q. Side i lies opposite of vertex i.
template <>
struct SolidSweep<2>::Solid {
  const double* at[3];
  int turn;  // +1 or -1; 0 if it is flat
  PointBox<2> box;

  explicit Solid(const EdgeMotion& m) : at{m.p, m.to, m.q}, turn(0 - orient<2>(at, m.q)), box(m.p, m.to, m.q) {}

  uint32_t beyond_box(const double* v) const { return box.beyond(v); }

  /** Bit i: beyond side i. 0: inside. */
  uint32_t beyond(const double* v) const {
    uint32_t bits = 0;
    for (int i = 0; i < 3; ++i) {
      const int side = line_side<2>(at[(i + 1) % 3], at[(i + 2) % 3], &v, NoTally{}).sign;
      bits |= static_cast<uint32_t>(side != turn) << i;
    }
    return bits;
  }

  SweepEvent event(const double* v) const { return {{at[2], v, nullptr}, EventKind::kEdge}; }

  /** Whether a segment of the environment, with `codes` from beyond(), meets the triangle. If both ends lie outside,
   * but not of one side, and the line passes the triangle, then it enters that and leaves it between them: beyond the
   * exit all is outside of one side. */
  bool meets(const double* const* segment, const uint32_t* codes) const {
    if ((codes[0] & codes[1]) != 0) return false;
    if (codes[0] == 0 || codes[1] == 0) return true;
    const int first = plane_side<2>(segment, at[0], NoTally{}).sign;
    return plane_side<2>(segment, at[1], NoTally{}).sign != first ||
           plane_side<2>(segment, at[2], NoTally{}).sign != first;
  }
};

namespace {

/** Bits of the sides of a solid that a corner lies beyond. */
template <class Solid, class Corner>
uint32_t beyond(const Solid& solid, Corner& corner, int unknown) {
  if (corner.side == unknown) corner.side = static_cast<int>(solid.beyond(corner.at));
  return static_cast<uint32_t>(corner.side);
}

/** Order of half-facets by the indices of their cells. */
template <int D>
bool is_lower(const Map<D>& map, HalfFacet a, HalfFacet b) {
  const Cell x = map.cell_of(a), y = map.cell_of(b);
  return x != y ? map.index(x) < map.index(y) : map.local_of(a, x) < map.local_of(b, y);
}

}  // namespace

template <int D>
SolidSweep<D>::SolidSweep(const Environment<D>& env) : env_(env), map_(env.map) {}

template <int D>
void SolidSweep<D>::clear() {
  cells_.clear();
  lines_.clear();
  found_.clear();
  result_ = {};
}

template <int D>
SweepResult SolidSweep<D>::sweep(const SolidMotion<D>& m, Cell start, uint32_t max_volumes, bool collect) {
  clear();
  collect_ = collect;
  const Solid solid(m);
  if (solid.turn == 0) return result_;
  flood(start, max_volumes, [&](Cell c) {
    read_vertices(c, solid);
    look_at_inside_vertices(solid, c);
    enter_neighbours(solid, c);
  });
  // No two are equivalent: each vertex is tested once, and of equal times the numbers of vertices decide.
  dsw::sort(found_.begin(), found_.end(), [&](const SweepContact& a, const SweepContact& b) {
    return comes_before(map_, solid.at[0], solid.at[1], a, b);
  });
  return result_;
}

/** Enters what lies behind passable facets that the solid meets. */
template <int D>
void SolidSweep<D>::enter_neighbours(const Solid& solid, Cell c) {
  const Shape shape = map_.shape(c);
  for (uint32_t f = 0; f < shape.facet_count(); ++f) {
    const HalfFacet h = map_.half_facet(c, f), o = map_.opposite(h);
    if (!o.valid() || map_.facet_marked(h) || cells_.contains(Cell{o.word / kUnitWords<D>})) continue;
    for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
      if (!simplex_met(solid, shape.simplices() + D * s)) continue;
      if (!is_impassable(env_, h)) cells_.insert(map_.cell_of(o));
      break;
    }
  }
}

template <int D>
bool SolidSweep<D>::simplex_met(const Solid& solid, const uint16_t* local) {
  const double* simplex[D];
  uint32_t codes[D], common = ~0u;
  for (int k = 0; k < D; ++k) common &= corners_[local[k]].beyond;
  if (common != 0) return false;
  for (int k = 0; k < D; ++k) {
    simplex[k] = corners_[local[k]].at;
    codes[k] = beyond(solid, corners_[local[k]], kUnknown);
  }
  return solid.meets(simplex, codes);
}

/** Tests each vertex once; the lowest of the cells that see it is its front. */
template <int D>
void SolidSweep<D>::look_at_inside_vertices(const Solid& solid, Cell c) {
  const auto lower_front = [&](SweepContact& contact, uint32_t vertex) {
    if (contact.vertex == vertex && map_.index(c) < map_.index(contact.front)) contact.front = c;
  };
  for (Corner& corner : corners_) {
    if (corner.beyond != 0 || beyond(solid, corner, kUnknown) != 0) continue;
    lower_front(result_.contact, corner.vertex);
    bool first_time = false;
    const uint32_t place = lines_.value(corner.vertex, kNoVertex, [&] {
      first_time = true;
      return static_cast<uint32_t>(found_.size());
    });
    if (first_time) {
      test_corner(solid, c, corner);
    } else if (place < found_.size()) {
      lower_front(found_[place], corner.vertex);
    }
  }
}

/** Keeps an impassable vertex if it is the earliest. */
template <int D>
void SolidSweep<D>::test_corner(const Solid& solid, Cell c, const Corner& corner) {
  SweepContact& best = result_.contact;
  SweepContact found;
  if (!test_vertex(c, corner.vertex, found.facet)) return;
  found.event = solid.event(corner.at);
  found.front = c;
  found.vertex = corner.vertex;
  if (collect_) found_.push_back(found);
  if (result_.end == SweepEnd::kContact && !comes_before(map_, solid.at[0], solid.at[1], found, best)) return;
  result_.end = SweepEnd::kContact;
  best = found;
}

/** Whether a vertex of cell c is impassable, and its lowest impassable facet, seen from where one can be. All cells
 * round it are linked through facets at it, but for vertices of the outer boundary, where each part of them has facets
 * of that. */
template <int D>
bool SolidSweep<D>::test_vertex(Cell c, uint32_t vertex, HalfFacet& facet) {
  bool impassable = vertex_marked(env_, vertex);
  HalfFacet lowest;
  around_.clear();
  around_.insert(c);
  for (size_t i = 0; i < around_.size(); ++i) {
    const Cell at = around_[i];
    const Shape shape = map_.shape(at);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      bool has_vertex = false;
      for_each_facet_vertex<D>(shape, f, [&](uint32_t v) { has_vertex = has_vertex || map_.vertex(at, v) == vertex; });
      if (!has_vertex) continue;
      const HalfFacet h = map_.half_facet(at, f), o = map_.opposite(h);
      if (o.valid()) around_.insert(map_.cell_of(o));
      if (!is_impassable(env_, h)) continue;
      impassable = true;
      const HalfFacet name = canonical(map_, h);
      if (!lowest.valid() || is_lower(map_, name, lowest)) lowest = name;
    }
    for (uint32_t d = 0; env_.marked_edges != 0 && !impassable && d < shape.dart_count(); ++d) {
      if (map_.vertex(at, shape.dart_vertex(d)) != vertex) continue;
      impassable = edge_marked(env_, vertex, map_.vertex(at, shape.dart_vertex(shape.beta1(d))));
    }
  }
  const bool from_behind = lowest.valid() && is_closed(env_, map_.cell_of(lowest)) && map_.opposite(lowest).valid();
  facet = from_behind ? map_.opposite(lowest) : lowest;
  return impassable;
}

template class SolidSweep<2>;
template class SolidSweep<3>;

}  // namespace dsw
