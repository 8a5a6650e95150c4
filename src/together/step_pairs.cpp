// Pairs are those of together/body_ways.cpp, without those that boxes or shadows tell apart. In meshes hardly any are left.

#include "together/step_pairs.h"

#include <algorithm>
#include <cmath>

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
  uint32_t living = 0;
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
    ++living;
    largest = std::max(largest, largest_coordinate<D>(start, reach));
  });
  for (uint32_t t = 0; living < count && t < trajectories.size(); ++t) {
    const Body<D>& body = *trajectories[t].motion.body;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) boxes_[first_[t] + v] = all;
    }
  }
  sweep_.set_frame(boxes_, boxes_);
  steps_.resize(count);
  shadows_.start(count, all, largest);
  visit([&](uint32_t number, const double* start, const double* reach) {
    double end[D];
    for (int k = 0; k < D; ++k) end[k] = reach[k] - drift[k];
    shadows_.set(number, start, end);
    steps_[number] = sweep_.steps_of(boxes_[number]);
  });
}

template <int D>
void StepPairs<D>::add_ways(const Array<Trajectory<D>>& trajectories) {
  size_t vertices = 0, segments = 0, faces = 0;
  for (const Trajectory<D>& of : trajectories) {
    vertices += of.motion.body->vertices.size();
    segments += of.motion.body->vertices.size() + of.motion.body->edges.size();
    faces += of.motion.body->faces.size();
  }
  vertices_.start(vertices);
  segments_.start(segments);
  faces_.start(faces);
  const bool meet_vertices =
      D == 2 || dsw::any_of(trajectories.begin(), trajectories.end(),
                            [](const Trajectory<D>& of) { return covers_faces(of.motion.body->level); });
  for (uint32_t t = 0; t < trajectories.size(); ++t) {
    const Body<D>& body = *trajectories[t].motion.body;
    const bool has_edges = covers_edges(body.level);
    const uint32_t first = first_[t];
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      const Way way{{t, {Simplex::kVertex, v}}, {first + v, first + v, first + v}};
      if (meet_vertices) vertices_.add(way, steps_[first + v]);
      if (!has_edges || body.vertices[v].first_edge == kNone) segments_.add(way, steps_[first + v]);
    }
    for (uint32_t e = 0; has_edges && e < body.edges.size(); ++e) {
      if (!body.has_edge(e)) continue;
      const uint32_t a = first + body.edges[e].ends[0], b = first + body.edges[e].ends[1];
      segments_.add({{t, {Simplex::kEdge, e}}, {a, b, a}}, Steps::hull(steps_[a], steps_[b]));
    }
    for (uint32_t f = 0; covers_faces(body.level) && f < body.faces.size(); ++f) {
      if (!body.has_face(f)) continue;
      const uint32_t(&corners)[3] = body.faces[f].corners;
      const uint32_t a = first + corners[0], b = first + corners[1], c = first + corners[2];
      faces_.add({{t, {Simplex::kFace, f}}, {a, b, c}}, Steps::hull(Steps::hull(steps_[a], steps_[b]), steps_[c]));
    }
  }
}

/** Segments, in the plane vertices without edges. */
template <int D>
void StepPairs<D>::find_segments(const Array<Trajectory<D>>& trajectories) {
  near_.resize(segments_.all.size());
  sweep_.visit_own(segments_.steps, [&](uint32_t i, const uint32_t* others, uint32_t count) {
    note_segments(trajectories, segments_.all[i], others, count);
  });
}

template <int D>
void StepPairs<D>::note_segments(const Array<Trajectory<D>>& trajectories, const Way& way, const uint32_t* others,
                                 uint32_t count) {
  if (D == 2 && way.part.simplex.kind != Simplex::kVertex) return;
  // Neighbours are many and in no order: a branch would cost more than all else.
  const uint32_t a = way.corners[0], b = way.corners[1];
  uint32_t near = 0;
  for (uint32_t n = 0; n < count; ++n) {
    const uint32_t(&corners)[3] = segments_.all[others[n]].corners;
    near_[near] = others[n];
    near += static_cast<uint32_t>((corners[0] != a) & (corners[0] != b) & (corners[1] != a) & (corners[1] != b));
  }
  for (uint32_t n = 0; n < near; ++n) {
    const Way& other = segments_.all[near_[n]];
    if (shadows_.part(way.corners, 2, other.corners, 2)) continue;
    if (D == 2 && other.part.simplex.kind != Simplex::kVertex) continue;
    if (!all_meet_ && !do_meet(trajectories, way.part.trajectory, other.part.trajectory)) continue;
    const bool is_later = &way > &other;
    pairs_.push_back({D == 2 ? PairKind::kVertexEdge : PairKind::kEdgeEdge,
                      {is_later ? way.part : other.part, is_later ? other.part : way.part}});
  }
}

/** Faces and vertices, in the plane edges and vertices. */
template <int D>
void StepPairs<D>::find_solids(const Array<Trajectory<D>>& trajectories) {
  const Ways& solids = D == 2 ? segments_ : faces_;
  sweep_.visit_between(
      solids.steps, vertices_.steps,
      [&](uint32_t i, const uint32_t* found, uint32_t count) {
        for (uint32_t n = 0; n < count; ++n) note_solid(trajectories, vertices_.all[found[n]], solids.all[i]);
      },
      [&](uint32_t k, const uint32_t* found, uint32_t count) {
        for (uint32_t n = 0; n < count; ++n) note_solid(trajectories, vertices_.all[k], solids.all[found[n]]);
      });
}

template <int D>
void StepPairs<D>::note_solid(const Array<Trajectory<D>>& trajectories, const Way& vertex, const Way& solid) {
  const uint32_t v = vertex.corners[0];
  if ((v == solid.corners[0]) | (v == solid.corners[1]) | (v == solid.corners[2])) return;
  if (shadows_.part(&v, 1, solid.corners, D)) return;
  if (D == 2 && solid.part.simplex.kind == Simplex::kVertex) return;
  if (!all_meet_ && !do_meet(trajectories, solid.part.trajectory, vertex.part.trajectory)) return;
  pairs_.push_back({D == 2 ? PairKind::kVertexEdge : PairKind::kVertexFace, {vertex.part, solid.part}});
}

/** Edges of a body that meets itself, in space. */
template <int D>
void StepPairs<D>::find_hinges(const Array<Trajectory<D>>& trajectories) {
  for (uint32_t t = 0; D == 3 && t < trajectories.size(); ++t) {
    const Body<D>& body = *trajectories[t].motion.body;
    if (!body.filter.self || !covers_edges(body.level)) continue;
    for (uint32_t v = 0; v < body.vertices.size(); ++v) {
      if (!body.has_vertex(v)) continue;
      uint32_t count = 0;
      for_each_edge(body, v, [&](uint32_t e) {
        if (count == spokes_.size()) spokes_.resize(2 * count + 8);
        spokes_[count++] = {e, shadows_.sides(first_[t] + body.edges[e].other(v), first_[t] + v)};
        return true;
      });
      for (uint32_t i = 0; i < count; ++i) {
        for (uint32_t k = 0; k < i; ++k) {
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
