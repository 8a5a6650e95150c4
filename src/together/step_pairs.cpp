// Pairs are those of together/body_ways.cpp, without those that boxes or shadows tell apart. In meshes hardly any are left.

#include "together/step_pairs.h"

#include "base/search.h"

namespace dsw {
namespace {

/** The box of the way of a vertex without what all go, with room for rounding. */
template <int D>
Box<D> box_beside_drift(const double* start, const double* reach, const double* drift) noexcept {
  Box<D> box;
  for (int k = 0; k < D; ++k) {
    const double end = reach[k] - drift[k],
                 room = 0x1p-48 * (std::fabs(start[k]) + std::fabs(reach[k]) + std::fabs(drift[k]));
    box.lower[k] = std::min(start[k], end) - room;
    box.upper[k] = std::max(start[k], end) + room;
  }
  return box;
}

template <int D>
bool do_meet(const Array<Trajectory<D>>& trajectories, uint32_t a, uint32_t b) noexcept {
  const ContactFilter& filter = trajectories[a].motion.body->filter;
  return a == b ? filter.self : filter.sees(trajectories[b].motion.body->filter);
}

}  // namespace

template <int D>
void StepPairs<D>::find(const Array<Trajectory<D>>& trajectories, const double* drift) {
  pairs_.clear();
  hinges_.clear();
  place_vertices(trajectories, drift);
  add_ways(trajectories);
  const ContactFilter& filter = trajectories[0].motion.body->filter;
  all_meet_ = filter.self && filter.sees(filter) &&
              dsw::all_of(trajectories.begin(), trajectories.end(), [&](const Trajectory<D>& of) {
                const ContactFilter& other = of.motion.body->filter;
                return other.self && other.category == filter.category && other.mask == filter.mask;
              });
  find_segments(trajectories);
  find_solids(trajectories);
  find_hinges(trajectories);
}

template <int D>
void StepPairs<D>::place_vertices(const Array<Trajectory<D>>& trajectories, const double* drift) {
  first_.clear();
  uint32_t count = 0;
  for (const Trajectory<D>& of : trajectories) {
    first_.push_back(count);
    count += static_cast<uint32_t>(of.motion.body->vertices.size());
  }
  boxes_.resize(count);
  Box<D> all;
  double largest = largest_coordinate<D>(drift);
  const auto visit = [&](auto place) {
    for (size_t t = 0; t < trajectories.size(); ++t) {
      const Trajectory<D>& of = trajectories[t];
      const auto vertices = static_cast<uint32_t>(of.motion.body->vertices.size());
      for (uint32_t v = 0; v < vertices; ++v) {
        if (of.motion.body->has_vertex(v)) place(first_[t] + v, of.start(v), of.reach(v));
      }
    }
  };
  visit([&](uint32_t number, const double* start, const double* reach) {
    boxes_[number] = box_beside_drift<D>(start, reach, drift);
    all.add(boxes_[number]);
    largest = std::max(largest, largest_coordinate<D>(start, reach));
  });
  shadows_.start(count, all, largest);
  visit([&](uint32_t number, const double* start, const double* reach) {
    double end[D];
    for (int k = 0; k < D; ++k) end[k] = reach[k] - drift[k];
    shadows_.set(number, start, end);
  });
}

template <int D>
void StepPairs<D>::add(Ways& ways, uint32_t trajectory, const Simplex& simplex, const uint32_t* corners,
                       uint32_t count) {
  Way& way = ways.all.emplace_back(Way{{trajectory, simplex}, {}});
  Box<D>& box = ways.boxes.emplace_back(boxes_[first_[trajectory] + corners[0]]);
  for (uint32_t i = 0; i < 3; ++i) way.corners[i] = first_[trajectory] + corners[i < count ? i : 0];
  for (uint32_t i = 1; i < count; ++i) {
    const Box<D>& other = boxes_[way.corners[i]];
    for (int k = 0; k < D; ++k) {
      box.lower[k] = std::min(box.lower[k], other.lower[k]);
      box.upper[k] = std::max(box.upper[k], other.upper[k]);
    }
  }
}

template <int D>
void StepPairs<D>::add_ways(const Array<Trajectory<D>>& trajectories) {
  for (Ways* each : {&segments_, &vertices_, &faces_}) {
    each->all.clear();
    each->boxes.clear();
  }
  const bool meet_vertices =
      D == 2 || dsw::any_of(trajectories.begin(), trajectories.end(),
                            [](const Trajectory<D>& of) { return covers_faces(of.motion.body->level); });
  for (uint32_t t = 0; t < trajectories.size(); ++t) {
    const Body<D>& body = *trajectories[t].motion.body;
    const bool has_edges = covers_edges(body.level);
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      if (meet_vertices) add(vertices_, t, {Simplex::kVertex, v}, &v, 1);
      if (!has_edges || body.vertices[v].first_edge == kNone) add(segments_, t, {Simplex::kVertex, v}, &v, 1);
    }
    for (uint32_t e = 0; has_edges && e < body.edges.size(); ++e) {
      if (body.has_edge(e)) add(segments_, t, {Simplex::kEdge, e}, body.edges[e].ends, 2);
    }
    for (uint32_t f = 0; covers_faces(body.level) && f < body.faces.size(); ++f) {
      if (body.has_face(f)) add(faces_, t, {Simplex::kFace, f}, body.faces[f].corners, 3);
    }
  }
}

/** Segments, in the plane vertices without edges. */
template <int D>
void StepPairs<D>::find_segments(const Array<Trajectory<D>>& trajectories) {
  sweep_.visit_own(segments_.boxes, [&](uint32_t i, uint32_t k) {
    const Way &a = segments_.all[std::max(i, k)], &b = segments_.all[std::min(i, k)];
    if (a.corners[0] == b.corners[0] || a.corners[0] == b.corners[1] || a.corners[1] == b.corners[0] ||
        a.corners[1] == b.corners[1]) {
      return;
    }
    if (D == 2 && (a.part.simplex.kind != Simplex::kVertex || b.part.simplex.kind != Simplex::kVertex)) return;
    if (!all_meet_ && !do_meet(trajectories, a.part.trajectory, b.part.trajectory)) return;
    if (shadows_.part(a.corners, 2, b.corners, 2)) return;
    pairs_.push_back({D == 2 ? PairKind::kVertexEdge : PairKind::kEdgeEdge, {a.part, b.part}});
  });
}

/** Faces and vertices, in the plane edges and vertices. */
template <int D>
void StepPairs<D>::find_solids(const Array<Trajectory<D>>& trajectories) {
  const Ways& solids = D == 2 ? segments_ : faces_;
  sweep_.visit_between(solids.boxes, vertices_.boxes, [&](uint32_t i, uint32_t k) {
    const Way &solid = solids.all[i], &vertex = vertices_.all[k];
    const uint32_t v = vertex.corners[0];
    if (v == solid.corners[0] || v == solid.corners[1] || v == solid.corners[2]) return;
    if (D == 2 && solid.part.simplex.kind == Simplex::kVertex) return;
    if (!all_meet_ && !do_meet(trajectories, solid.part.trajectory, vertex.part.trajectory)) return;
    if (shadows_.part(&v, 1, solid.corners, D)) return;
    pairs_.push_back({D == 2 ? PairKind::kVertexEdge : PairKind::kVertexFace, {vertex.part, solid.part}});
  });
}

/** Edges of a body that meets itself, in space. */
template <int D>
void StepPairs<D>::find_hinges(const Array<Trajectory<D>>& trajectories) {
  for (uint32_t t = 0; D == 3 && t < trajectories.size(); ++t) {
    const Body<D>& body = *trajectories[t].motion.body;
    if (!body.filter.self || !covers_edges(body.level)) continue;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      spokes_.clear();
      for_each_edge(body, v, [&](uint32_t e) {
        spokes_.push_back({e, shadows_.sides(first_[t] + body.edges[e].other(v), first_[t] + v)});
        return true;
      });
      for (size_t i = 0; i < spokes_.size(); ++i) {
        for (size_t k = 0; k < i; ++k) {
          if (spokes_[i].sides.are_opposite(spokes_[k].sides)) continue;
          hinges_.push_back({t, v, {spokes_[i].edge, spokes_[k].edge}});
        }
      }
    }
  }
}

template class StepPairs<2>;
template class StepPairs<3>;

}  // namespace dsw
