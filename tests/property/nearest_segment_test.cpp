// What is nearest to a segment, against all impassable features in exact rational arithmetic; and batches of points
// and segments against one at a time.
#include "obstacles.h"
#include "plane_support.h"

#include "../gmp_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace dsw::oracle::near_segment {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

class NearestSegmentTest : public SceneTest {};
DSW_FOR_ALL_SCENES(NearestSegmentTest);

using Q = mpq_class;
using Q3 = std::array<Q, 3>;
Q3 exact(const Vec& a) { return {Q(a[0]), Q(a[1]), Q(a[2])}; }
Q3 operator-(const Q3& a, const Q3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Q3 at(const Q3& a, const Q& t, const Q3& u) { return {a[0] + t * u[0], a[1] + t * u[1], a[2] + t * u[2]}; }
Q dot(const Q3& a, const Q3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Q square(const Q3& a) { return dot(a, a); }
Q3 cross(const Q3& a, const Q3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Squared distances.
Q to_segment(const Q3& p, const Q3& a, const Q3& b) {
  const Q3 u = b - a;
  const Q length = square(u), t = dot(p - a, u);
  if (t <= 0) return square(p - a);
  return t >= length ? square(p - b) : square(p - at(a, t / length, u));
}
Q between_segments(const Q3& p, const Q3& q, const Q3& a, const Q3& b) {
  Q best = std::min({to_segment(p, a, b), to_segment(q, a, b), to_segment(a, p, q), to_segment(b, p, q)});
  const Q3 u = q - p, v = b - a, w = a - p, n = cross(u, v);
  const Q nn = square(n);
  if (nn == 0) return best;
  const Q s = dot(cross(w, v), n) / nn, t = dot(cross(w, u), n) / nn;
  if (s > 0 && s < 1 && t > 0 && t < 1) best = std::min<Q>(best, dot(w, n) * dot(w, n) / nn);
  return best;
}
bool foot_is_inside(const Q3& p, const Q3& a, const Q3& b, const Q3& c, const Q3& n) {
  return dot(n, cross(b - a, p - a)) >= 0 && dot(n, cross(c - b, p - b)) >= 0 && dot(n, cross(a - c, p - c)) >= 0;
}
Q to_triangle(const Q3& p, const Q3& q, const Q3& a, const Q3& b, const Q3& c) {
  Q best = std::min({between_segments(p, q, a, b), between_segments(p, q, b, c), between_segments(p, q, c, a)});
  const Q3 n = cross(b - a, c - a);
  const Q above = dot(n, p - a), below = dot(n, q - a), nn = square(n);
  if (nn == 0) return best;
  if (sgn(above) * sgn(below) < 0 && foot_is_inside(at(p, above / (above - below), q - p), a, b, c, n)) return 0;
  if (foot_is_inside(p, a, b, c, n)) best = std::min<Q>(best, above * above / nn);
  if (foot_is_inside(q, a, b, c, n)) best = std::min<Q>(best, below * below / nn);
  return best;
}

/// An impassable feature, and how far its box is from that of the segment at least.
struct Feature {
  dsw_cell cell;
  std::vector<Vec> corners;
  double apart;
  Q squared(const Vec& p, const Vec& q) const {
    const auto corner = [&](size_t i) { return exact(corners[i]); };
    if (corners.size() == 1) return to_segment(corner(0), exact(p), exact(q));
    if (corners.size() == 2) return between_segments(exact(p), exact(q), corner(0), corner(1));
    return to_triangle(exact(p), exact(q), corner(0), corner(1), corner(2));
  }
  /// The largest difference of a coordinate from the segment's first point.
  double extent(const Vec& p) const {
    double most = 0;
    for (const Vec& v : corners) {
      for (size_t k = 0; k < 3; ++k) most = std::max(most, std::fabs(v[k] - p[k]));
    }
    return most;
  }
};

std::vector<Feature> nearest_boxes_first(const Obstacles& obstacles, const Vec& p, const Vec& q) {
  std::vector<Feature> features;
  obstacles.for_each([&](const dsw_cell& cell, const std::vector<Vec>& corners) {
    double apart = 0;
    for (size_t k = 0; k < 3; ++k) {
      double low = corners[0][k], high = low;
      for (const Vec& v : corners) {
        low = std::min(low, v[k]);
        high = std::max(high, v[k]);
      }
      apart = std::max({apart, low - std::max(p[k], q[k]), std::min(p[k], q[k]) - high});
    }
    features.push_back({cell, corners, apart});
  });
  std::sort(features.begin(), features.end(), [](const Feature& a, const Feature& b) { return a.apart < b.apart; });
  return features;
}

/// How many cells have a box that is within `distance` of the segment's box.
uint32_t cells_within(const World& world, const Vec& p, const Vec& q, double distance) {
  constexpr Vec kNothingLow = {kNoLimit, kNoLimit, kNoLimit}, kNothingHigh = {-kNoLimit, -kNoLimit, -kNoLimit};
  std::vector<std::array<Vec, 2>> boxes(world.mesh.cells.size(), {kNothingLow, kNothingHigh});
  for (const Face& face : world.faces) {
    for (const int cell : face.cell) {
      if (cell < 0) continue;
      auto& [low, high] = boxes[static_cast<size_t>(cell)];
      for (const int corner : face.loop) {
        const Vec& v = world.mesh.points[static_cast<size_t>(corner)];
        for (size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], v[k]);
          high[k] = std::max(high[k], v[k]);
        }
      }
    }
  }
  return static_cast<uint32_t>(std::count_if(boxes.begin(), boxes.end(), [&](const std::array<Vec, 2>& box) {
    double apart = 0;
    for (size_t k = 0; k < 3; ++k) {
      apart = std::max({apart, box[0][k] - std::max(p[k], q[k]), std::min(p[k], q[k]) - box[1][k]});
    }
    return apart <= distance;
  }));
}

/// From everywhere to everywhere: long and short, in axes, through vertices and along edges, beside edges, and points.
std::array<Vec, 2> any_segment(const World& world, Motions& motions, Rng& rng) {
  const auto any_vertex = [&] { return world.mesh.points[rng.below(world.mesh.points.size())]; };
  const Vec p = rng.chance(0.8) ? motions.start() : motions.site();
  Vec q = p;
  switch (rng.below(9)) {
    case 0:
      return {p, p};
    case 1:
      return {p, motions.along_axis(p, 0.3)};
    case 2:
      return {p, any_vertex()};
    case 3: {
      const Vec v = any_vertex();
      for (size_t k = 0; k < 3; ++k) q[k] = p[k] + 2 * (v[k] - p[k]);
      return {p, q};
    }
    case 4:
      return {motions.site(), motions.site()};
    case 5: {  // as an edge, and nearly
      const Loop& loop = world.faces[rng.below(world.faces.size())].loop;
      const Vec &a = world.mesh.points[static_cast<size_t>(loop[0])],
                &b = world.mesh.points[static_cast<size_t>(loop[1])];
      const double turn = rng.chance(0.5) ? 0 : std::ldexp(rng.range(-1, 1), -rng.between(0, 50));
      for (size_t k = 0; k < 3; ++k) q[k] = p[k] + (b[k] - a[k]) + turn * (b[(k + 1) % 3] - a[(k + 1) % 3]);
      return {p, q};
    }
    case 6:
      return {p, motions.near(p, 1e-3)};
    case 7:
      return {p, motions.target(p)};
    default:
      return {p, motions.near(p, 0.2)};
  }
}

/// |d - sqrt(squared)| <= bound.
bool is_root(double d, const Q& squared, double bound) {
  const Q low = Q(d) - Q(bound), high = Q(d) + Q(bound);
  return (low <= 0 || low * low <= squared) && squared <= high * high;
}

TEST_P(NearestSegmentTest, IsTheNearestOfAll) {
  int passing = 0, free = 0;
  for (uint64_t seed = 71; seed < 71 + seeds_of(3); ++seed) {
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    World& world = *place.world;
    Rng rng(seed);
    Motions motions(world, rng);
    const Obstacles obstacles(place, rng);
    for (int i = 0; i < 120; ++i) {
      const auto [p, q] = any_segment(world, motions, rng);
      if (!finite(p) || !finite(q)) continue;
      SCOPED_TRACE("seed " + std::to_string(seed) + " from " + hex(p) + " to " + hex(q));
      dsw_segment_nearest near;
      dsw_volume_id volume;
      dsw_location location;
      const auto ask = [&](const Vec& from, const Vec& to, double radius) {
        return dsw_environment_find_nearest_to_segments(place.get(), 1, nullptr, from.data(), to.data(), 0, radius,
                                                        &near, &volume, &location);
      };
      ASSERT_EQ(ask(p, q, kNoLimit), DSW_STATUS_OK) << dsw_last_error_message();
      const Walk walk = world.cast(world.body(p.data()), world.body(q.data()));
      if (walk.outcome == Walk::kOutside || walk.outcome == Walk::kImpassable) {
        EXPECT_EQ(location, walk.outcome == Walk::kOutside ? DSW_LOCATION_OUTSIDE : DSW_LOCATION_IMPASSABLE);
        const dsw_cell touched = obstacles.touched(p);
        EXPECT_EQ(near.nearest.distance, touched.kind == DSW_CELL_NONE ? kNoLimit : 0);
        EXPECT_TRUE(same(near.nearest.cell, touched)) << near.nearest.cell << " for " << touched;
        EXPECT_EQ(near.segment_parameter, 0);
        continue;
      }
      EXPECT_EQ(location, DSW_LOCATION_PASSABLE);
      if (walk.outcome == Walk::kContact) {
        ++passing;
        dsw_flight flight;
        ASSERT_EQ(dsw_environment_cast(place.get(), {0, 0}, p.data(), q.data(), nullptr, &flight), DSW_STATUS_OK);
        EXPECT_EQ(near.nearest.distance, 0);
        EXPECT_EQ(near.segment_parameter, walk.time);
        EXPECT_TRUE(same(near.nearest.cell, cell_of(face_id(world, walk.face))));
        EXPECT_EQ(near.nearest.tag, flight.contact.tag);
        for (int k = 0; k < 3; ++k) {
          EXPECT_EQ(near.nearest.point[k], near.segment_point[k]);
          EXPECT_EQ(near.nearest.normal[k], 0);
        }
        continue;
      }
      ++free;
      Q best;
      double extent = 0, named_extent = 0;
      bool is_named = false, is_first = true;
      for (const double x : {q[0] - p[0], q[1] - p[1], q[2] - p[2]}) extent = std::max(extent, std::fabs(x));
      const std::vector<Feature> features = nearest_boxes_first(obstacles, p, q);
      Q named;
      for (const Feature& feature : features) {
        const bool is_this = same(feature.cell, near.nearest.cell);
        if (!is_this && !is_first && Q(feature.apart) * Q(feature.apart) > best) continue;
        const Q squared = feature.squared(p, q);
        if (is_first || squared < best) {
          best = squared;
          named_extent = std::max(named_extent, feature.extent(p));
        }
        if (is_this && (!is_named || squared < named)) named = squared;
        if (is_this) named_extent = std::max(named_extent, feature.extent(p));
        is_named = is_named || is_this;
        is_first = false;
      }
      ASSERT_FALSE(is_first);
      const double bound = 0x1p-49 * std::max(extent, named_extent), d = near.nearest.distance;
      EXPECT_TRUE(is_root(d, best, bound))
          << d << " for " << std::sqrt(best.get_d()) << ", off by " << (d - std::sqrt(best.get_d())) / bound
          << " bounds, names " << near.nearest.cell;
      ASSERT_TRUE(is_named);
      EXPECT_TRUE(is_root(d, named, bound)) << near.nearest.cell << " is " << std::sqrt(named.get_d()) << " away";
      // The two points belong together.
      const double rounding = bound + 0x1p-50 * world.size;
      const double t = near.segment_parameter;
      EXPECT_TRUE(t >= 0 && t <= 1);
      Vec gap;
      double length = 0;
      for (size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(near.segment_point[k], p[k] + t * (q[k] - p[k]), rounding);
        gap[k] = near.segment_point[k] - near.nearest.point[k];
        length += near.nearest.normal[k] * near.nearest.normal[k];
      }
      EXPECT_NEAR(std::hypot(gap[0], gap[1], gap[2]), d, 4 * rounding);
      if (d > 0) {
        EXPECT_NEAR(length, 1, 1e-14);
        for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(d * near.nearest.normal[k], gap[k], 4 * rounding);
      }
      if (p == q) {
        dsw_nearest point;
        ASSERT_EQ(dsw_environment_find_nearest(place.get(), p.data(), volume, kNoLimit, &point), DSW_STATUS_OK);
        EXPECT_EQ(point.distance, d) << "a segment without a length is a point";
        EXPECT_TRUE(same(point.cell, near.nearest.cell));
      }
      if (d < 1e-9 * world.size) continue;
      const dsw_segment_nearest first = near;
      ASSERT_EQ(ask(p, q, d * 1.001), DSW_STATUS_OK);
      EXPECT_EQ(near.nearest.distance, d);
      EXPECT_TRUE(same(near.nearest.cell, first.nearest.cell));
      // Without a limit the tree of obstacles is asked after fewer volumes.
      EXPECT_LE(near.nearest.volumes_visited,
                std::max(first.nearest.volumes_visited, cells_within(world, p, q, d * 1.001)));
      ASSERT_EQ(ask(p, q, d * 0.999), DSW_STATUS_OK);
      EXPECT_EQ(near.nearest.distance, kNoLimit);
      EXPECT_EQ(near.nearest.cell.kind, DSW_CELL_NONE);
      EXPECT_EQ(near.segment_parameter, 0);
      ASSERT_EQ(ask(q, p, kNoLimit), DSW_STATUS_OK);
      EXPECT_NEAR(near.nearest.distance, d, 2 * rounding) << "backwards";
    }
  }
  EXPECT_GT(passing, 20);
  EXPECT_GT(free, 20);
}

TEST_P(NearestSegmentTest, BatchesAreTheSameAsOneByOne) {
  constexpr size_t kCount = 700;
  Place place = make_place(GetParam(), 75);
  ASSERT_PLACE(place);
  Rng rng(75);
  Motions motions(*place.world, rng);
  const Obstacles obstacles(place, rng);
  std::vector<double> from, to;
  std::vector<dsw_volume_id> hints(kCount), volumes(kCount);
  std::vector<dsw_location> locations(kCount);
  Vec last = motions.start();
  for (size_t i = 0; i < kCount; ++i) {
    const Vec p = rng.chance(0.7) ? last : motions.site();
    last = rng.chance(0.7) ? motions.near(p, 0.1) : motions.start();
    from.insert(from.end(), {p[0], p[1], p[2], 0});
    to.insert(to.end(), {last[0], last[1], last[2], 0});
    if (rng.chance(0.3)) hints[i] = place.world->ids[rng.below(place.world->ids.size())];
  }
  std::vector<dsw_nearest> points(kCount);
  std::vector<dsw_segment_nearest> segments(kCount), again(kCount);
  std::memset(segments.data(), 0, kCount * sizeof segments[0]);
  std::memset(again.data(), 0, kCount * sizeof again[0]);
  const double radius = 0.3 * place.world->size;
  ASSERT_EQ(dsw_environment_find_nearest_to_points(place.get(), from.data(), kCount, 32, hints.data(), radius,
                                                   points.data(), volumes.data(), locations.data()),
            DSW_STATUS_OK);
  ASSERT_EQ(dsw_environment_find_nearest_to_segments(place.get(), kCount, nullptr, from.data(), to.data(), 32, radius,
                                                     again.data(), nullptr, nullptr),
            DSW_STATUS_OK);
  // The volumes may take the place of the hints.
  ASSERT_EQ(dsw_environment_find_nearest_to_segments(place.get(), kCount, hints.data(), from.data(), to.data(), 32,
                                                     radius, segments.data(), hints.data(), nullptr),
            DSW_STATUS_OK);
  EXPECT_EQ(std::memcmp(segments.data(), again.data(), kCount * sizeof again[0]), 0) << "hints do not matter";
  for (size_t i = 0; i < kCount; ++i) {
    const double* const p = from.data() + 4 * i;
    dsw_volume_id volume;
    dsw_location location;
    ASSERT_EQ(dsw_environment_locate(place.get(), p, {0, 0}, &volume, &location), DSW_STATUS_OK);
    EXPECT_TRUE(same(volume, volumes[i]));
    EXPECT_TRUE(same(volume, hints[i]));
    EXPECT_EQ(location, locations[i]);
    dsw_segment_nearest one;
    std::memset(&one, 0, sizeof one);
    ASSERT_EQ(dsw_environment_find_nearest_to_segments(place.get(), 1, nullptr, p, to.data() + 4 * i, 0, radius, &one,
                                                       nullptr, nullptr),
              DSW_STATUS_OK);
    EXPECT_EQ(std::memcmp(&one, &segments[i], sizeof one), 0) << i;
    dsw_nearest point;
    EXPECT_TRUE(location == DSW_LOCATION_PASSABLE || points[i].volumes_visited == 0);
    if (location != DSW_LOCATION_PASSABLE && points[i].distance == kNoLimit) {
      EXPECT_EQ(points[i].cell.kind, DSW_CELL_NONE);
      EXPECT_EQ(obstacles.touched({p[0], p[1], p[2]}).kind, DSW_CELL_NONE);
      continue;
    }
    ASSERT_EQ(dsw_environment_find_nearest(place.get(), p, volume, radius, &point), DSW_STATUS_OK);
    point.volumes_visited = points[i].volumes_visited;  // depends on earlier calls
    EXPECT_EQ(std::memcmp(&point, &points[i], sizeof point), 0) << i;
  }
}

/// Wires that rest on a sliver: rounding moves the normal of a thin triangle by more than their height.
TEST(NearestSegmentSliverTest, OverAThinTriangle) {
  Rng rng(91);
  int asked = 0;
  for (int i = 0; i < at_least(4000); ++i) {
    const double height = std::ldexp(1.0, -static_cast<int>(rng.between(10, 20)));
    const auto any = [&] { return Vec{rng.range(-1, 1), rng.range(-1, 1), rng.range(-1, 1)}; };
    const auto sum = [](const Vec& a, double s, const Vec& u) {
      return Vec{a[0] + s * u[0], a[1] + s * u[1], a[2] + s * u[2]};
    };
    const auto product = [](const Vec& u, const Vec& v) {
      Vec n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      const double length = std::hypot(n[0], n[1], n[2]);
      for (double& x : n) x /= length;
      return n;
    };
    // A long side, a corner beside it, and one far above: a tetrahedron that holds all points just over the sliver.
    const Vec a = any(), b = any(), along = sum(b, -1, a), beside = product(along, any()), up = product(along, beside);
    const Vec c = sum(sum(a, rng.range(0.3, 0.7), along), height, beside);
    const Vec top = sum(sum(a, 0.5, along), 1, up);
    const auto over = [&] {
      const double s = rng.range(0.2, 0.6), t = rng.range(0.2, 0.7 - s / 2);
      const double rise = 0x1p-53 / height * rng.range(0.5, 8);
      return sum(sum(sum(a, s, sum(b, -1, a)), t, sum(c, -1, a)), rise, up);
    };
    const Vec p = over(), q = over();
    const std::vector<double> points = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], top[0], top[1], top[2]};
    const EnvironmentPtr environment =
        create_from(uniform_desc(3, DSW_CELL_TYPE_TETRA, 4, points, std::vector<int32_t>{0, 1, 2, 3}), nullptr);
    if (environment == nullptr) continue;
    dsw_segment_nearest near;
    dsw_location location;
    ASSERT_EQ(dsw_environment_find_nearest_to_segments(environment.get(), 1, nullptr, p.data(), q.data(), 0, kNoLimit,
                                                       &near, nullptr, &location),
              DSW_STATUS_OK);
    if (location != DSW_LOCATION_PASSABLE || near.nearest.distance == 0) continue;  // rounding has put it beside
    ++asked;
    const Q3 corners[4] = {exact(a), exact(b), exact(c), exact(top)};
    Q best = to_triangle(exact(p), exact(q), corners[0], corners[1], corners[2]);
    for (int k = 0; k < 3; ++k) {
      best = std::min(best, to_triangle(exact(p), exact(q), corners[k], corners[(k + 1) % 3], corners[3]));
    }
    double extent = 0;
    for (size_t k = 0; k < points.size(); ++k) extent = std::max(extent, std::fabs(points[k] - p[k % 3]));
    const double bound = 0x1p-49 * extent;
    ASSERT_TRUE(is_root(near.nearest.distance, best, bound))
        << i << ": off by " << (near.nearest.distance - std::sqrt(best.get_d())) / bound << " bounds";
  }
  EXPECT_GT(asked, 1000);
}

/// Whether a point of the plane lies on a side.
bool lies_on(const double* p, const Q3& a, const Q3& b) {
  const Q x(p[0]), y(p[1]);
  if ((b[0] - a[0]) * (y - a[1]) != (b[1] - a[1]) * (x - a[0])) return false;
  return (x - a[0]) * (x - b[0]) <= 0 && (y - a[1]) * (y - b[1]) <= 0;
}

/// Impassable sides and marked vertices of a grid of the plane.
struct PlaneObstacle {
  dsw_cell cell;
  Q3 a, b;
  bool is_seen = false;  // a side of a passable square
};
std::vector<PlaneObstacle> mark_plane(dsw_environment* environment, uint32_t sides_of_each, Rng& rng) {
  const double* points = nullptr;
  size_t count = 0;
  EXPECT_EQ(dsw_environment_get_points(environment, &points, &count), DSW_STATUS_OK);
  dsw_environment_info info = {};
  info.struct_size = sizeof info;
  EXPECT_EQ(dsw_environment_get_info(environment, &info), DSW_STATUS_OK);
  const auto at = [&](dsw_vertex_id v) { return Q3{Q(points[2 * v.index]), Q(points[2 * v.index + 1]), 0}; };
  std::vector<dsw_face_id> sides;
  for (uint32_t i = 0; i < info.volume_index_count; ++i) {
    dsw_volume_id volume;
    EXPECT_EQ(dsw_environment_get_volume_id(environment, i, &volume), DSW_STATUS_OK);
    for (uint32_t local = 0; local < sides_of_each; ++local) {
      sides.push_back({volume.index, volume.generation, local});
      if (!rng.chance(0.05)) continue;
      EXPECT_EQ(dsw_environment_mark_faces(environment, &sides.back(), 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    }
    if (rng.chance(0.1)) {
      EXPECT_EQ(dsw_environment_mark_volumes(environment, &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr), DSW_STATUS_OK);
    }
  }
  std::vector<PlaneObstacle> obstacles;
  for (const dsw_face_id& side : sides) {
    int impassable = 0;
    EXPECT_EQ(dsw_environment_is_impassable(environment, cell_of(side), &impassable), DSW_STATUS_OK);
    const std::vector<dsw_vertex_id> ends = vertices_of(environment, cell_of(side));
    if (impassable == 0) continue;
    int is_closed = 0;
    const dsw_cell square = cell_of(dsw_volume_id{side.volume, side.generation});
    EXPECT_EQ(dsw_environment_is_impassable(environment, square, &is_closed), DSW_STATUS_OK);
    obstacles.push_back({cell_of(side), at(ends[0]), at(ends[1]), is_closed == 0});
  }
  for (uint32_t v = 0; v < count; ++v) {
    dsw_vertex_id id;
    EXPECT_EQ(dsw_environment_get_vertex_id(environment, v, &id), DSW_STATUS_OK);
    if (!rng.chance(0.1)) continue;
    EXPECT_EQ(dsw_environment_mark_vertices(environment, &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    obstacles.push_back({cell_of(id), at(id), at(id)});
  }
  return obstacles;
}

TEST(NearestSegmentPlaneTest, IsTheNearestOfAll) {
  int passing = 0, free = 0;
  for (const bool cut : {false, true}) {
    constexpr uint32_t kSquares = 9;
    const EnvironmentPtr environment = make_squares(kSquares, cut);
    Rng rng(81);
    const std::vector<PlaneObstacle> obstacles = mark_plane(environment.get(), cut ? 3 : 4, rng);
    for (int i = 0; i < at_least(600); ++i) {
      double from[2], to[2];
      for (double& x : from) x = rng.chance(0.1) ? rng.between(0, kSquares) : rng.range(0, kSquares);
      const double length = rng.chance(0.5) ? 0.2 : rng.chance(0.1) ? 0 : 4;
      for (int k = 0; k < 2; ++k) to[k] = from[k] + (rng.chance(0.2) ? 0 : rng.range(-length, length));
      SCOPED_TRACE("from " + number(from[0]) + " " + number(from[1]) + " to " + number(to[0]) + " " + number(to[1]));
      dsw_segment_nearest near;
      dsw_location location;
      ASSERT_EQ(dsw_environment_find_nearest_to_segments(environment.get(), 1, nullptr, from, to, 0, kNoLimit, &near,
                                                         nullptr, &location),
                DSW_STATUS_OK);
      dsw_flight flight;
      ASSERT_EQ(dsw_environment_cast(environment.get(), {0, 0}, from, to, nullptr, &flight), DSW_STATUS_OK);
      if (location != DSW_LOCATION_PASSABLE) {
        const bool touches = std::any_of(obstacles.begin(), obstacles.end(), [&](const PlaneObstacle& each) {
          return each.is_seen && lies_on(from, each.a, each.b);
        });
        EXPECT_EQ(near.nearest.distance, touches ? 0 : kNoLimit);
        continue;
      }
      if (flight.outcome == DSW_OUTCOME_CONTACT) {
        ++passing;
        EXPECT_EQ(near.nearest.distance, 0);
        EXPECT_EQ(near.segment_parameter, flight.time);
        EXPECT_TRUE(same(near.nearest.cell, cell_of(flight.contact.wall)));
        continue;
      }
      ++free;
      const Q3 p = {Q(from[0]), Q(from[1]), 0}, q = {Q(to[0]), Q(to[1]), 0};
      Q best = -1, named = -1;
      for (const PlaneObstacle& each : obstacles) {
        const Q squared =
            square(each.b - each.a) == 0 ? to_segment(each.a, p, q) : between_segments(p, q, each.a, each.b);
        if (best < 0 || squared < best) best = squared;
        if (same(each.cell, near.nearest.cell)) named = squared;
      }
      const double bound = 0x1p-49 * 2 * kSquares;
      EXPECT_TRUE(is_root(near.nearest.distance, best, bound)) << near.nearest.distance << " for " << best.get_d();
      ASSERT_GE(named, 0) << near.nearest.cell;
      EXPECT_TRUE(is_root(near.nearest.distance, named, bound));
      EXPECT_EQ(near.segment_point[2], 0);
    }
  }
  EXPECT_GT(passing, 50);
  EXPECT_GT(free, 50);
}

}  // namespace
}  // namespace dsw::oracle::near_segment
