// The tetrahedron that a face p q r sweeps when p goes to p'. Its points are, at each time t, those of the triangle p(t) q r, so
// that whatever lies inside is met once.
//
// Why vertices are enough. Let the face meet what is impassable for the first time at t. Before that it was free, so it meets
// only the rim of an obstacle: of its vertices, edges and facets one that the face at t supports. If that touches an edge of the
// face, then the sweep of this edge has it (q r stays and was free). Else it is inside of the face. The time at which the
// face meets a point runs through a segment or facet inside of the tetrahedron without an extreme in between, or stays the same: its least
// value is taken at a vertex, or where it leaves the tetrahedron, at an edge of the face. So it is a vertex, at the same time.
//
// Why the flood sees it. What is swept before t is free, connected and holds p: the cells it meets are reached through passable
// facets that the tetrahedron meets. The vertex lies on the rim of what is swept, so in one of those cells; and since cells
// meet in whole vertices, edges and facets, it is a vertex of that cell. Everything the flood finds is inside of the
// tetrahedron and met at its time, so nothing is found too early.

#include "environment/marking.h"
#include "motion/sweep.h"
#include "predicates/filtered.h"
#include "predicates/tally.h"

namespace dsw {
namespace {

// Vertices of the tetrahedron: p, p', q, r. Face i lies opposite of vertex i; it is counter-clockwise seen from outside if r lies
// on the outer side of p p' q, else all four are turned round.
constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

}  // namespace

template <int D>
struct SweepFlood<D>::Tetrahedron {
  const double* at[4];
  int turn;  // +1 or -1; 0 if it is flat
  SweptTriangle faces[4];

  explicit Tetrahedron(const FaceMotion& m)
      : at{m.p, m.to, m.q, m.r}, turn(orient<D>(at, at[3])), faces{face(0), face(1), face(2), face(3)} {}

  SweptTriangle face(int i) const {
    return SweptTriangle(EdgeMotion{at[kFaces[i][0]], at[kFaces[i][1]], at[kFaces[i][2]]});
  }

  /** As that of a triangle; faces 0 and 3 have all vertices. */
  uint32_t beyond_box(const double* v) const { return faces[0].beyond_box(v) & faces[3].beyond_box(v); }

  /** Bit i: beyond face i. 0: inside. */
  uint32_t beyond(const double* v) const {
    uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits |= (faces[i].side(v) == turn ? 1u : 0u) << i;
    return bits;
  }
  uint32_t beyond(Corner& corner) const {
    if (corner.side == kUnknown) corner.side = static_cast<int>(beyond(corner.at));
    return static_cast<uint32_t>(corner.side);
  }

  int line(int x, int y, const double* a, const double* b) const {
    const double* const ridge[2] = {a, b};
    return line_side<D>(at[x], at[y], ridge, NoTally{}).sign;
  }

  /** Whether a segment that lies on both sides of face i passes through it. */
  bool face_pierced(int i, const double* a, const double* b) const {
    const int(&f)[3] = kFaces[i];
    const int first = line(f[0], f[1], a, b);
    return line(f[1], f[2], a, b) == first && line(f[2], f[0], a, b) == first;
  }

  /** Whether a triangle of the environment, with `codes` from beyond(), meets the tetrahedron. What they share is a convex
   * polygon. If none of its corners is one of the triangle or lies on an edge of it, then it is all that the tetrahedron
   * has of the plane, and every edge of the tetrahedron that crosses the plane crosses the triangle. An edge that meets the
   * tetrahedron with both ends outside passes through two faces: one may be left out. */
  bool meets(const double* const* triangle, const uint32_t* codes) const {
    if ((codes[0] & codes[1] & codes[2]) != 0) return false;
    if (codes[0] == 0 || codes[1] == 0 || codes[2] == 0) return true;
    int sides[4];
    for (int i = 0; i < 4; ++i) sides[i] = plane_side<D>(triangle, at[i], NoTally{}).sign;
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

template <int D>
SweepResult SweepFlood<D>::sweep(const FaceMotion& m, Cell start, uint32_t max_cells) {
  cells_.clear();
  lines_.clear();
  result_ = {};
  const Tetrahedron t(m);
  if (t.turn == 0) return result_;
  cells_.insert(start);
  for (size_t i = 0; i < cells_.size(); ++i) {
    if (max_cells != 0 && i == max_cells) {
      result_.end = SweepEnd::kWorkLimit;
      result_.contact = {};
      break;
    }
    ++result_.cells_visited;
    const Cell c = cells_[i];
    const Shape shape = map_.shape(c);
    read_vertices(c, t);
    look_at_inside_vertices(t, c);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map_.half_facet(c, f), o = map_.opposite(h);
      if (!o.valid() || map_.facet_marked(h) || cells_.contains(Cell{o.word / kUnitWords})) continue;
      for (uint32_t s = shape.simplex_first(f); s < shape.simplex_first(f + 1); ++s) {
        if (!simplex_met(t, shape.simplices() + 3 * s)) continue;
        if (!is_impassable(env_, h)) cells_.insert(map_.cell_of(o));
        break;
      }
    }
  }
  return result_;
}

template <int D>
bool SweepFlood<D>::simplex_met(const Tetrahedron& t, const uint16_t* local) {
  Corner &a = corners_[local[0]], &b = corners_[local[1]], &c = corners_[local[2]];
  if ((a.beyond & b.beyond & c.beyond) != 0) return false;
  const double* const simplex[3] = {a.at, b.at, c.at};
  const uint32_t codes[3] = {t.beyond(a), t.beyond(b), t.beyond(c)};
  return t.meets(simplex, codes);
}

/** Keeps the earliest impassable vertex; the lowest of the cells that see it is its front. */
template <int D>
void SweepFlood<D>::look_at_inside_vertices(const Tetrahedron& t, Cell c) {
  SweepContact& best = result_.contact;
  for (Corner& corner : corners_) {
    if (corner.beyond != 0 || t.beyond(corner) != 0) continue;
    const uint32_t vertex = corner.vertex;
    if (best.vertex == vertex && map_.index(c) < map_.index(best.front)) best.front = c;
    bool first_time = false;
    lines_.value(vertex, kNoVertex, [&] {
      first_time = true;
      return 0u;
    });
    if (!first_time) continue;
    SweepContact found;
    if (!judge_vertex(c, vertex, found.facet)) continue;
    found.event = {{t.at[2], t.at[3], corner.at}, EventKind::kFace};
    found.front = c;
    found.vertex = vertex;
    if (result_.end == SweepEnd::kContact && !comes_before(map_, t.at[0], t.at[1], found, best)) continue;
    result_.end = SweepEnd::kContact;
    best = found;
  }
}

/** Whether a vertex of cell c is impassable, and its lowest impassable facet, seen from where one can be. All cells round it are linked through facets at
 * it, but for vertices of the outer boundary, where each part of them has facets of that. */
template <int D>
bool SweepFlood<D>::judge_vertex(Cell c, uint32_t vertex, HalfFacet& facet) {
  bool impassable = vertex_marked(env_, vertex);
  HalfFacet lowest;
  const auto lower = [&](HalfFacet a, HalfFacet b) {
    const Cell x = map_.cell_of(a), y = map_.cell_of(b);
    return x != y ? map_.index(x) < map_.index(y) : map_.local_of(a, x) < map_.local_of(b, y);
  };
  around_.clear();
  around_.insert(c);
  for (size_t i = 0; i < around_.size(); ++i) {
    const Cell at = around_[i];
    const Shape shape = map_.shape(at);
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      if (map_.vertex(at, shape.dart_vertex(d)) != vertex) continue;
      const HalfFacet h = map_.half_facet(at, shape.dart_facet(d));
      const HalfFacet o = map_.opposite(h);
      if (o.valid()) around_.insert(map_.cell_of(o));
      if (is_impassable(env_, h)) {
        impassable = true;
        const HalfFacet name = canonical(map_, h);
        if (!lowest.valid() || lower(name, lowest)) lowest = name;
      } else if (env_.marked_edges != 0) {
        impassable = impassable || edge_marked(env_, vertex, map_.vertex(at, shape.dart_vertex(shape.beta1(d))));
      }
    }
  }
  const bool from_behind = lowest.valid() && is_closed(env_, map_.cell_of(lowest)) && map_.opposite(lowest).valid();
  facet = from_behind ? map_.opposite(lowest) : lowest;
  return impassable;
}

#define DSW_SWEEP_FACE(D) template class SweepFlood<D>
DSW_SWEEP_FACE(3);
#undef DSW_SWEEP_FACE

}  // namespace dsw
