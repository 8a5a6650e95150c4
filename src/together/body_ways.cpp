// First touches are found as in proximity/pair_sweep.cpp: edges against edges and vertices against faces find every first
// touch; in the plane vertices against edges. Vertices without edges are edges of no length.

#include "together/body_ways.h"

#include <algorithm>
#include <cmath>

#include "base/search.h"
#include "predicates/moving_hinge.h"

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
  return dsw::find(corners.begin(), corners.end(), v) != corners.end();
}

template <int D>
bool may_meet(const Array<Trajectory<D>>& trajectories, uint32_t a, uint32_t b) {
  const ContactFilter& filter = trajectories[a].motion.body->filter;
  return a == b ? filter.self : filter.sees(trajectories[b].motion.body->filter);
}

/** How many of a pair's points are those of its first or its second side. */
template <int D>
uint32_t point_count(PairKind kind, uint32_t side) {
  if (kind == PairKind::kEdgeEdge) return 2;
  return side == 0 ? 1 : D;
}

template <int D>
double mean_size(const Array<Box<D>>& boxes) noexcept {
  double sum = 0;
  for (const Box<D>& each : boxes) {
    double size = 0;
    for (int k = 0; k < D; ++k) size = std::max(size, each.upper[k] - each.lower[k]);
    sum += size / static_cast<double>(boxes.size());
  }
  return std::isfinite(sum) ? sum : 0;
}

/** The box of the way of a part without what all go, with room for rounding. */
template <int D>
Box<D> box_beside_drift(const Trajectory<D>& of, const Simplex& part, const double* drift) noexcept {
  Box<D> box;
  double largest = 0;
  for (const uint32_t v : SimplexCorners<D>(*of.motion.body, part)) {
    double end[D];
    for (int k = 0; k < D; ++k) {
      end[k] = of.reach(v)[k] - drift[k];
      largest = std::max({largest, std::fabs(of.start(v)[k]), std::fabs(of.reach(v)[k]), std::fabs(drift[k])});
    }
    box.add(of.start(v));
    box.add(end);
  }
  return widened(box, 0x1p-48 * largest);
}

}  // namespace

template <int D>
void BodyWays<D>::Ways::clear() {
  for (uint32_t i = 0; !sweeps && i < sides.size(); ++i) grid.remove(i);
  sides.clear();
  boxes.clear();
}

template <int D>
void BodyWays<D>::Ways::add(const Trajectory<D>& of, uint32_t number, const Simplex& part, const double* drift) {
  sides.push_back({number, &of.name, part});
  boxes.push_back(drift == nullptr ? box_of_way(of, part) : box_beside_drift(of, part, drift));
}

template <int D>
void BodyWays<D>::Ways::fill(const Array<Box<D>>& others) {
  constexpr double kMostRead = 512;  // in the mean of a visit: then a grid is as fast
  sweeps = false;
  if (boxes.empty()) return;
  sweep.sort(boxes, longest_axis(boxes));
  sweeps = sweep.mean_length(others) <= kMostRead;
  if (sweeps) return;
  // Vertices are looked for with what is larger, and many of them may not move at all.
  const double size = mean_size(others);
  grid.reserve(sides.size());
  for (uint32_t i = 0; i < sides.size(); ++i) grid.put(i, boxes[i], size);
}

template <int D>
void BodyWays<D>::start(const Array<Trajectory<D>>& trajectories, bool bodies_meet, const double* drift) {
  bodies_meet_ = bodies_meet;
  pairs_.clear();
  const auto meets = [](const Trajectory<D>& of) {
    return of.motion.body->filter.self || (of.still != nullptr && !of.still->all.empty());
  };
  hinges_.clear();
  if (!bodies_meet || (trajectories.size() == 1 && !meets(trajectories[0]))) return;
  const bool with_segments = drift != nullptr || !find_own_edges(trajectories);
  add_ways(trajectories, with_segments, drift);
  if (with_segments) find_segments(trajectories);
  find_solids(trajectories);
  find_hinges(trajectories);
  find_still(trajectories);
}

/** The edges of one body that meets nothing but itself. False: it is not one, or grids serve better. */
template <int D>
bool BodyWays<D>::find_own_edges([[maybe_unused]] const Array<Trajectory<D>>& trajectories) {
  if constexpr (D == 3) {
    const Trajectory<3>& of = trajectories[0];
    const Body<3>& body = *of.motion.body;
    const bool has_still = of.still != nullptr && !of.still->all.empty();
    if (trajectories.size() != 1 || has_still || !covers_edges(body.level) || !fresh_boxes(body).loners.empty())
      return false;
    near_.start(body, false, [&](uint32_t v) { return of.reach(v); });
    if (!near_.active()) return false;
    for (uint32_t e = 0; e < body.edges.size(); ++e) {
      if (!body.has_edge(e)) continue;
      const Side side{0, &of.name, {Simplex::kEdge, e}};
      near_.visit(e, [&](uint32_t other) {
        if (e < other) add_pair(PairKind::kEdgeEdge, side, {0, &of.name, {Simplex::kEdge, other}});
        return true;
      });
    }
    return true;
  }
  return false;
}

template <int D>
void BodyWays<D>::add_ways(const Array<Trajectory<D>>& trajectories, bool with_segments, const double* drift) {
  for (Ways* each : {&segments_, &vertices_, &faces_}) each->clear();
  const auto has_faces = [](const Partner<D>& each) { return covers_faces(each.body->level); };
  const bool may_meet_faces = dsw::any_of(trajectories.begin(), trajectories.end(), [&](const Trajectory<D>& of) {
    return has_faces(of.name) ||
           (of.still != nullptr && dsw::any_of(of.still->all.begin(), of.still->all.end(), has_faces));
  });
  for (uint32_t t = 0; t < trajectories.size(); ++t) {
    const Trajectory<D>& of = trajectories[t];
    for_each_simplex(*of.motion.body, [&](const Simplex& part) {
      if (part.kind == Simplex::kVertex) {
        if (D == 2 || may_meet_faces) vertices_.add(of, t, part, drift);
        if (with_segments && is_single(*of.motion.body, part.index)) segments_.add(of, t, part, drift);
      } else if (part.kind == Simplex::kEdge) {
        if (with_segments) segments_.add(of, t, part, drift);
      } else {
        faces_.add(of, t, part, drift);
      }
      return true;
    });
  }
  if (with_segments) segments_.fill(segments_.boxes);
  vertices_.fill((D == 2 ? segments_ : faces_).boxes);
}

template <int D>
void BodyWays<D>::find_segments(const Array<Trajectory<D>>& trajectories) {
  for (uint32_t i = 0; i < segments_.sides.size(); ++i) {
    // In the plane edges meet all vertices, below. Here only vertices without edges meet each other.
    if (D == 2 && segments_.sides[i].part.kind != Simplex::kVertex) continue;
    segments_.visit(segments_.boxes[i], [&](uint32_t k) {
      if (k >= i || (D == 2 && segments_.sides[k].part.kind != Simplex::kVertex)) return;
      if (may_meet(trajectories, segments_.sides[i].trajectory, segments_.sides[k].trajectory))
        add_segments(segments_.sides[i], segments_.sides[k]);
    });
  }
}

/** Faces and vertices, in the plane edges and vertices. */
template <int D>
void BodyWays<D>::find_solids(const Array<Trajectory<D>>& trajectories) {
  const Ways& solids = D == 2 ? segments_ : faces_;
  for (uint32_t i = 0; i < solids.sides.size(); ++i) {
    const Side& solid = solids.sides[i];
    if (D == 2 && solid.part.kind == Simplex::kVertex) continue;
    vertices_.visit(solids.boxes[i], [&](uint32_t k) {
      const Side& vertex = vertices_.sides[k];
      const bool is_own = solid.trajectory == vertex.trajectory;
      if (!may_meet(trajectories, solid.trajectory, vertex.trajectory)) return;
      if (is_own && has_corner(*solid.name->body, solid.part, vertex.part.index)) return;
      add_pair(D == 2 ? PairKind::kVertexEdge : PairKind::kVertexFace, vertex, solid);
    });
  }
}

/** If edges share a vertex, the far end of each can touch the other edge. In the plane vertices meet all edges anyhow.
 * Both ends of an edge that stands alone can touch each other; of other edges another one touches then, too. */
template <int D>
void BodyWays<D>::find_hinges(const Array<Trajectory<D>>& trajectories) {
  for (uint32_t t = 0; t < trajectories.size(); ++t) {
    const Body<D>& body = *trajectories[t].motion.body;
    if (!body.filter.self || !covers_edges(body.level)) continue;
    for (uint32_t e = 0; e < body.edges.size(); ++e) {
      const BodyEdge& edge = body.edges[e];
      const auto is_only = [&](uint32_t k) {
        return edge.next[k] == kNone && body.vertices[edge.ends[k]].first_edge == e;
      };
      if (!body.has_edge(e) || !is_only(0) || !is_only(1)) continue;
      const auto end = [&](uint32_t k) { return Side{t, &trajectories[t].name, {Simplex::kVertex, edge.ends[k]}}; };
      add_pair(D == 2 ? PairKind::kVertexEdge : PairKind::kEdgeEdge, end(0), end(1));
    }
    if (D == 2) continue;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      for_each_edge(body, v, [&](uint32_t e) {
        for_each_edge(body, v, [&](uint32_t f) {
          if (f == e) return false;
          hinges_.push_back({t, {v, body.edges[e].other(v), body.edges[f].other(v)}, {e, f}});
          return true;
        });
        return true;
      });
    }
  }
}

/** Two segments, unless they share a vertex. */
template <int D>
void BodyWays<D>::add_segments(const Side& a, const Side& b) {
  if (a.trajectory == b.trajectory) {
    for (const uint32_t v : SimplexCorners<D>(*a.name->body, a.part)) {
      if (has_corner(*b.name->body, b.part, v)) return;
    }
  }
  add_pair(D == 2 ? PairKind::kVertexEdge : PairKind::kEdgeEdge, a, b);
}

template <int D>
void BodyWays<D>::find_still(const Array<Trajectory<D>>& trajectories) {
  for (const Ways* ways : {&segments_, &vertices_, &faces_}) {
    for (uint32_t i = 0; i < ways->sides.size(); ++i) {
      const Side& side = ways->sides[i];
      const Partners<D>* const still = trajectories[side.trajectory].still;
      if (still == nullptr) continue;
      if (still->all.empty()) continue;
      const Box<D> box = box_of_way(trajectories[side.trajectory], side.part);
      for (const Partner<D>& other : still->all) {
        ways == &segments_ ? meet_segments(side, other, box) : meet_solids(side, other, box);
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

/** A segment against segments that stand still; in the plane also an edge against vertices. */
template <int D>
void BodyWays<D>::meet_segments(const Side& segment, const Partner<D>& other, const Box<D>& box) {
  const Body<D>& body = *other.body;
  const bool is_vertex = segment.part.kind == Simplex::kVertex;
  if constexpr (D == 2) {
    // A vertex without edges meets those of the other body, an edge meets all vertices.
    const BoxGrid<D>& grid = is_vertex ? single_vertices(body, body.level) : fresh_boxes(body).vertices;
    grid.visit(box, [&](uint32_t v) {
      add_pair(PairKind::kVertexEdge, {kNone, &other, {Simplex::kVertex, v}}, segment);
      return true;
    });
  } else {
    single_vertices(body, body.level).visit(box, [&](uint32_t v) {
      add_pair(PairKind::kEdgeEdge, segment, {kNone, &other, {Simplex::kVertex, v}});
      return true;
    });
    if (!covers_edges(body.level)) return;
    fresh_boxes(body).edges.visit(box, [&](uint32_t e) {
      add_pair(PairKind::kEdgeEdge, segment, {kNone, &other, {Simplex::kEdge, e}});
      return true;
    });
  }
}

/** Calls visit(touch) if a pair touches; whether it did not return false. */
template <int D>
template <class Visit>
bool BodyWays<D>::visit_pair(const Array<Trajectory<D>>& trajectories, const Pair& pair, Visit visit) const {
  WayTouch<D> touch{};
  touch.pair.kind = pair.kind;
  uint32_t at = 0;
  const auto is_new_side = [&](const Side& side) {
    return side.trajectory != kNone &&
           is_new(trajectories[side.trajectory], SimplexCorners<D>(*side.name->body, side.part));
  };
  if (!is_new_side(pair.sides[0]) && !is_new_side(pair.sides[1])) return true;
  bool moves = false;
  for (uint32_t k = 0; k < 2; ++k) {
    const Side& side = pair.sides[k];
    const SimplexCorners<D> corners(*side.name->body, side.part);
    for (uint32_t i = 0; i < point_count<D>(pair.kind, k); ++i, ++at) {
      const uint32_t v = corners.vertices[std::min(i, corners.count - 1)];
      touch.pair.start[at] = touch.pair.end[at] = side.name->body->position(v);
      if (side.trajectory == kNone) continue;
      touch.pair.end[at] = trajectories[side.trajectory].end(v);
      moves = moves || trajectories[side.trajectory].moves(v);
    }
  }
  if (!moves || !boxes_overlap(touch.pair)) return true;
  touch.first = first_touch(touch.pair, work);
  if (!touch.first.touches) return true;
  const uint32_t mover = pair.sides[0].trajectory != kNone ? 0 : 1;
  touch.trajectory = pair.sides[mover].trajectory;
  touch.comes_first = mover == 0;
  touch.part = pair.sides[mover].part;
  touch.other_trajectory = pair.sides[1 - mover].trajectory;
  touch.other = pair.sides[1 - mover].name;
  touch.other_part = pair.sides[1 - mover].part;
  return visit(touch);
}

/** Calls visit(touch) for all that touches, until it returns false. */
template <int D>
template <class Visit>
bool BodyWays<D>::visit_touches(const Array<Trajectory<D>>& trajectories, Visit visit) const {
  for (const Pair& pair : pairs_) {
    if (!visit_pair(trajectories, pair, visit)) return false;
  }
  for (const Hinge& hinge : hinges_) {
    const Trajectory<D>& of = trajectories[hinge.trajectory];
    if (dsw::none_of(hinge.vertices, hinge.vertices + 3, [&](uint32_t v) { return of.is_new[v] != 0; })) continue;
    const double* start[3];
    const double* end[3];
    for (uint32_t i = 0; i < 3; ++i) {
      start[i] = of.start(hinge.vertices[i]);
      end[i] = of.end(hinge.vertices[i]);
    }
    if (stays_open(start, end)) continue;
    for (uint32_t k = 0; k < 2; ++k) {
      const Side far{hinge.trajectory, &of.name, {Simplex::kVertex, hinge.vertices[1 + k]}};
      const Side edge{hinge.trajectory, &of.name, {Simplex::kEdge, hinge.edges[1 - k]}};
      if (!visit_pair(trajectories, {PairKind::kEdgeEdge, {far, edge}}, visit)) return false;
    }
  }
  return true;
}

template <int D>
bool BodyWays<D>::is_free(const Array<Trajectory<D>>& trajectories) const {
  return visit_touches(trajectories, [](const WayTouch<D>&) { return false; });
}

template <int D>
void BodyWays<D>::find_first(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& first) const {
  visit_touches(trajectories, [&](const WayTouch<D>& touch) {
    add_first(touch, first, work);
    return true;
  });
}

template <int D>
void BodyWays<D>::find_all(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& all) const {
  visit_touches(trajectories, [&](const WayTouch<D>& touch) {
    all.push_back(touch);
    return true;
  });
}

template class BodyWays<2>;
template class BodyWays<3>;

}  // namespace dsw
