// Near rows of bodies beside what exact arithmetic says of them.
#pragma once

#include "body_state.h"
#include "near_truth.h"
#include "obstacles.h"

#include <set>

namespace dsw::oracle {

inline std::vector<dsw_near_row> find_rows(dsw_scene* scene, dsw_body_id body, double margin, double radius,
                                           uint32_t flags = 0) {
  dsw_near_options options = defaults(dsw_near_options_init);
  options.margin = margin;
  options.radius = radius;
  options.flags = flags;
  size_t found = 0, count = 0;
  const dsw_near_row* rows = nullptr;
  EXPECT_EQ(dsw_body_find_near_rows(scene, body, &options, &found), DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_EQ(dsw_body_get_near_rows(scene, body, &rows, &count), DSW_STATUS_OK);
  EXPECT_EQ(found, count);
  return std::vector<dsw_near_row>(rows, rows + count);
}

inline std::vector<int> used(const uint32_t* vertices) {
  std::vector<int> ids;
  for (int i = 0; i < 3 && vertices[i] != UINT32_MAX; ++i) ids.push_back(static_cast<int>(vertices[i]));
  std::sort(ids.begin(), ids.end());
  return ids;
}

struct NearTally {
  uint64_t rows = 0, missed = 0, phantom = 0, hidden = 0, overlapped = 0;
};

/// Properties of the running test.
inline void record(const NearTally& tally) {
  testing::Test::RecordProperty("rows", std::to_string(tally.rows));
  testing::Test::RecordProperty("phantom", std::to_string(tally.phantom));
  testing::Test::RecordProperty("missed", std::to_string(tally.missed));
  testing::Test::RecordProperty("overlapped", std::to_string(tally.overlapped));
}

/// What the points of a row must be, up to rounding. `size`: the largest coordinate.
inline void check_numbers(const dsw_near_row& row, const NearTruth::Row& truth, double size) {
  const double bound = 0x1p-44 * size;
  EXPECT_NEAR(row.distance, truth.distance, bound);
  double length = 0, along = 0, way[3];
  for (int k = 0; k < 3; ++k) {
    way[k] = row.point[k] - row.obstacle_point[k];
    length += row.normal[k] * row.normal[k];
    along += way[k] * row.normal[k];
  }
  EXPECT_NEAR(length, 1, 1e-14);
  EXPECT_NEAR(std::hypot(way[0], way[1], way[2]), truth.distance, bound);
  EXPECT_NEAR(along, truth.distance, bound);
  double sum = 0, obstacle_sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum += row.weights[i];
    obstacle_sum += row.obstacle_weights[i];
    EXPECT_GE(row.weights[i], 0);
    EXPECT_GE(row.obstacle_weights[i], 0);
  }
  EXPECT_NEAR(sum, 1, 1e-14);
  EXPECT_NEAR(obstacle_sum, 1, 1e-14);
}

using RowsByIds = std::map<std::pair<std::vector<int>, std::vector<int>>, const dsw_near_row*>;

/// The rows with a body, or with the environment: body 0.0.
inline RowsByIds rows_with(const std::vector<dsw_near_row>& rows, dsw_body_id body) {
  RowsByIds by_ids;
  for (const dsw_near_row& row : rows) {
    if (row.body.index != body.index || row.body.generation != body.generation) continue;
    EXPECT_TRUE(by_ids.emplace(std::pair(used(row.vertices), used(row.obstacle_vertices)), &row).second) << "twice";
  }
  return by_ids;
}

/// Calls visit(vertices, points) for the parts that a level covers.
template <class Visit>
void for_each_part(const BodyState& state, dsw_level level, Visit visit) {
  const auto give = [&](std::vector<int> ids) {
    std::sort(ids.begin(), ids.end());
    std::vector<Vec> points;
    for (const int v : ids) points.push_back(state.at[static_cast<size_t>(v)]);
    visit(ids, points);
  };
  for (size_t v = 0; v < state.at.size(); ++v) give({static_cast<int>(v)});
  for (const auto& e : state.edges) {
    if (level >= DSW_LEVEL_EDGES) give({static_cast<int>(e[0]), static_cast<int>(e[1])});
  }
  for (const auto& f : state.faces) {
    if (level == DSW_LEVEL_FACES) give({static_cast<int>(f[0]), static_cast<int>(f[1]), static_cast<int>(f[2])});
  }
}

/// Ascending.
inline std::vector<int> corners_of(const Cell& cell) {
  std::set<int> vertices;
  for (const Loop& face : cell.faces) vertices.insert(face.begin(), face.end());
  return {vertices.begin(), vertices.end()};
}

/// Whether a point close to `p` on the way from there to the middle of volume `own` lies in two volumes at once.
inline bool overlaps_near(const Place& place, size_t other, size_t own, const Vec& p) {
  const std::vector<int> ids = corners_of(place.mesh.cells[own]);
  Vec middle{};
  for (const int v : ids) {
    for (size_t k = 0; k < 3; ++k)
      middle[k] += place.mesh.points[static_cast<size_t>(v)][k] / static_cast<double>(ids.size());
  }
  for (int halved = 2; halved < 44; ++halved) {
    const BodyPoint at = place.world->body(between(p, middle, std::ldexp(1, -halved)).data());
    if (place.world->contains(static_cast<int>(own), at) && place.world->contains(static_cast<int>(other), at))
      return true;
  }
  return false;
}

/// Whether volumes overlap at the point of an obstacle: a point of a volume that has the obstacle is shown that lies in
/// one, too, that has it not. Volumes overlap where the outer boundary crosses itself, and only there. Then no passable
/// way may lead to the obstacle, although nothing hides it. Or a wall between the two points is one of a volume that is
/// not on the way, and hides nothing.
inline bool is_overlapped(const Place& place, const std::vector<int>& obstacle, const NearTruth::Row& row) {
  const BodyPoint at = place.world->body(row.obstacle_point.data());
  std::vector<size_t> with, without;
  for (size_t c = 0; c < place.mesh.cells.size(); ++c) {
    const std::vector<int> vertices = corners_of(place.mesh.cells[c]);
    if (std::includes(vertices.begin(), vertices.end(), obstacle.begin(), obstacle.end())) {
      with.push_back(c);
    } else if (place.world->contains(static_cast<int>(c), at)) {
      without.push_back(c);
    }
  }
  for (const size_t other : without) {
    for (const size_t own : with) {
      if (overlaps_near(place, other, own, row.obstacle_point)) return true;
    }
  }
  return false;
}

/// Six times the volume of a tetrahedron, with its sign.
inline mpq_class volume6(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  const auto from_a = [&](const Vec& p, size_t k) { return mpq_class(mpq_class(p[k]) - a[k]); };
  mpq_class sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    sum += from_a(d, k) * (from_a(b, i) * from_a(c, j) - from_a(b, j) * from_a(c, i));
  }
  return sum;
}

/// The volume to which a straight way leads that begins in a volume; -1: it meets something impassable. Exact. Only volumes
/// on the way are looked at, so others may overlap them; a volume need not be convex.
inline int follow(const World& world, int cell, const Vec& from, const Vec& to) {
  const auto point = [&](int v) -> const Vec& { return world.mesh.points[static_cast<size_t>(v)]; };
  for (mpq_class at = 0;;) {
    const Triangle* exit = nullptr;
    mpq_class first = 1;
    for (const int t : world.cell_triangles[static_cast<size_t>(cell)]) {
      const Triangle& each = world.triangles[static_cast<size_t>(t)];
      const Vec &a = point(each.v[0]), &b = point(each.v[1]), &c = point(each.v[2]);
      const mpq_class before = volume6(a, b, c, from), behind = volume6(a, b, c, to), way = behind - before;
      if (sgn(way) * (each.cell[0] == cell ? 1 : -1) <= 0) continue;
      const mpq_class time = -before / way;
      if (time <= at || time >= first) continue;
      const int sides[] = {sgn(volume6(from, to, a, b)), sgn(volume6(from, to, b, c)), sgn(volume6(from, to, c, a))};
      if (*std::min_element(sides, sides + 3) < 0 && *std::max_element(sides, sides + 3) > 0) continue;
      exit = &each;
      first = time;
    }
    if (exit == nullptr) return cell;
    if (world.impassable(exit->face)) return -1;
    cell = exit->cell[exit->cell[0] == cell ? 1 : 0];
    at = first;
  }
}

/// Whether a way leads from the first vertex of a part to the part's point, and on to the obstacle, through passable volumes,
/// the last of which has the obstacle. The points are rounded. Where volumes overlap, a wall on the way may be of a volume
/// that is not on it, and hides nothing.
inline bool is_reached(const Place& place, const BodyState& state, const std::vector<int>& part,
                       const std::vector<int>& obstacle, const NearTruth::Row& row) {
  const auto first = static_cast<size_t>(part[0]);
  int cell = follow(*place.world, static_cast<int>(state.volumes[first].index), state.at[first], row.point);
  if (cell >= 0) cell = follow(*place.world, cell, row.point, between(row.obstacle_point, row.point, 0x1p-30));
  if (cell < 0) return false;
  const std::vector<int> vertices = corners_of(place.mesh.cells[static_cast<size_t>(cell)]);
  return std::includes(vertices.begin(), vertices.end(), obstacle.begin(), obstacle.end());
}

inline double largest(const std::vector<Vec>& points) {
  double size = 0;
  for (const Vec& p : points) {
    for (const double x : p) size = std::max(size, std::fabs(x));
  }
  return size;
}

/// The fans of an obstacle.
inline std::vector<NearTruth::Fan> fans_of(const World& world, const NearTruth::Scene& scene,
                                           const NearTruth::Ids& ids) {
  const auto has_all = [](const NearTruth::Ids& of, const NearTruth::Ids& all) {
    return std::includes(of.begin(), of.end(), all.begin(), all.end());
  };
  std::vector<NearTruth::Fan> fans;
  std::set<size_t> seen;
  for (size_t start = 0; start < world.ids.size(); ++start) {
    if (world.cell_marked[start] != 0 || !has_all(corners_of(world.mesh.cells[start]), ids) ||
        !seen.insert(start).second)
      continue;
    NearTruth::Fan fan{{start}, {}};
    std::set<NearTruth::Ids> sides;
    for (size_t i = 0; i < fan.volumes.size(); ++i) {
      for (const int t : world.cell_triangles[fan.volumes[i]]) {
        const Triangle& triangle = world.triangles[static_cast<size_t>(t)];
        NearTruth::Ids side(triangle.v, triangle.v + 3);
        std::sort(side.begin(), side.end());
        sides.insert(side);
        if (!has_all(side, ids) || world.impassable(triangle.face)) continue;
        for (const int next : triangle.cell) {
          if (seen.insert(static_cast<size_t>(next)).second) fan.volumes.push_back(static_cast<size_t>(next));
        }
      }
    }
    std::set<int> neighbours;
    for (const NearTruth::Ids& each : scene.obstacles) {
      const auto is_of_side = [&](const NearTruth::Ids& side) { return has_all(side, each); };
      if (!has_all(each, ids) || std::none_of(sides.begin(), sides.end(), is_of_side)) continue;
      neighbours.insert(each.begin(), each.end());
    }
    for (const int v : ids) neighbours.erase(v);
    fan.neighbours.assign(neighbours.begin(), neighbours.end());
    fans.push_back(fan);
  }
  return fans;
}

/// Everything impassable of a place. `overlaps`: its volumes do, and each fan has to be looked at alone.
inline NearTruth::Scene near_scene(const Place& place, const Obstacles& obstacles, bool overlaps) {
  NearTruth::Scene scene;
  scene.points = scene.wall_points = place.mesh.points;
  obstacles.for_each_simplex([&](const dsw_cell&, std::vector<int> ids) {
    std::sort(ids.begin(), ids.end());
    scene.obstacles.push_back(ids);
    if (ids.size() == 3) scene.walls.push_back(ids);
  });
  if (!overlaps) return scene;
  const World& world = *place.world;
  for (const std::vector<int>& of_cell : world.cell_triangles) {
    scene.volumes.emplace_back();
    for (const int t : of_cell) {
      const int* const v = world.triangles[static_cast<size_t>(t)].v;
      scene.volumes.back().emplace_back(v, v + 3);
    }
  }
  std::set<NearTruth::Ids> parts;
  for (const NearTruth::Ids& each : scene.obstacles) {
    for (const int v : each) {
      parts.insert({v});
      for (const int w : each) {
        if (v < w) parts.insert({v, w});
      }
    }
  }
  for (const NearTruth::Ids& ids : parts) scene.fans[ids] = fans_of(world, scene, ids);
  return scene;
}

/// Rows with what a truth knows, part by part. `counts(part, obstacle)`: whether the pair is one for the body.
/// `overlapping`: the place, if its volumes overlap. NearTruth takes all walls as walls that hide, also those of volumes
/// that are not on the way.
template <class Counts>
void check_rows(RowsByIds by_ids, const BodyState& state, const NearTruth& truth, double limit, dsw_level level,
                double size, Counts counts, NearTally& tally, const Place* overlapping = nullptr) {
  const double tolerance = 0x1p-40 * size;
  for_each_part(state, level, [&](const std::vector<int>& ids, const std::vector<Vec>& part) {
    for (const auto& [obstacle, expected] : truth.rows_of(part, limit + tolerance)) {
      if (!counts(ids, obstacle)) continue;
      const auto at = by_ids.find({ids, obstacle});
      const bool is_near = expected.distance <= limit, is_sure = std::fabs(expected.distance - limit) > tolerance;
      if (at != by_ids.end()) {
        ++tally.rows;
        check_numbers(*at->second, expected, size);
        EXPECT_TRUE(is_near || !is_sure);
        const bool is_hidden = expected.sight == NearTruth::Sight::kHidden,
                   is_open = is_hidden && overlapping != nullptr &&
                             (is_overlapped(*overlapping, obstacle, expected) ||
                              is_reached(*overlapping, state, ids, obstacle, expected));
        EXPECT_TRUE(!is_hidden || is_open) << "hidden: part of " << ids.size() << " with " << ids[0] << ", obstacle of "
                                           << obstacle.size() << " with " << obstacle[0] << " at " << expected.distance;
        tally.overlapped += is_open;
        tally.phantom += (is_hidden && !is_open) || (is_sure && !is_near);
        by_ids.erase(at);
        continue;
      }
      if (expected.sight == NearTruth::Sight::kHidden) ++tally.hidden;
      if (!is_sure || !is_near || expected.sight != NearTruth::Sight::kClear) continue;
      if (!expected.is_in_all) {
        ++tally.overlapped;
        continue;
      }
      if (overlapping != nullptr && is_overlapped(*overlapping, obstacle, expected)) {
        ++tally.overlapped;
        continue;
      }
      ++tally.missed;
      ADD_FAILURE() << "missing: part of " << ids.size() << " with " << ids[0] << ", obstacle of " << obstacle.size()
                    << " with " << obstacle[0] << " at " << expected.distance << " of " << limit;
    }
  });
  for (const auto& [ids, row] : by_ids) {
    ++tally.phantom;
    ADD_FAILURE() << "phantom: part of " << ids.first.size() << " with " << ids.first[0] << ", obstacle of "
                  << ids.second.size() << " with " << ids.second[0] << " at " << row->distance << " obstacle "
                  << row->obstacle << " point " << hex({row->point[0], row->point[1], row->point[2]});
  }
}
inline bool any_pair(const std::vector<int>&, const std::vector<int>&) { return true; }

inline BodyPlan any_plan(Motions& motions, Rng& rng) {
  const double share = std::pow(10, rng.range(-3, -0.3));
  BodyPlan plan;
  plan.at.push_back(rng.chance(0.5) ? motions.start() : motions.site());
  const size_t more = 1 + rng.below(3);
  // In a flat scene a place must lie between two points of the scene to lie in it.
  const bool flat = rng.chance(0.5);
  for (size_t i = 0; i < more; ++i) {
    const Vec& last = plan.at.back();
    plan.at.push_back(flat ? between(last, motions.start(), share) : motions.near(last, share));
  }
  if (more == 2 && rng.chance(0.6)) {
    plan.faces.push_back({0, 1, 2});
  } else {
    for (uint32_t i = 0; i < more; ++i) plan.edges.push_back({i, i + 1});
  }
  return plan;
}

}  // namespace dsw::oracle
