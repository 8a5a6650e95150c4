#include "response/rigid_touches.h"

#include <algorithm>

#include "body/near.h"
#include "proximity/part.h"

namespace dsw {

// What the body touches first it comes to through passable cells that meet the region of its way. So obstacles at these
// cells are enough.
template <int D>
FirstTouch RigidTouches<D>::find_first(const Body<D>& body, const RigidWay<D>& way, const Partners<D>* partners) {
  first_ = {false, 1};
  is_open_ = has_part_boxes_ = false;
  Box<D> all;
  uint32_t first_vertex = 0;
  while (first_vertex < body.vertices.size() && !body.has_vertex(first_vertex)) ++first_vertex;
  if (first_vertex == body.vertices.size()) return first_;
  for (uint32_t piece = 0; piece < way.pieces(); ++piece) all.add(way.box(piece));
  const double* const corners[2] = {all.lower, all.upper};
  NearRegion<D> region(corners, 1, 0);
  double at[D];
  for (uint32_t bits = 1; bits < 1u << D; ++bits) {
    for (uint32_t k = 0; k < D; ++k) at[k] = corners[(bits >> k) & 1][k];
    region.add(at);
  }
  const NearList<D>& list = lists_.in(body.vertices[first_vertex].cell, region);
  for (const WallFeature& obstacle : list.obstacles()) {
    RigidTouch<D> wall;
    wall.count = obstacle.count;
    wall.facet = obstacle.facet;
    wall.cell = obstacle.cell;
    for (uint32_t i = 0; i < obstacle.count; ++i) {
      wall.vertices[i] = list.name(obstacle.vertices[i]);
      wall.points[i] = env_.point(wall.vertices[i]);
    }
    meet(body, way, wall);
  }
  if (partners == nullptr) return first_;
  for (uint32_t i = 0; i < partners->all.size(); ++i) {
    if (partners->all[i].body != &body) meet_body(body, way, *partners, i);
  }
  return first_;
}

/** The last piece in which something earlier can be touched. */
template <int D>
uint32_t RigidTouches<D>::last_piece(const RigidWay<D>& way) const noexcept {
  return std::min(static_cast<uint32_t>(first_.time * way.pieces()), way.pieces() - 1);
}

/** A point of a part lies between those of its corners at all times. */
template <int D>
void RigidTouches<D>::find_part_boxes(const Body<D>& body, const RigidWay<D>& way) {
  has_part_boxes_ = true;
  vertex_boxes_.resize(body.vertices.size());
  part_boxes_.clear();
  for_each_simplex(body, [&](const Simplex& simplex) {
    if (simplex.kind == Simplex::kVertex) vertex_boxes_[simplex.index] = way.whole_box(simplex.index);
    Box<D> box;
    for (const uint32_t v : SimplexCorners<D>(body, simplex)) box.add(vertex_boxes_[v]);
    part_boxes_.push_back(box);
    return true;
  });
}

/** An obstacle, or a part of another body: a triangle, a segment or a point. */
template <int D>
void RigidTouches<D>::meet(const Body<D>& body, const RigidWay<D>& way, const RigidTouch<D>& other) {
  uint32_t piece = 0;
  const auto is_near = [&](const Box<D>& box) { return box.overlaps(other.points, static_cast<int>(other.count)); };
  while (piece <= last_piece(way) && !is_near(way.box(piece))) ++piece;
  if (piece > last_piece(way)) return;
  if (!has_part_boxes_) find_part_boxes(body, way);
  RigidTouch<D> both = other;
  const Box<D>* box = part_boxes_.data();
  for_each_simplex(body, [&](const Simplex& simplex) {
    if (!is_near(*box++)) return true;
    const SimplexCorners<D> part(body, simplex);
    both.part = simplex;
    for (uint32_t i = piece; i <= last_piece(way); ++i) {
      if (!is_near(way.box(i, part.vertices, part.count))) continue;
      touch(part, way, both);
      break;
    }
    return true;
  });
}

/** A body that stands: of its parts those that can touch something. */
template <int D>
void RigidTouches<D>::meet_body(const Body<D>& body, const RigidWay<D>& way, const Partners<D>& partners,
                                uint32_t number) {
  const Body<D>& other = *partners.all[number].body;
  RigidTouch<D> both;
  both.partner = number;
  for_each_simplex(other, [&](const Simplex& simplex) {
    const Part<D> part(other, simplex);
    both.other = simplex;
    both.count = part.corners.count;
    std::copy_n(part.points, 3, both.points);
    meet(body, way, both);
    return true;
  });
}

/** Asks about a part and an obstacle, or a part of another body. Sides of triangles and ends of edges count: what only
 * they touch is asked about as well. */
template <int D>
void RigidTouches<D>::touch(const SimplexCorners<D>& part, const RigidWay<D>& way, const RigidTouch<D>& touch) {
  const double* const* const points = touch.points;
  const uint32_t count = touch.count;
  TurningPair<D> pair{};
  const uint32_t own = part.count;
  const auto mine = [&](uint32_t i) { return way.origin(part.vertices[i]); };
  const auto set = [&](uint32_t at, const double* point) { pair.start[at] = pair.end[at] = point; };
  const auto ask_all = [&](PairKind kind, uint32_t mine_first) {
    pair.kind = kind;
    pair.way[mine_first != 0 ? 0 : 1] = &way.exact();
    pair.way[mine_first != 0 ? 1 : 0] = nullptr;
  };
  if (D == 3 && own == 2 && count >= 2) {
    ask_all(PairKind::kEdgeEdge, 1);
    for (uint32_t i = 0; i < (count == 2 ? 1 : count); ++i) {
      set(0, mine(0));
      set(1, mine(1));
      set(2, points[i]);
      set(3, points[(i + 1) % count]);
      ask(pair, touch);
    }
  } else if (own == 1 && count == D) {
    ask_all(D == 3 ? PairKind::kVertexFace : PairKind::kVertexEdge, 1);
    set(0, mine(0));
    for (uint32_t i = 0; i < D; ++i) set(i + 1, points[i]);
    ask(pair, touch);
  } else if (own == D) {
    ask_all(D == 3 ? PairKind::kVertexFace : PairKind::kVertexEdge, 0);
    for (uint32_t i = 0; i < D; ++i) set(i + 1, mine(i));
    for (uint32_t i = 0; i < count; ++i) {
      set(0, points[i]);
      ask(pair, touch);
    }
  }
}

/** Between a body and walls the shift decides. Between bodies touching is a contact; those that touch at the start need not
 * come nearer. */
template <int D>
void RigidTouches<D>::ask(const TurningPair<D>& pair, const RigidTouch<D>& touch) {
  FirstEntry first;
  if (touch.partner == kNone) {
    first = first_entry(pair);
  } else {
    first.touch = first_touch(pair);
    first.is_open = first.touch.touches && first.touch.time == 0;
    if (first.is_open) first.touch.touches = false;
  }
  is_open_ |= first.is_open;
  if (first.touch.touches && (!first_.touches || first.touch.time < first_.time)) {
    first_ = first.touch;
    touched_ = touch;
  }
}

template class RigidTouches<2>;
template class RigidTouches<3>;

}  // namespace dsw
