// As pairs/pair_sweep.cpp: edges against edges and vertices against faces find every first touch; in the plane vertices
// against edges. Vertices without edges are edges of no length.

#include "together/body_ways.h"

#include <algorithm>

namespace dsw {
namespace {

/** Whether a vertex stands for itself: no edge that the level covers has it. */
template <int D>
bool is_single(const Body<D>& body, uint32_t v) {
  return !covers_edges(body.level) || body.vertices[v].first_edge == kNone;
}

template <int D>
bool has_corner(const Body<D>& body, const Simplex& part, uint32_t v) {
  const SimplexCorners<D> corners(body, part);
  return std::find(corners.begin(), corners.end(), v) != corners.end();
}

/** How many of a pair's points are those of its first or its second side. */
template <int D>
uint32_t point_count(PairKind kind, uint32_t side) {
  if (kind == PairKind::kEdgeEdge) return 2;
  return side == 0 ? 1 : D;
}

}  // namespace

template <int D>
void BodyWays<D>::Ways::clear() {
  for (uint32_t i = 0; i < sides.size(); ++i) grid.remove(i);
  sides.clear();
  boxes.clear();
}

template <int D>
void BodyWays<D>::Ways::add(const Traveller<D>& of, uint32_t number, const Simplex& part) {
  sides.push_back({number, &of.name, part});
  boxes.push_back(box_of_way(of, part));
}

template <int D>
void BodyWays<D>::Ways::settle() {
  grid.reserve(sides.size());
  for (uint32_t i = 0; i < sides.size(); ++i) grid.put(i, boxes[i]);
}

template <int D>
void BodyWays<D>::start(const Array<Traveller<D>>& travellers, bool bodies_meet) {
  pairs_.clear();
  const auto meets = [](const Traveller<D>& of) {
    return of.body->filter.self || (of.still != nullptr && !of.still->all.empty());
  };
  if (!bodies_meet || (travellers.size() == 1 && !meets(travellers[0]))) return;
  add_ways(travellers);
  find_among_travellers(travellers);
  find_still(travellers);
}

template <int D>
void BodyWays<D>::add_ways(const Array<Traveller<D>>& travellers) {
  for (Ways* each : {&rods_, &vertices_, &faces_}) each->clear();
  const auto has_faces = [](const Partner<D>& each) { return covers_faces(each.body->level); };
  const bool may_meet_faces = std::any_of(travellers.begin(), travellers.end(), [&](const Traveller<D>& of) {
    return has_faces(of.name) || (of.still != nullptr && std::any_of(of.still->all.begin(), of.still->all.end(), has_faces));
  });
  for (uint32_t t = 0; t < travellers.size(); ++t) {
    const Traveller<D>& of = travellers[t];
    for_each_simplex(*of.body, [&](const Simplex& part) {
      if (part.kind == Simplex::kVertex) {
        if (D == 2 || may_meet_faces) vertices_.add(of, t, part);
        if (is_single(*of.body, part.index)) rods_.add(of, t, part);
      } else if (part.kind == Simplex::kEdge) {
        rods_.add(of, t, part);
      } else {
        faces_.add(of, t, part);
      }
      return true;
    });
  }
  for (Ways* each : {&rods_, &vertices_, &faces_}) each->settle();
}

template <int D>
void BodyWays<D>::find_among_travellers(const Array<Traveller<D>>& travellers) {
  const auto meets = [&](const Side& a, const Side& b) {
    const ContactFilter& filter = travellers[a.traveller].body->filter;
    return a.traveller == b.traveller ? filter.self : filter.sees(travellers[b.traveller].body->filter);
  };
  for (uint32_t i = 0; i < rods_.sides.size(); ++i) {
    // In the plane an edge is paired with all vertices below; here only vertices without edges meet each other.
    if (D == 2 && rods_.sides[i].part.kind != Simplex::kVertex) continue;
    rods_.grid.visit(rods_.boxes[i], [&](uint32_t k) {
      if (k >= i || (D == 2 && rods_.sides[k].part.kind != Simplex::kVertex)) return true;
      if (meets(rods_.sides[i], rods_.sides[k])) add_rods(rods_.sides[i], rods_.sides[k]);
      return true;
    });
  }
  Ways& solids = D == 2 ? rods_ : faces_;
  for (uint32_t i = 0; i < solids.sides.size(); ++i) {
    if (D == 2 && solids.sides[i].part.kind == Simplex::kVertex) continue;
    vertices_.grid.visit(solids.boxes[i], [&](uint32_t k) {
      const Side &solid = solids.sides[i], &vertex = vertices_.sides[k];
      if (!meets(solid, vertex)) return true;
      const bool is_own = solid.traveller == vertex.traveller;
      if (is_own && has_corner(*solid.name->body, solid.part, vertex.part.index)) return true;
      add_pair(D == 2 ? PairKind::kVertexEdge : PairKind::kVertexFace, vertex, solid);
      return true;
    });
  }
}

/** Two rods; of edges that share a vertex the far ends. */
template <int D>
void BodyWays<D>::add_rods(const Side& a, const Side& b) {
  const PairKind kind = D == 2 ? PairKind::kVertexEdge : PairKind::kEdgeEdge;
  if (a.traveller != b.traveller) return add_pair(kind, a, b);
  const Body<D>& body = *a.name->body;
  const SimplexCorners<D> of_a(body, a.part), of_b(body, b.part);
  const auto shares = [](const SimplexCorners<D>& one, const SimplexCorners<D>& other, uint32_t* far) {
    bool shared = false;
    for (const uint32_t v : one) {
      const bool is_common = std::find(other.begin(), other.end(), v) != other.end();
      shared = shared || is_common;
      if (!is_common) *far = v;
    }
    return shared;
  };
  uint32_t far_a = kNone, far_b = kNone;
  if (!shares(of_a, of_b, &far_a)) return add_pair(kind, a, b);
  shares(of_b, of_a, &far_b);
  if (far_a != kNone) add_pair(kind, {a.traveller, a.name, {Simplex::kVertex, far_a}}, b);
  if (far_b != kNone) add_pair(kind, {b.traveller, b.name, {Simplex::kVertex, far_b}}, a);
}

template <int D>
void BodyWays<D>::find_still(const Array<Traveller<D>>& travellers) {
  for (const Ways* ways : {&rods_, &vertices_, &faces_}) {
    for (uint32_t i = 0; i < ways->sides.size(); ++i) {
      const Side& side = ways->sides[i];
      const Partners<D>* const still = travellers[side.traveller].still;
      if (still == nullptr) continue;
      for (const Partner<D>& other : still->all) {
        ways == &rods_ ? meet_rods(side, other, ways->boxes[i]) : meet_solids(side, other, ways->boxes[i]);
      }
    }
  }
}

/** A vertex against faces that stand still, or a face against vertices; in the plane a vertex against edges. */
template <int D>
void BodyWays<D>::meet_solids(const Side& side, const Partner<D>& other, const Box<D>& box) {
  const Body<D>& body = *other.body;
  const BodyBoxes<D>& boxes = fresh_boxes(body);
  if (side.part.kind == Simplex::kFace) {
    boxes.vertices.visit(box, [&](uint32_t v) {
      add_pair(PairKind::kVertexFace, {kNone, &other, {Simplex::kVertex, v}}, side);
      return true;
    });
  } else if (D == 2 ? covers_edges(body.level) : covers_faces(body.level)) {
    (D == 2 ? boxes.edges : boxes.faces).visit(box, [&](uint32_t k) {
      const Simplex::Kind kind = D == 2 ? Simplex::kEdge : Simplex::kFace;
      add_pair(D == 2 ? PairKind::kVertexEdge : PairKind::kVertexFace, side, {kNone, &other, {kind, k}});
      return true;
    });
  }
}

/** A rod against rods that stand still; in the plane also an edge against vertices. */
template <int D>
void BodyWays<D>::meet_rods(const Side& rod, const Partner<D>& other, const Box<D>& box) {
  const Body<D>& body = *other.body;
  const bool is_vertex = rod.part.kind == Simplex::kVertex;
  if constexpr (D == 2) {
    // A vertex without edges meets those of the other body, an edge meets all vertices.
    const BoxGrid<D>& grid = is_vertex ? single_vertices(body, body.level) : fresh_boxes(body).vertices;
    grid.visit(box, [&](uint32_t v) {
      add_pair(PairKind::kVertexEdge, {kNone, &other, {Simplex::kVertex, v}}, rod);
      return true;
    });
  } else {
    single_vertices(body, body.level).visit(box, [&](uint32_t v) {
      add_pair(PairKind::kEdgeEdge, rod, {kNone, &other, {Simplex::kVertex, v}});
      return true;
    });
    if (!covers_edges(body.level)) return;
    fresh_boxes(body).edges.visit(box, [&](uint32_t e) {
      add_pair(PairKind::kEdgeEdge, rod, {kNone, &other, {Simplex::kEdge, e}});
      return true;
    });
  }
}

/** Calls visit(touch) for the pairs that touch, until it returns false. */
template <int D>
template <class Visit>
bool BodyWays<D>::visit_touches(const Array<Traveller<D>>& travellers, Visit visit) const {
  for (const Pair& pair : pairs_) {
    WayTouch<D> touch{};
    touch.pair.kind = pair.kind;
    uint32_t at = 0;
    bool moves = false;
    for (uint32_t k = 0; k < 2; ++k) {
      const Side& side = pair.sides[k];
      const SimplexCorners<D> corners(*side.name->body, side.part);
      for (uint32_t i = 0; i < point_count<D>(pair.kind, k); ++i, ++at) {
        const uint32_t v = corners.vertices[std::min(i, corners.count - 1)];
        touch.pair.start[at] = touch.pair.end[at] = side.name->body->position(v);
        if (side.traveller == kNone) continue;
        touch.pair.end[at] = travellers[side.traveller].end(v);
        moves = moves || travellers[side.traveller].moves(v);
      }
    }
    if (!moves || !boxes_overlap(touch.pair)) continue;
    touch.first = first_touch(touch.pair);
    if (!touch.first.touches) continue;
    const uint32_t mover = pair.sides[0].traveller != kNone ? 0 : 1;
    touch.traveller = pair.sides[mover].traveller;
    touch.comes_first = mover == 0;
    touch.part = pair.sides[mover].part;
    touch.other_traveller = pair.sides[1 - mover].traveller;
    touch.other = pair.sides[1 - mover].name;
    touch.other_part = pair.sides[1 - mover].part;
    if (!visit(touch)) return false;
  }
  return true;
}

template <int D>
bool BodyWays<D>::is_free(const Array<Traveller<D>>& travellers) const {
  return visit_touches(travellers, [](const WayTouch<D>&) { return false; });
}

template <int D>
void BodyWays<D>::find_first(const Array<Traveller<D>>& travellers, FirstTouches<D>& first) const {
  visit_touches(travellers, [&](const WayTouch<D>& touch) {
    first.add(touch);
    return true;
  });
}

template class BodyWays<2>;
template class BodyWays<3>;

}  // namespace dsw
