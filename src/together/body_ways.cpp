// First touches are found as in proximity/pair_sweep.cpp: edges against edges and vertices against faces find every first
// touch; in the plane vertices against edges. Vertices without edges are edges of no length.

#include "together/body_ways.h"

#include <algorithm>

#include "base/search.h"

namespace dsw {
namespace {

/** Whether a vertex stands for itself: no edge that the level covers has it. */
template <int D>
bool is_single(const Body<D>& body, uint32_t v) {
  return !covers_edges(body.level) || body.vertices[v].first_edge == kNone;
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

}  // namespace

template <int D>
void BodyWays<D>::start(const Array<Trajectory<D>>& trajectories, bool bodies_meet, const double* drift) {
  bodies_meet_ = bodies_meet;
  pairs_.clear();
  sides_.clear();
  lists_hinges_ = false;
  const auto meets = [](const Trajectory<D>& of) {
    return of.motion.body->filter.self || (of.still != nullptr && !of.still->all.empty());
  };
  has_hinges_ = bodies_meet && !trajectories.empty() && (trajectories.size() != 1 || meets(trajectories[0]));
  if (!has_hinges_) return;
  if (drift != nullptr) {
    find_step_pairs(trajectories, drift);
  } else {
    const bool with_segments = !find_own_edges(trajectories);
    add_ways(trajectories, with_segments);
    if (with_segments) find_segments(trajectories);
    find_solids(trajectories);
    find_still(trajectories);
  }
  find_lone_edges(trajectories);
}

template <int D>
void BodyWays<D>::find_step_pairs(const Array<Trajectory<D>>& trajectories, const double* drift) {
  lists_hinges_ = true;
  step_pairs_.find(trajectories, drift);
  for (const typename StepPairs<D>::Pair& pair : step_pairs_.pairs()) {
    const auto side_of = [&](const typename StepPairs<D>::Part& part) {
      return add_side(part.trajectory, trajectories[part.trajectory].name, part.simplex);
    };
    const uint32_t first = side_of(pair.parts[0]);
    add_pair(pair.kind, first, side_of(pair.parts[1]));
  }
  const auto meets_others = [](const Trajectory<D>& of) { return of.still != nullptr && !of.still->all.empty(); };
  if (dsw::none_of(trajectories.begin(), trajectories.end(), meets_others)) return;
  add_ways(trajectories, true);
  find_still(trajectories);
}

template <int D>
uint32_t BodyWays<D>::add_side(uint32_t trajectory, const Partner<D>& name, const Simplex& part) {
  sides_.push_back(Side(trajectory, name, part));
  return static_cast<uint32_t>(sides_.size() - 1);
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
      add_side(0, of.name, {Simplex::kEdge, e});
      if (!body.has_edge(e)) continue;
      near_.visit(e, [&](uint32_t other) {
        if (e < other) add_pair(PairKind::kEdgeEdge, e, other);
        return true;
      });
    }
    return true;
  }
  return false;
}

/** The boxes of the ways of vertices of a trajectory: those of its parts are made of them. */
template <int D>
void BodyWays<D>::box_vertices(const Trajectory<D>& of) {
  const Body<D>& body = *of.motion.body;
  vertex_boxes_.resize(body.vertices.size());
  for (uint32_t v = 0; v < body.vertices.size(); ++v) {
    if (!body.has_vertex(v)) continue;
    Box<D>& box = vertex_boxes_[v];
    box = {};
    box.add(of.start(v));
    box.add(of.reach(v));
  }
}

template <int D>
void BodyWays<D>::add_ways(const Array<Trajectory<D>>& trajectories, bool with_segments) {
  for (Ways* each : {&segments_, &vertices_, &faces_}) each->clear();
  const auto has_faces = [](const Partner<D>& each) { return covers_faces(each.body->level); };
  const bool may_meet_faces = dsw::any_of(trajectories.begin(), trajectories.end(), [&](const Trajectory<D>& of) {
    return has_faces(of.name) ||
           (of.still != nullptr && dsw::any_of(of.still->all.begin(), of.still->all.end(), has_faces));
  });
  for (uint32_t t = 0; t < trajectories.size(); ++t) {
    const Trajectory<D>& of = trajectories[t];
    box_vertices(of);
    const auto add = [&](const Simplex& part, Ways& ways) {
      const uint32_t side = add_side(t, of.name, part);
      Box<D> box = vertex_boxes_[sides_[side].corners.vertices[0]];
      for (uint32_t i = 1; i < sides_[side].corners.count; ++i) {
        const Box<D>& other = vertex_boxes_[sides_[side].corners.vertices[i]];
        for (int k = 0; k < D; ++k) {
          box.lower[k] = std::min(box.lower[k], other.lower[k]);
          box.upper[k] = std::max(box.upper[k], other.upper[k]);
        }
      }
      ways.sides.push_back(side);
      ways.boxes.push_back(box);
    };
    for_each_simplex(*of.motion.body, [&](const Simplex& part) {
      if (part.kind == Simplex::kVertex) {
        if (D == 2 || may_meet_faces) add(part, vertices_);
        if (with_segments && is_single(*of.motion.body, part.index)) add(part, segments_);
      } else if (part.kind == Simplex::kFace || with_segments) {
        add(part, part.kind == Simplex::kEdge ? segments_ : faces_);
      }
      return true;
    });
  }
}

template <int D>
void BodyWays<D>::find_segments(const Array<Trajectory<D>>& trajectories) {
  // In the plane edges meet all vertices, below. Here only vertices without edges meet each other.
  const auto counts = [](const Side& side) { return D == 3 || side.part.kind == Simplex::kVertex; };
  sweep_.visit_own(segments_.boxes, [&](uint32_t i, uint32_t k) {
    const uint32_t numbers[2] = {segments_.sides[std::max(i, k)], segments_.sides[std::min(i, k)]};
    const Side &a = sides_[numbers[0]], &b = sides_[numbers[1]];
    if (!counts(a) || !counts(b) || !may_meet(trajectories, a.trajectory, b.trajectory)) return;
    if (!segments_.boxes[i].overlaps(segments_.boxes[k])) return;
    add_segments(numbers[0], numbers[1]);
  });
}

/** Faces and vertices, in the plane edges and vertices. */
template <int D>
void BodyWays<D>::find_solids(const Array<Trajectory<D>>& trajectories) {
  const Ways& solids = D == 2 ? segments_ : faces_;
  sweep_.visit_between(solids.boxes, vertices_.boxes, [&](uint32_t i, uint32_t k) {
    const Side &solid = sides_[solids.sides[i]], &vertex = sides_[vertices_.sides[k]];
    if (D == 2 && solid.part.kind == Simplex::kVertex) return;
    if (!may_meet(trajectories, solid.trajectory, vertex.trajectory)) return;
    if (solid.trajectory == vertex.trajectory && solid.has_corner(vertex.part.index)) return;
    if (!solids.boxes[i].overlaps(vertices_.boxes[k])) return;
    add_pair(D == 2 ? PairKind::kVertexEdge : PairKind::kVertexFace, vertices_.sides[k], solids.sides[i]);
  });
}

/** Both ends of an edge that stands alone can touch each other; of other edges another one touches then, too. */
template <int D>
void BodyWays<D>::find_lone_edges(const Array<Trajectory<D>>& trajectories) {
  for (uint32_t t = 0; t < trajectories.size(); ++t) {
    const Body<D>& body = *trajectories[t].motion.body;
    if (!body.filter.self || !covers_edges(body.level)) continue;
    for (uint32_t e = 0; e < body.edges.size(); ++e) {
      const BodyEdge& edge = body.edges[e];
      const auto is_only = [&](uint32_t k) {
        return edge.next[k] == kNone && body.vertices[edge.ends[k]].first_edge == e;
      };
      if (!body.has_edge(e) || !is_only(0) || !is_only(1)) continue;
      const auto end = [&](uint32_t k) { return add_side(t, trajectories[t].name, {Simplex::kVertex, edge.ends[k]}); };
      const uint32_t first = end(0);
      add_pair(D == 2 ? PairKind::kVertexEdge : PairKind::kEdgeEdge, first, end(1));
    }
  }
}

/** Two segments, unless they share a vertex. */
template <int D>
void BodyWays<D>::add_segments(uint32_t a, uint32_t b) {
  const Side &first = sides_[a], &second = sides_[b];
  if (first.trajectory == second.trajectory) {
    for (const uint32_t v : first.corners) {
      if (second.has_corner(v)) return;
    }
  }
  add_pair(D == 2 ? PairKind::kVertexEdge : PairKind::kEdgeEdge, a, b);
}

template <int D>
void BodyWays<D>::find_still(const Array<Trajectory<D>>& trajectories) {
  for (const Ways* ways : {&segments_, &vertices_, &faces_}) {
    for (const uint32_t side : ways->sides) {
      const Trajectory<D>& of = trajectories[sides_[side].trajectory];
      const Partners<D>* const still = of.still;
      if (still == nullptr || still->all.empty()) continue;
      const Box<D> box = box_of_way(of, sides_[side].part);
      for (const Partner<D>& other : still->all) {
        ways == &segments_ ? meet_segments(side, other, box) : meet_solids(side, other, box);
      }
    }
  }
}

/** A vertex against faces that stand still, or a face against vertices; in the plane a vertex against edges. */
template <int D>
void BodyWays<D>::meet_solids(uint32_t side, const Partner<D>& other, const Box<D>& box) {
  const Body<D>& body = *other.body;
  const BodyBoxes<D>& boxes = fresh_boxes(body);
  if (sides_[side].part.kind == Simplex::kFace) {
    boxes.vertices.visit(box, [&](uint32_t v) {
      add_pair(PairKind::kVertexFace, add_side(kNone, other, {Simplex::kVertex, v}), side);
      return true;
    });
  } else if (D == 2 ? covers_edges(body.level) : covers_faces(body.level)) {
    (D == 2 ? boxes.edges : boxes.faces).visit(box, [&](uint32_t k) {
      const Simplex::Kind kind = D == 2 ? Simplex::kEdge : Simplex::kFace;
      add_pair(D == 2 ? PairKind::kVertexEdge : PairKind::kVertexFace, side, add_side(kNone, other, {kind, k}));
      return true;
    });
  }
}

/** A segment against segments that stand still; in the plane also an edge against vertices. */
template <int D>
void BodyWays<D>::meet_segments(uint32_t segment, const Partner<D>& other, const Box<D>& box) {
  const Body<D>& body = *other.body;
  const bool is_vertex = sides_[segment].part.kind == Simplex::kVertex;
  if constexpr (D == 2) {
    // A vertex without edges meets those of the other body, an edge meets all vertices.
    const BoxGrid<D>& grid = is_vertex ? single_vertices(body, body.level) : fresh_boxes(body).vertices;
    grid.visit(box, [&](uint32_t v) {
      add_pair(PairKind::kVertexEdge, add_side(kNone, other, {Simplex::kVertex, v}), segment);
      return true;
    });
  } else {
    single_vertices(body, body.level).visit(box, [&](uint32_t v) {
      add_pair(PairKind::kEdgeEdge, segment, add_side(kNone, other, {Simplex::kVertex, v}));
      return true;
    });
    if (!covers_edges(body.level)) return;
    fresh_boxes(body).edges.visit(box, [&](uint32_t e) {
      add_pair(PairKind::kEdgeEdge, segment, add_side(kNone, other, {Simplex::kEdge, e}));
      return true;
    });
  }
}

/** Calls visit(touch) if a pair touches; whether it did not return false. */
template <int D>
template <class Visit>
bool BodyWays<D>::visit_pair(const Array<Trajectory<D>>& trajectories, PairKind kind, const Side& a, const Side& b,
                             Visit visit) const {
  const auto is_new_side = [&](const Side& side) {
    return side.trajectory != kNone && is_new(trajectories[side.trajectory], side.corners);
  };
  if (!is_new_side(a) && !is_new_side(b)) return true;
  WayTouch<D> touch;
  touch.pair.kind = kind;
  uint32_t at = 0;
  bool moves = false;
  for (const Side* side : {&a, &b}) {
    const SimplexCorners<D>& corners = side->corners;
    const uint32_t count = point_count<D>(kind, side == &a ? 0 : 1);
    for (uint32_t i = 0; i < count; ++i, ++at) {
      const uint32_t v = corners.vertices[std::min(i, corners.count - 1)];
      touch.pair.start[at] = touch.pair.end[at] = side->name->body->position(v);
      if (side->trajectory == kNone) continue;
      touch.pair.end[at] = trajectories[side->trajectory].end(v);
      moves = moves || trajectories[side->trajectory].moves(v);
    }
  }
  if (!moves) return true;
  touch.first = first_touch(touch.pair, work);
  if (!touch.first.touches) return true;
  const Side &mover = a.trajectory != kNone ? a : b, &other = a.trajectory != kNone ? b : a;
  touch.trajectory = mover.trajectory;
  touch.comes_first = &mover == &a;
  touch.part = mover.part;
  touch.wall = {};
  touch.other_trajectory = other.trajectory;
  touch.other = other.name;
  touch.other_part = other.part;
  return visit(touch);
}

/** If edges share a vertex, the far end of each can touch the other edge. */
template <int D>
template <class Visit>
bool BodyWays<D>::visit_hinge(const Array<Trajectory<D>>& trajectories, uint32_t number, const Spoke& a, const Spoke& b,
                              Visit visit) const {
  const Trajectory<D>& of = trajectories[number];
  const Spoke* const both[2] = {&a, &b};
  for (const int side : {0, 1}) {
    const Side far(number, of.name, {Simplex::kVertex, both[side]->far}),
        edge(number, of.name, {Simplex::kEdge, both[1 - side]->edge});
    if (!visit_pair(trajectories, PairKind::kEdgeEdge, far, edge, visit)) return false;
  }
  return true;
}

/** Visits the hinges at all vertices of a trajectory. */
template <int D>
template <class Visit>
bool BodyWays<D>::visit_hinges(const Array<Trajectory<D>>& trajectories, uint32_t number, Visit visit) const {
  if constexpr (D == 3) {
    const Trajectory<D>& of = trajectories[number];
    const Body<D>& body = *of.motion.body;
    if (!body.filter.self || !covers_edges(body.level)) return true;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      spokes_.clear();
      for_each_edge(body, v, [&](uint32_t e) {
        spokes_.push_back(Spoke(of, v, e));
        return true;
      });
      for (size_t i = 0; i < spokes_.size(); ++i) {
        for (size_t k = 0; k < i; ++k) {
          const Spoke &a = spokes_[i], &b = spokes_[k];
          if (of.is_new[v] == 0 && of.is_new[a.far] == 0 && of.is_new[b.far] == 0) continue;
          if (!stays_open(a.arm, b.arm) && !visit_hinge(trajectories, number, a, b, visit)) return false;
        }
      }
    }
  }
  return true;
}

/** Visits the hinges that are listed. */
template <int D>
template <class Visit>
bool BodyWays<D>::visit_listed_hinges(const Array<Trajectory<D>>& trajectories, Visit visit) const {
  if constexpr (D == 3) {
    for (const typename StepPairs<D>::Hinge& hinge : step_pairs_.hinges()) {
      const Trajectory<D>& of = trajectories[hinge.trajectory];
      const Spoke a(of, hinge.vertex, hinge.edges[0]), b(of, hinge.vertex, hinge.edges[1]);
      if (!stays_open(a.arm, b.arm) && !visit_hinge(trajectories, hinge.trajectory, a, b, visit)) return false;
    }
  }
  return true;
}

/** Calls visit(touch) for all that touches, until it returns false. */
template <int D>
template <class Visit>
bool BodyWays<D>::visit_touches(const Array<Trajectory<D>>& trajectories, Visit visit) const {
  for (const Pair& pair : pairs_) {
    if (!visit_pair(trajectories, pair.kind, sides_[pair.sides[0]], sides_[pair.sides[1]], visit)) return false;
  }
  if (has_hinges_ && lists_hinges_) return visit_listed_hinges(trajectories, visit);
  for (uint32_t t = 0; has_hinges_ && t < trajectories.size(); ++t) {
    if (!visit_hinges(trajectories, t, visit)) return false;
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
