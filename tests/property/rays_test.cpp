// Segments among walls and bodies, the line of sight between points of surfaces, and what is nearest in a scene, against
// rational numbers.
#include "obstacles.h"
#include "ray_truth.h"
#include "support.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>

namespace dsw::oracle::rays {
namespace {

using exact::Q3;
using exact::Span;

class RaysTest : public SceneTest {};
DSW_FOR_ALL_SCENES(RaysTest);

std::vector<Q3> corners_of(const World& world, const Triangle& t) {
  std::vector<Q3> corners;
  for (const int v : t.v) corners.push_back(exact::exact(world.mesh.points[static_cast<size_t>(v)]));
  return corners;
}

/// Where the way between two points is first not free; none: they see each other.
std::optional<mpq_class> first_block(const World& world, const Vec& from, const Vec& to) {
  const Q3 p = exact::exact(from), q = exact::exact(to);
  std::optional<mpq_class> first;
  for (const Triangle& t : world.triangles) {
    if (!world.impassable(t.face)) continue;
    const auto met = Span(p, q, corners_of(world, t)).first(true);
    if (met && (!first || *met < *first)) first = met;
  }
  if (first && *first == 0) return first;
  const Q3 within = exact::at(p, q, first ? *first / 2 : mpq_class(1, 2));
  if (!exact::in_passable_cell(world, within)) return mpq_class(0);
  return first;
}

/// Points of surfaces above all: vertices, and the exact middle of edges and triangles where they are doubles.
Vec surface_point(const World& world, Motions& motions, Rng& rng) {
  if (rng.chance(0.2)) return motions.site();
  const Triangle& t = world.triangles[rng.below(world.triangles.size())];
  Vec sum{};
  const int count = rng.chance(0.6) ? 1 : 2;
  for (int k = 0; k < count; ++k) {
    for (size_t i = 0; i < 3; ++i) sum[i] += world.mesh.points[static_cast<size_t>(t.v[k])][i] / count;
  }
  return sum;
}

TEST_P(RaysTest, SightIsExact) {
  int seen = 0, hidden = 0, begun = 0, wrong = 0;
  for (uint64_t seed = 1; seed < 1 + seeds_of(3, 1); ++seed) {
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    Rng rng(seed);
    const Obstacles obstacles(place, rng);
    const World& world = *place.world;
    if (world.outer_boundary_crosses()) continue;
    Motions motions(world, rng);
    dsw_cast_options options = defaults(dsw_cast_options_init);
    options.flags = DSW_CAST_OPEN_ENDS;
    for (int i = 0; i < at_least(40); ++i) {
      const Vec from = surface_point(world, motions, rng), to = surface_point(world, motions, rng);
      dsw_flight flight;
      ASSERT_EQ(dsw_environment_cast(place.get(), {0, 0}, from.data(), to.data(), &options, &flight), DSW_STATUS_OK);
      const bool begins = exact::in_passable_cell(world, exact::exact(from));
      const bool is_begun = flight.outcome == DSW_OUTCOME_REACHED || flight.outcome == DSW_OUTCOME_CONTACT;
      ASSERT_EQ(is_begun, begins) << GetParam() << " seed " << seed << " pair " << i;
      if (!begins) continue;
      ++begun;
      const auto block = from == to ? std::nullopt : first_block(world, from, to);
      wrong += (flight.outcome == DSW_OUTCOME_REACHED) == !block ? 0 : 1;
      EXPECT_EQ(flight.outcome == DSW_OUTCOME_REACHED, !block) << GetParam() << " seed " << seed << " pair " << i;
      ++(block ? hidden : seen);
      EXPECT_EQ(flight.volume.generation, 0u);
      if (!block) {
        EXPECT_EQ(flight.time, 1);
        continue;
      }
      if (flight.outcome != DSW_OUTCOME_CONTACT) continue;
      EXPECT_TRUE(exact::is_rounded_down(flight.time, *block)) << flight.time << " " << block->get_d();
      EXPECT_EQ(flight.contact.obstacle.kind, DSW_CELL_FACE);
      EXPECT_NEAR(std::hypot(flight.contact.normal[0], flight.contact.normal[1], flight.contact.normal[2]), 1, 1e-14);
    }
  }
  RecordProperty("pairs", begun);
  RecordProperty("wrong", wrong);
  if (begun > 100) {
    EXPECT_GT(hidden, 0);
    EXPECT_GT(seen, 0);
  }
}

/// Bodies of one to three vertices, with what they are made of.
struct Thing {
  dsw_body_id id;
  dsw_level level;
  std::vector<Vec> at;
  std::vector<Q3> exact;
};

struct Crowd {
  Place place;
  ScenePtr scene;
  std::vector<Thing> things;

  Crowd(const std::string& name, uint64_t seed, Rng& rng) : place(make_place(name, seed)) {
    if (place.world == nullptr) return;
    scene = make_scene(place.get(), rng.chance(0.3) ? 0 : uint32_t{DSW_FEATURE_BODY_CONTACTS});
    Motions motions(*place.world, rng);
    for (int i = 0; i < 60 && things.size() < 12; ++i) add(motions, rng);
  }

  void add(Motions& motions, Rng& rng) {
    static const uint32_t edges[4] = {0, 1, 1, 2}, corners[3] = {0, 1, 2}, offsets[2] = {0, 3};
    Thing thing;
    const size_t count = 1 + rng.below(3u);
    const Vec first = motions.site();
    for (size_t k = 0; k < count; ++k) {
      Vec next = motions.site();
      for (size_t j = 0; j < 3; ++j) next[j] = k == 0 ? first[j] : first[j] + 0.25 * (next[j] - first[j]);
      thing.at.push_back(next);
    }
    thing.level = static_cast<dsw_level>(DSW_LEVEL_POINTS + rng.below(4u));
    dsw_body_desc desc = defaults(dsw_body_desc_init);
    desc.level = thing.level;
    desc.positions = thing.at[0].data();
    desc.vertex_count = count;
    if (count == 2) {
      desc.edges = edges;
      desc.edge_count = 1;
    } else if (count == 3) {
      desc.face_offsets = offsets;
      desc.face_corners = corners;
      desc.face_count = 1;
      desc.face_corner_count = 3;
    }
    if (dsw_body_create(scene.get(), &desc, &thing.id) != DSW_STATUS_OK) return;
    for (const Vec& v : thing.at) thing.exact.push_back(exact::exact(v));
    const auto& x = thing.exact;
    if (count == 3 && exact::zero(exact::cross(exact::minus(x[1], x[0]), exact::minus(x[2], x[0])))) {
      EXPECT_EQ(dsw_body_destroy(scene.get(), thing.id), DSW_STATUS_OK);  // the truth has no triangles without area
      return;
    }
    things.push_back(thing);
  }
};

/// Calls visit(kind, number, points) for the parts that a level covers, as a report counts them: no part of another one.
template <class Visit>
void for_each_part(const Thing& thing, Visit visit) {
  const auto& x = thing.exact;
  const bool edges = thing.level >= DSW_LEVEL_EDGES, face = thing.level == DSW_LEVEL_FACES;
  if (x.size() == 3 && face) return visit(2, 0, x);
  if (x.size() == 3 && edges) {
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<size_t>(k), b = static_cast<size_t>((k + 1) % 3);
      visit(1, k, std::vector<Q3>{x[a], x[b]});
    }
  } else if (x.size() == 2 && edges) {
    visit(1, 0, x);
  } else {
    for (size_t k = 0; k < x.size(); ++k) visit(0, static_cast<int>(k), std::vector<Q3>{x[k]});
  }
}

int kind_of(const dsw_contact_partner& p) { return p.face.generation != 0 ? 2 : p.edge.generation != 0 ? 1 : 0; }

/// A point of a body, or a site.
Vec aim(const Crowd& crowd, Motions& motions, Rng& rng) {
  if (crowd.things.empty() || rng.chance(0.3)) return motions.site();
  const Thing& thing = crowd.things[rng.below(crowd.things.size())];
  return thing.at[rng.below(thing.at.size())];
}

TEST_P(RaysTest, CastsMissNothing) {
  int met = 0, casts = 0, missed = 0, phantom = 0;
  for (uint64_t seed = 11; seed < 11 + seeds_of(4, 1); ++seed) {
    Rng rng(seed);
    Crowd crowd(GetParam(), seed, rng);
    ASSERT_PLACE(crowd.place);
    Motions motions(*crowd.place.world, rng);
    std::vector<double> from, to;
    constexpr size_t kCount = 60;
    for (size_t i = 0; i < kCount; ++i) {
      const Vec a = aim(crowd, motions, rng), b = aim(crowd, motions, rng);
      from.insert(from.end(), a.begin(), a.end());
      for (size_t k = 0; k < 3; ++k) to.push_back(rng.chance(0.5) ? a[k] + 2 * (b[k] - a[k]) : b[k]);
    }
    for (const uint32_t flags : {0u, uint32_t{DSW_CAST_OPEN_ENDS}}) {
      dsw_cast_options options = defaults(dsw_cast_options_init);
      options.flags = flags;
      std::vector<dsw_flight> walls(kCount), flights(kCount);
      std::vector<dsw_contact_partner> partners(kCount);
      ASSERT_EQ(dsw_environment_cast_segments(crowd.place.get(), kCount, nullptr, from.data(), to.data(), 0, &options,
                                              walls.data()),
                DSW_STATUS_OK);
      ASSERT_EQ(dsw_scene_cast(crowd.scene.get(), kCount, nullptr, from.data(), to.data(), 0, &options, flights.data(),
                               partners.data()),
                DSW_STATUS_OK);
      for (size_t i = 0; i < kCount; ++i) {
        const bool begun = walls[i].outcome == DSW_OUTCOME_REACHED || walls[i].outcome == DSW_OUTCOME_CONTACT;
        const Q3 p = exact::exact({from[3 * i], from[3 * i + 1], from[3 * i + 2]}),
                 q = exact::exact({to[3 * i], to[3 * i + 1], to[3 * i + 2]});
        std::optional<mpq_class> first;
        for (const Thing& thing : crowd.things) {
          for_each_part(thing, [&](int, int, const std::vector<Q3>& part) {
            const auto time = Span(p, q, part).first(flags != 0);
            if (begun && time && !(flags != 0 && p == q) && (!first || *time < *first)) first = time;
          });
        }
        const bool at_body = partners[i].body.generation != 0;
        const std::string where = GetParam() + " seed " + std::to_string(seed) + " segment " + std::to_string(i);
        ++casts;
        if (!at_body) {
          // Rounded, a body that comes before the wall may be as late.
          const bool is_wall = walls[i].outcome == DSW_OUTCOME_CONTACT;
          const bool is_right = !first || (is_wall && mpq_class(walls[i].time) <= *first);
          missed += is_right ? 0 : 1;
          EXPECT_TRUE(is_right) << where;
          EXPECT_EQ(bits_of(flights[i]), bits_of(walls[i]));
          continue;
        }
        phantom += first && exact::is_rounded_down(flights[i].time, *first) ? 0 : 1;
        ++met;
        ASSERT_TRUE(first) << where;
        EXPECT_TRUE(exact::is_rounded_down(flights[i].time, *first)) << where;
        EXPECT_TRUE(walls[i].outcome != DSW_OUTCOME_CONTACT || flights[i].time < walls[i].time);
        EXPECT_EQ(flights[i].outcome, DSW_OUTCOME_CONTACT);
        EXPECT_EQ(flights[i].contact.obstacle.kind, DSW_CELL_NONE);
        const double* const n = flights[i].contact.normal;
        EXPECT_TRUE(p == q || std::fabs(std::hypot(n[0], n[1], n[2]) - 1) < 1e-14) << where;
        // The lowest part with that time is named.
        auto lowest = std::make_tuple(UINT32_MAX, 3, INT32_MAX);
        for (const Thing& thing : crowd.things) {
          for_each_part(thing, [&](int kind, int number, const std::vector<Q3>& part) {
            const auto time = Span(p, q, part).first(flags != 0);
            if (time && exact::is_rounded_down(flights[i].time, *time))
              lowest = std::min(lowest, std::make_tuple(thing.id.index, kind, number));
          });
        }
        const dsw_contact_partner& named = partners[i];
        const uint32_t number = named.face.generation != 0   ? named.face.index
                                : named.edge.generation != 0 ? named.edge.index
                                                             : named.vertex.index;
        EXPECT_EQ(std::make_tuple(named.body.index, kind_of(named), static_cast<int>(number)), lowest) << where;
      }
    }
  }
  RecordProperty("casts", casts);
  RecordProperty("missed", missed);
  RecordProperty("phantom", phantom);
  EXPECT_GT(met, 0);
}

mpq_class squared_distance(const Q3& p, const std::vector<Q3>& s) {
  const auto square = [](const Q3& a) { return exact::dot(a, a); };
  const auto to_segment = [&](const Q3& a, const Q3& b) -> mpq_class {
    const Q3 u = exact::minus(b, a), v = exact::minus(p, a);
    const mpq_class length = square(u), t = exact::dot(u, v);
    if (t <= 0) return square(v);
    if (t >= length) return square(exact::minus(p, b));
    return square(v) - t * t / length;
  };
  if (s.size() == 1) return square(exact::minus(p, s[0]));
  if (s.size() == 2) return to_segment(s[0], s[1]);
  const Q3 n = exact::cross(exact::minus(s[1], s[0]), exact::minus(s[2], s[0]));
  bool inside = true;
  for (size_t k = 0; k < 3; ++k)
    inside = inside && exact::dot(exact::cross(n, exact::minus(s[(k + 1) % 3], s[k])), exact::minus(p, s[k])) >= 0;
  const mpq_class height = exact::dot(n, exact::minus(p, s[0]));
  if (inside && square(n) != 0) return height * height / square(n);
  return std::min({to_segment(s[0], s[1]), to_segment(s[1], s[2]), to_segment(s[2], s[0])});
}

TEST_P(RaysTest, NearestPlacesAreNearest) {
  int nearer = 0;
  for (uint64_t seed = 21; seed < 21 + seeds_of(3, 1); ++seed) {
    Rng rng(seed);
    Crowd crowd(GetParam(), seed, rng);
    ASSERT_PLACE(crowd.place);
    Motions motions(*crowd.place.world, rng);
    const double size = crowd.place.world->size;
    for (int i = 0; i < 40; ++i) {
      const Vec p = aim(crowd, motions, rng);
      const double radius = rng.chance(0.5) ? size * rng.unit() * 0.2 : std::numeric_limits<double>::infinity();
      dsw_nearest wall, found;
      dsw_contact_partner partner;
      dsw_location location, same;
      ASSERT_EQ(dsw_environment_find_nearest_to_points(crowd.place.get(), p.data(), 1, 0, nullptr, radius, &wall,
                                                       nullptr, &location),
                DSW_STATUS_OK);
      ASSERT_EQ(dsw_scene_find_nearest(crowd.scene.get(), p.data(), 1, 0, nullptr, radius, &found, &partner, nullptr,
                                       rng.chance(0.5) ? &same : nullptr),
                DSW_STATUS_OK);
      mpq_class least = -1;
      for (const Thing& thing : crowd.things) {
        for_each_part(thing, [&](int, int, const std::vector<Q3>& part) {
          const mpq_class square = squared_distance(exact::exact(p), part);
          if (least < 0 || square < least) least = square;
        });
      }
      const double body = least < 0 || location != DSW_LOCATION_PASSABLE ? std::numeric_limits<double>::infinity()
                                                                         : std::sqrt(least.get_d());
      const double room = 0x1p-46 * size, best = std::min(body <= radius + room ? body : wall.distance, wall.distance);
      if (partner.body.generation == 0) {
        EXPECT_TRUE(wall.distance <= body + room || body >= radius - room) << GetParam() << " seed " << seed;
        EXPECT_EQ(found.distance, wall.distance);
        continue;
      }
      ++nearer;
      EXPECT_NEAR(found.distance, best, room) << GetParam() << " seed " << seed;
      EXPECT_TRUE(found.distance < wall.distance);
      EXPECT_EQ(found.cell.kind, DSW_CELL_NONE);
      for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(found.point[k] + found.distance * found.normal[k], p[k], room);
    }
  }
  EXPECT_GT(nearer, 0);
}

TEST_P(RaysTest, SignedDistancesAreExactInSign) {
  int asked = 0, wrong = 0, outside = 0;
  double largest_error = 0;
  for (uint64_t seed = 31; seed < 31 + seeds_of(3, 1); ++seed) {
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    Rng rng(seed);
    World& world = *place.world;
    if (world.outer_boundary_crosses()) continue;
    Motions motions(world, rng);
    constexpr size_t kCount = 60;
    std::vector<double> points;
    for (size_t i = 0; i < kCount; ++i) {
      Vec p = surface_point(world, motions, rng);
      const double far = rng.chance(0.1) ? 40 : rng.chance(0.5) ? 1 : 0.01;
      for (size_t k = 0; k < 3; ++k)
        points.push_back(p[k] + (rng.chance(0.7) ? far * world.size * rng.range(-1, 1) : 0));
    }
    std::vector<double> distances(kCount), again(kCount);
    std::vector<dsw_nearest> nearest(kCount);
    ASSERT_EQ(
        dsw_environment_find_signed_distances(place.get(), points.data(), kCount, 0, distances.data(), nearest.data()),
        DSW_STATUS_OK);
    for (size_t i = 0; i < kCount; ++i) {
      const Vec p{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
      ASSERT_EQ(dsw_environment_find_signed_distances(place.get(), p.data(), 1, 0, &again[i], nullptr), DSW_STATUS_OK);
      mpq_class least = -1;
      for (const Triangle& t : world.triangles) {
        if (t.cell[1] >= 0) continue;
        const mpq_class square = squared_distance(exact::exact(p), corners_of(world, t));
        if (least < 0 || square < least) least = square;
      }
      const std::string where = GetParam() + " seed " + std::to_string(seed) + " point " + std::to_string(i);
      const int cell = world.locate(world.body(p.data()));
      const bool is_right = least == 0 ? distances[i] == 0 : (distances[i] < 0) == (cell >= 0 || cell == -2);
      ++asked;
      wrong += is_right ? 0 : 1;
      outside += distances[i] > 0 ? 1 : 0;
      EXPECT_TRUE(is_right) << where << " " << distances[i];
      const double error =
          std::fabs(std::fabs(distances[i]) - std::sqrt(least.get_d())) / std::max(world.size, std::fabs(distances[i]));
      largest_error = std::max(largest_error, error);
      EXPECT_LE(error, 1e-14) << where;
      EXPECT_EQ(nearest[i].distance, std::fabs(distances[i]));
      EXPECT_EQ(nearest[i].cell.kind, DSW_CELL_FACE);
    }
    EXPECT_EQ(distances, again) << GetParam() << " seed " << seed;
  }
  RecordProperty("signs", asked);
  RecordProperty("wrong_signs", wrong);
  EXPECT_TRUE(asked < 60 || outside > 0);
}

}  // namespace
}  // namespace dsw::oracle::rays
