#include "together/near_walls.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/sort.h"

namespace dsw {

template <int D>
void NearWalls<D>::start(const Array<Trajectory<D>>& trajectories) {
  features_.clear();
  planes_.clear();
  plane_numbers_.clear();
  edges_.clear();
  faces_.clear();
  for (const Trajectory<D>& of : trajectories) {
    const Body<D>& body = *of.motion.body;
    edges_.emplace_back(covers_edges(body.level) ? body.edges.size() : 0, Range{}, env_.memory);
    faces_.emplace_back(covers_faces(body.level) ? body.faces.size() : 0, Range{}, env_.memory);
  }
}

/** Whether something is remembered of what is near a part. Edges among convex cells remember nothing, as corridors mostly
 * answer. */
template <int D>
bool NearWalls<D>::keeps_notes(const Trajectory<D>& of, const Simplex& part) const {
  const Body<D>& body = *of.motion.body;
  if (of.notes == nullptr || is_covered(body, part)) return false;
  if (part.kind != Simplex::kEdge) return true;
  return !env_.map.convex(body.vertices[body.edges[part.index].ends[0]].cell);
}

/** Whether it is known that nothing is near the way of a part. */
template <int D>
bool NearWalls<D>::is_alone(const Trajectory<D>& of, const Simplex& simplex) {
  if (!keeps_notes(of, simplex)) return false;
  const Part<D> part(*of.motion.body, simplex);
  const Reach reach = reach_of(of, part);
  return reach.is_short() && lists_.is_alone(*of.motion.body, part, reach.way, *of.notes);
}

template <int D>
CandidateView<D> NearWalls<D>::find(const Trajectory<D>& of, uint32_t number, const Simplex& simplex) {
  Range& near = (simplex.kind == Simplex::kEdge ? edges_ : faces_)[number][simplex.index];
  if (near.first_feature == kNone) {
    const Part<D> part(*of.motion.body, simplex);
    const Reach reach = reach_of(of, part);
    near.first_feature = near.feature_end = static_cast<uint32_t>(features_.size());
    near.first_plane = near.plane_end = static_cast<uint32_t>(planes_.size());
    collect(of, part, keeps_notes(of, simplex) && reach.is_short() ? &reach : nullptr, near);
  }
  return {features_.data() + near.first_feature, features_.data() + near.feature_end, plane_numbers_.data(),
          planes_.data() + near.first_plane, near.plane_end - near.first_plane};
}

/** How far the corners of a part go in the call, or a little more, and how large the part is. */
template <int D>
typename NearWalls<D>::Reach NearWalls<D>::reach_of(const Trajectory<D>& of, const Part<D>& part) {
  constexpr double kMoreThanDiagonal = 1.8;  // than the square root of 3
  Reach reach{0, 0};
  for (uint32_t i = 0; i < part.corners.count; ++i) {
    const double *const from = part.points[i], *const to = of.reach(part.corners.vertices[i]);
    for (int k = 0; k < D; ++k) {
      reach.way = std::max(reach.way, std::fabs(to[k] - from[k]));
      reach.size = std::max(reach.size, std::fabs(from[k] - part.points[0][k]));
    }
  }
  reach.way *= kMoreThanDiagonal;
  return reach;
}

/** Finds what is near the whole way of a part in the call. The flood goes through all passable cells that meet a region
 * round this way. What the part touches first it comes to through such cells. Shorter tries and later rounds lead
 * through the same region. */
template <int D>
void NearWalls<D>::collect(const Trajectory<D>& of, const Part<D>& part, const Reach* kept, Range& near) {
  // How far it looks in advance: times the way, and times the size. The lesser is taken.
  constexpr double kWays = 3, kSizes = 0.5;
  const Box<D> box = box_of_way(of, part.simplex);
  obstacles_.clear();
  sides_.clear();
  if (kept != nullptr) {
    const double wanted = std::min(kWays * kept->way, kSizes * kept->size);
    const NearView<D> view = lists_.near(*of.motion.body, part, 0, kept->way, *of.notes, wanted);
    add_obstacles(view.list, &view.near, box);
  } else {
    const uint32_t count = part.corners.count;
    const double* points[6] = {};
    for (uint32_t i = 0; i < count; ++i) {
      points[i] = part.points[i];
      points[count + i] = of.reach(part.corners.vertices[i]);
    }
    const Cell start = of.motion.body->vertices[part.corners.vertices[0]].cell;
    add_obstacles(lists_.in(start, NearRegion<D>(points, 2 * count, room_of_rounding<D>(points, 2 * count))), nullptr,
                  box);
  }
  add_features(D == 2 || part.simplex.kind == Simplex::kFace, near);
  near.plane_end = static_cast<uint32_t>(planes_.size());
  near.feature_end = static_cast<uint32_t>(features_.size());
}

template <int D>
void NearWalls<D>::add_obstacles(const NearList<D>& list, const NearSelection<D>* selection, const Box<D>& box) {
  const auto add = [&](const WallFeature& o) {
    const double* points[D];
    WallFeature named = o;
    for (uint32_t i = 0; i < o.count; ++i) {
      named.vertices[i] = list.name(o.vertices[i]);
      points[i] = env_.point(named.vertices[i]);
    }
    if (box.overlaps(points, static_cast<int>(o.count))) obstacles_.push_back(named);
  };
  if (selection == nullptr) {
    for (const WallFeature& o : list.obstacles()) add(o);
  } else {
    for (const uint32_t i : selection->obstacles()) add(list.obstacles()[i]);
  }
}

/** The sides of the obstacles, or their corners, each once, with the planes that they lie in. */
template <int D>
void NearWalls<D>::add_features(bool corners_alone, Range& near) {
  for (uint32_t o = 0; o < obstacles_.size(); ++o) {
    const WallFeature& obstacle = obstacles_[o];
    uint32_t plane = kNone;
    if (obstacle.count == D) {
      plane = static_cast<uint32_t>(planes_.size()) - near.first_plane;
      WallPlane<D>& added = planes_.emplace_back();
      for (int i = 0; i < D; ++i) added.corners[i] = env_.point(obstacle.vertices[i]);
    }
    for (uint32_t i = 0; i < obstacle.count; ++i) {
      const uint32_t a = obstacle.vertices[i], b = obstacle.vertices[(i + 1) % obstacle.count];
      if (corners_alone) {
        sides_.push_back({{a, a}, plane, o});
      } else if (a != b && !(obstacle.count == 2 && i == 1)) {
        sides_.push_back({{std::min(a, b), std::max(a, b)}, plane, o});
      }
    }
  }
  dsw::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
    return std::tie(a.vertices[0], a.vertices[1], a.obstacle) < std::tie(b.vertices[0], b.vertices[1], b.obstacle);
  });
  for (size_t i = 0; i < sides_.size();) {
    const Side& first = sides_[i];
    Candidate feature{{{first.vertices[0], first.vertices[1], kNone}, corners_alone ? 1u : 2u, {}, {}}, 0, 0};
    feature.first_plane = static_cast<uint32_t>(plane_numbers_.size());
    for (; i < sides_.size() && std::equal(sides_[i].vertices, sides_[i].vertices + 2, feature.name.vertices); ++i) {
      const WallFeature& obstacle = obstacles_[sides_[i].obstacle];
      if (sides_[i].plane != kNone) plane_numbers_.push_back(sides_[i].plane);
      feature.name.add_name(env_.map, obstacle.facet, obstacle.cell);
    }
    feature.plane_end = static_cast<uint32_t>(plane_numbers_.size());
    features_.push_back(feature);
  }
}

template class NearWalls<2>;
template class NearWalls<3>;

}  // namespace dsw
