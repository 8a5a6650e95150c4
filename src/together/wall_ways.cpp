// The first contact of an edge with a triangle, under the shift, is one of an end, which the cast of its path finds, or
// of the edge with a side of the triangle. Then the two also touch without the shift. So it is enough to ask first_touch
// about edges and sides, in the plane about edges and corners, and of faces about corners.
//
// What touches at the start may be free under the shift, and stay so. Three tests under the shift say that a part and a
// feature do not meet:
// - Their boxes are apart. The shift moves the part upwards along each axis.
// - All corners of the part stay on one side of the plane of a wall's triangle that has the feature.
// - The determinant of the points of part and feature is affine in each of them. If it has one sign for all choices of
//   start or end of each corner, it is never 0.
// None depends on how vertices are numbered.

#include "together/wall_ways.h"

#include <algorithm>
#include <utility>

#include "base/search.h"
#include "base/sort.h"
#include "predicates/filtered.h"
#include "together/kept_sides.h"
#include "walk/retreat.h"
#include "walk/standard_facets.h"

namespace dsw {

template <int D>
void WallWays<D>::start(const Array<Trajectory<D>>& trajectories) {
  near_.start(trajectories);
  starts_.start(trajectories);
  counts = {};
}

template <int D>
bool WallWays<D>::are_alone(const Array<Trajectory<D>>& trajectories) {
  for (const Trajectory<D>& of : trajectories) {
    const Body<D>& body = *of.motion.body;
    const auto count = static_cast<uint32_t>(body.vertices.size());
    uint32_t v = 0;
    while (v < count && !body.has_vertex(v)) ++v;
    if (v == count) continue;
    const Cell first = body.vertices[v].cell;
    if (!BoxProbe<D>::suits(env_, first)) return false;
    Bounds<D> box(of.start(v));
    for (uint32_t w = v; w < count; ++w) {
      if (!body.has_vertex(w)) continue;
      box.include(of.start(w));
      box.include(of.reach(w));
    }
    if (!probe_.is_free(box, first)) return false;
    for (; v < count; ++v) {
      const Cell cell = body.vertices[v].cell;
      if (cell.valid() && cell != first && !probe_.has_entered(cell)) return false;
    }
  }
  return true;
}

template <int D>
void WallWays<D>::cast_paths(Array<Trajectory<D>>& trajectories) {
  blocked_.clear();
  dsw::cast_paths(
      env_, packet_, counters_, 0,
      [&](auto add) {
        for (uint32_t t = 0; t < trajectories.size(); ++t) {
          Trajectory<D>& of = trajectories[t];
          for (uint32_t v = 0; v < of.motion.ways.size(); ++v) {
            if (!of.motion.body->has_vertex(v) || of.is_new[v] == 0) continue;
            of.motion.stay(v);
            of.limits[v] = 1;
            if (of.moves(v)) add(of.motion, t, v, of.end(v));
          }
        }
      },
      [&](uint32_t t, uint32_t v, const CastResult& path) { note_blocked(trajectories[t], t, v, path); });
}

template <int D>
void WallWays<D>::note_blocked(Trajectory<D>& of, uint32_t number, uint32_t v, const CastResult& path) {
  blocked_.push_back(touch_of(of, number, v, path));
  const double time = blocked_.back().first.time;
  if (limits_parts) of.limits[v] = std::max(0.0, time - first_step<D>(of.start(v), of.end(v), time));
}

template <int D>
bool WallWays<D>::is_free(const Array<Trajectory<D>>& trajectories) {
  return blocked_.empty() && visit_parts(trajectories, [](const WayTouch<D>&) { return false; });
}

template <int D>
void WallWays<D>::find_first(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& first) {
  for (const WayTouch<D>& each : blocked_) add_first(each, first, work);
  visit_parts(trajectories, [&](const WayTouch<D>& touch) {
    add_first(touch, first, work);
    return true;
  });
}

template <int D>
void WallWays<D>::find_all(const Array<Trajectory<D>>& trajectories, Array<WayTouch<D>>& all) {
  all.insert(all.end(), blocked_.begin(), blocked_.end());
  visit_parts(trajectories, [&](const WayTouch<D>& touch) {
    all.push_back(touch);
    return true;
  });
}

template <int D>
bool WallWays<D>::is_kept_free(const WayTouch<D>& touch) noexcept {
  return !boxes_overlap(touch.pair, touch.comes_first ? 0 : 1) ||
         keeps_sides(touch.pair, 1 + static_cast<uint32_t>(touch.part.kind), touch.comes_first);
}

template <int D>
WayTouch<D> WallWays<D>::touch_of(const Trajectory<D>& of, uint32_t number, uint32_t v, const CastResult& path) const {
  const Cell c = path.cell;
  const Shape shape = env_.map.shape(c);
  const uint32_t facet = env_.map.local_of(path.facet, c);
  WayTouch<D> touch{};
  touch.pair.kind = D == 3 ? PairKind::kVertexFace : PairKind::kVertexEdge;
  touch.pair.start[0] = of.start(v);
  touch.pair.end[0] = of.end(v);
  touch.wall = {{path.facet.word, kNone, kNone}, D, path.facet, c};
  const uint32_t count = shape.simplex_first(facet + 1) - shape.simplex_first(facet);
  const bool is_known = count == 1 || limits_parts;
  if (is_known) {
    const double* corners[D];
    boundary_points(env_, c, path.simplex, corners);
    for (int i = 0; i < D; ++i) touch.pair.start[i + 1] = touch.pair.end[i + 1] = corners[i];
    touch.first = {true, crossing_time(env_, c, path.simplex, touch.pair.start[0], touch.pair.end[0])};
  }
  // The cast may name another triangle of a flat facet than the one that is touched. Where times are compared exactly,
  // it has to be this one.
  for (uint32_t s = shape.simplex_first(facet); !is_known && s < shape.simplex_first(facet + 1); ++s) {
    const double* corners[D];
    boundary_points(env_, c, s, corners);
    WayTouch<D> other = touch;
    for (int i = 0; i < D; ++i) other.pair.start[i + 1] = other.pair.end[i + 1] = corners[i];
    other.first = first_touch(other.pair, work);
    if (!touch.first.touches || (other.first.touches && other.first.time < touch.first.time)) touch = other;
  }
  touch.trajectory = number;
  touch.comes_first = true;
  touch.part = {Simplex::kVertex, v};
  touch.other_trajectory = kNone;
  return touch;
}

/** The way of a part, up to a time of it. */
template <int D>
struct WallWays<D>::PartWay {
  const Trajectory<D>& of;
  const uint32_t number;  // of the trajectory
  const Simplex part;
  const SimplexCorners<D>& corners;
  const double limit;
  const double* points[6];  // of each corner where it starts and where it ends
  double places[3][D];      // ends, if the way is not looked at as a whole

  PartWay(const Trajectory<D>& trajectory, uint32_t trajectory_number, const Simplex& simplex,
          const SimplexCorners<D>& simplex_corners, double time)
      : of(trajectory), number(trajectory_number), part(simplex), corners(simplex_corners), limit(time) {
    for (uint32_t i = 0; i < corners.count; ++i) {
      const uint32_t v = corners.vertices[i];
      points[2 * i] = of.start(v);
      points[2 * i + 1] = of.end(v);
      if (limit == 1) continue;
      place_on_way<D>(of.start(v), of.end(v), limit, places[i]);
      points[2 * i + 1] = places[i];
    }
  }
  PartWay(const PartWay&) = delete;
  PartWay& operator=(const PartWay&) = delete;

  /** Without what is touched. A corner of the environment comes before the part, a side comes after it. */
  WayTouch<D> touch() const {
    WayTouch<D> made{};
    made.trajectory = number;
    made.part = part;
    made.pair.kind = D == 2                        ? PairKind::kVertexEdge
                     : part.kind == Simplex::kEdge ? PairKind::kEdgeEdge
                                                   : PairKind::kVertexFace;
    made.comes_first = made.pair.kind == PairKind::kEdgeEdge;
    for (uint32_t i = 0; i < corners.count; ++i) {
      made.pair.start[first_corner(made) + i] = points[2 * i];
      made.pair.end[first_corner(made) + i] = points[2 * i + 1];
    }
    return made;
  }
  static uint32_t first_corner(const WayTouch<D>& touch) { return touch.comes_first ? 0 : 1; }
};

/** Calls visit(touch) for the edges and faces that may touch something, until it returns false. */
template <int D>
template <class Visit>
bool WallWays<D>::visit_parts(const Array<Trajectory<D>>& trajectories, Visit visit) {
  for (uint32_t t = 0; t < trajectories.size(); ++t) {
    const Trajectory<D>& of = trajectories[t];
    plain_.clear();
    const auto look_at = [&](const Simplex& part) {
      return (part.kind == Simplex::kEdge && passes_over(of, part.index)) || visit_part(of, t, part, visit);
    };
    if (note_new_parts(of)) {
      if (!dsw::all_of(parts_.begin(), parts_.end(), look_at)) return false;
    } else {
      note_vertices(of);
      if (!for_each_edge_and_face(*of.motion.body, look_at)) return false;
    }
    if (!visit_plain_edges(of, t, visit)) return false;
  }
  return true;
}

/** Calls visit(touch) for what the edges touch that keep no corridors, until it returns false. Then none of these edges is
 * counted as skipped: a tree tells of those far from all obstacles before anything is visited. */
template <int D>
template <class Visit>
bool WallWays<D>::visit_plain_edges(const Trajectory<D>& of, uint32_t number, Visit visit) {
  const auto with_way = [&](uint32_t e, auto use) {
    const SimplexCorners<D> corners(*of.motion.body, {Simplex::kEdge, e});
    return use(PartWay(of, number, {Simplex::kEdge, e}, corners, limit_of(of, corners)));
  };
  const uint32_t before = counts.skipped;
  counts.skipped += far_.leave_out(of, plain_);
  open_.clear();
  for (const uint32_t e : plain_) {
    const bool is_free = with_way(e, [&](const PartWay& way) {
      const uint32_t* const ends = way.corners.vertices;
      return (way.limit == 1 && corridors_.keeps_to_facet({way_of(of, ends[0]), way_of(of, ends[1])})) || is_alone(way);
    });
    if (is_free) {
      ++counts.skipped;
    } else {
      open_.push_back(e);
    }
  }
  starts_.look_at(of, number, open_);
  for (const uint32_t e : open_) {
    if (with_way(e, [&](const PartWay& way) { return visit_edge(way, visit); })) continue;
    counts.skipped = before;
    return false;
  }
  return true;
}

/** Up to which time of its way a part is looked at. */
template <int D>
double WallWays<D>::limit_of(const Trajectory<D>& of, const SimplexCorners<D>& corners) {
  double limit = 1;
  for (const uint32_t v : corners) limit = std::min(limit, of.limits[v]);
  return limit;
}

template <int D>
void WallWays<D>::note_vertex(const Trajectory<D>& of, uint32_t v) {
  const VertexWay& way = of.motion.ways[v];
  vertices_[v] = static_cast<uint8_t>((of.is_new[v] != 0 ? kNew : 0) | (of.moves(v) ? kMoves : 0) |
                                      (way.from != way.arrival ? kLeaves : 0) | (of.limits[v] > 0 ? 0 : kStands));
}

/** Notes of each vertex what is asked for all edges at it. */
template <int D>
void WallWays<D>::note_vertices(const Trajectory<D>& of) {
  const size_t count = of.motion.ways.size();
  vertices_.resize(count);
  for (uint32_t v = 0; v < count; ++v) {
    if (of.motion.body->has_vertex(v)) note_vertex(of, v);
  }
}

/** Where few vertices are new, as in all rounds but the first, notes the edges and faces at them, in their order, and the
 * vertices of these. False: there are many. */
template <int D>
bool WallWays<D>::note_new_parts(const Trajectory<D>& of) {
  constexpr size_t kFew = 8;  // of so many vertices one is new at most
  const Body<D>& body = *of.motion.body;
  const auto count = static_cast<size_t>(std::count(of.is_new.begin(), of.is_new.end(), uint8_t{1}));
  if (count * kFew > of.is_new.size()) return false;
  parts_.clear();
  vertices_.resize(of.is_new.size());
  for (uint32_t v = 0; v < of.is_new.size(); ++v) {
    if (of.is_new[v] == 0 || !body.has_vertex(v)) continue;
    for_each_simplex_at(body, v, [&](const Simplex& part) {
      if (part.kind == Simplex::kVertex) return true;
      parts_.push_back(part);
      for (const uint32_t corner : SimplexCorners<D>(body, part)) note_vertex(of, corner);
      return true;
    });
  }
  const auto name = [](const Simplex& part) { return std::make_pair(part.kind, part.index); };
  dsw::sort(parts_.begin(), parts_.end(), [&](const Simplex& a, const Simplex& b) { return name(a) < name(b); });
  const auto is_same = [&](const Simplex& a, const Simplex& b) { return name(a) == name(b); };
  parts_.erase(std::unique(parts_.begin(), parts_.end(), is_same), parts_.end());
  return true;
}

/** Whether an edge is not visited now. Three kinds are not: edges that do not move or have no new way, edges that stay in one convex
 * cell, as most do, and edges without corridors. The last kind comes later, in visit_plain_edges. */
template <int D>
bool WallWays<D>::passes_over(const Trajectory<D>& of, uint32_t edge) {
  const Body<D>& body = *of.motion.body;
  const uint32_t(&ends)[2] = body.edges[edge].ends;
  const uint32_t noted = vertices_[ends[0]] | vertices_[ends[1]];
  if ((noted & kNew) == 0 || (noted & kMoves) == 0) return true;
  const Cell cell = of.motion.ways[ends[0]].from;
  const bool stays = (noted & kLeaves) == 0 && of.motion.ways[ends[1]].from == cell && env_.map.convex(cell);
  if (!stays && body.keeps_corridors()) return false;
  ++counts.swept;
  if (stays) {
    ++counts.skipped;
  } else if ((noted & kStands) == 0) {
    plain_.push_back(edge);
  }
  return true;
}

template <int D>
template <class Visit>
bool WallWays<D>::visit_part(const Trajectory<D>& of, uint32_t number, const Simplex& part, Visit visit) {
  const bool is_edge = part.kind == Simplex::kEdge;  // then passes_over has asked
  const SimplexCorners<D> corners(*of.motion.body, part);
  const auto moves = [&](uint32_t v) { return of.moves(v); };
  if (!is_edge && !(is_new(of, corners) && dsw::any_of(corners.begin(), corners.end(), moves))) return true;
  ++counts.swept;
  if (!is_edge && stays_in_cell(of, corners)) {
    ++counts.skipped;
    return true;
  }
  const double limit = limit_of(of, corners);
  if (!(limit > 0)) return true;
  const PartWay way(of, number, part, corners, limit);
  if (is_alone(way)) {
    ++counts.skipped;
    return true;
  }
  return is_edge ? visit_edge(way, visit) : visit_features(way, near_.find(of, number, part), visit);
}

template <int D>
PointWay WallWays<D>::way_of(const Trajectory<D>& of, uint32_t v) {
  const VertexWay& way = of.motion.ways[v];
  return {of.start(v), of.end(v), way.from, way.arrival, of.motion.crossed[v]};
}

/** Calls visit(touch) for the features that an edge touches, until it returns false. */
template <int D>
template <class Visit>
bool WallWays<D>::visit_edge(const PartWay& way, Visit visit) {
  const Body<D>& body = *way.of.motion.body;
  const PointWay ends[2] = {way_of(way.of, way.corners.vertices[0]), way_of(way.of, way.corners.vertices[1])};
  Corridor<D>& corridor = body.keeps_corridors() ? body.corridors.own(way.part.index, env_.obstacle_version)
                                                 : starts_.find(way.of, way.number, way.part.index);
  const bool are_ends = way.limit == 1;
  const Verdict verdict =
      corridors_.ask(corridor, body.call, ends, {way.points[1], way.points[3]}, are_ends, body.keeps_corridors());
  if (verdict == Verdict::kUnknown) return visit_features(way, near_.find(way.of, way.number, way.part), visit);
  if (verdict != Verdict::kStopsAtRidge) {
    ++counts.skipped;
    return true;
  }
  bool touches = false;
  const bool goes_on = visit_features(way, corridors_.features(), [&](const WayTouch<D>& touch) {
    touches = true;
    return visit(touch);
  });
  if (!touches && are_ends && body.keeps_corridors()) corridors_.go_on(corridor, body.call, ends);
  return goes_on;
}

/** Calls visit(touch) for the features that a part touches, until it returns false. A part is skipped if its box overlaps those of
 * none, as the box of a part far from all obstacles does: so what is known of this before, by a tree or by notes, changes no count. */
template <int D>
template <class Visit>
bool WallWays<D>::visit_features(const PartWay& way, const CandidateView<D>& near, Visit visit) {
  if (near.first == near.last) {
    ++counts.skipped;
    return true;
  }
  const uint32_t count = way.corners.count;
  constexpr uint8_t kUnknown = 2;
  is_beside_.assign(near.plane_count, kUnknown);
  const auto is_beside_plane = [&](uint32_t plane) {
    uint8_t& known = is_beside_[plane];
    if (known == kUnknown) known = is_beside(near.planes[plane], way.points, 2 * count) ? 1 : 0;
    return known != 0;
  };
  WayTouch<D> touch = way.touch();
  const uint32_t first = PartWay::first_corner(touch);
  bool overlaps = false;
  double until = way.limit;  // nobody asks what a part touches later than something else
  for (const Candidate& feature : near) {
    for (uint32_t k = 0; k < feature.name.count; ++k) {
      const uint32_t at = (first == 0 ? count : 0) + k;
      touch.pair.start[at] = touch.pair.end[at] = env_.point(feature.name.vertices[k]);
    }
    if (!boxes_overlap(touch.pair, touch.comes_first ? 0 : 1)) continue;
    overlaps = true;
    if (dsw::any_of(near.numbers + feature.first_plane, near.numbers + feature.plane_end, is_beside_plane)) continue;
    if (keeps_sides(touch.pair, count, touch.comes_first)) continue;
    // Times are those on the whole way, not up to the limit.
    WayTouch<D> found = touch;
    found.wall = feature.name;
    for (uint32_t k = 0; k < count; ++k) found.pair.end[first + k] = way.of.end(way.corners.vertices[k]);
    found.first = first_touch(found.pair, work, until);
    if (!found.first.touches || found.first.time > until) continue;
    until = found.first.time;
    if (!visit(found)) return false;
  }
  counts.skipped += overlaps ? 0 : 1;
  return true;
}

/** Whether all corners of a part stay in one convex cell. */
template <int D>
bool WallWays<D>::stays_in_cell(const Trajectory<D>& of, const SimplexCorners<D>& corners) const noexcept {
  const Cell cell = of.motion.ways[corners.vertices[0]].from;
  uint32_t differ = 0;
  for (const uint32_t v : corners) {
    const VertexWay& way = of.motion.ways[v];
    differ |= static_cast<uint32_t>(way.from != cell) | static_cast<uint32_t>(way.arrival != cell);
  }
  return differ == 0 && env_.map.convex(cell);
}

/** Whether a part meets nothing since nothing is near, or in the box of its way. */
template <int D>
bool WallWays<D>::is_alone(const PartWay& way) {
  if (near_.is_alone(way.of, way.part)) return true;
  const Cell cell = way.of.motion.body->vertices[way.corners.vertices[0]].cell;
  if (!BoxProbe<D>::suits(env_, cell)) return false;
  Bounds<D> box(way.points[0]);
  for (uint32_t i = 1; i < 2 * way.corners.count; ++i) box.include(way.points[i]);
  return probe_.is_free(box, cell);
}

template <int D>
bool WallWays<D>::is_beside(const WallPlane<D>& plane, const double* const* points, uint32_t count) const {
  const int side = plane_side<D>(plane.corners, points[0], NoTally{}).sign;
  if (side == 0) return false;
  return dsw::all_of(points + 1, points + count,
                     [&](const double* each) { return plane_side<D>(plane.corners, each, NoTally{}).sign == side; });
}

template class WallWays<2>;
template class WallWays<3>;

}  // namespace dsw
