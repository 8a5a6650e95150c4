// Bodies that are created where they are not free: what they cross, and that they are free once they are freed, in
// rational numbers.
#include "body_support.h"
#include "ray_truth.h"

#include <set>

namespace dsw::oracle {
namespace {

using exact::Q3;
using exact::Span;

class PenetrationsTest : public SceneTest {};
DSW_FOR_ALL_SCENES(PenetrationsTest);

double distance_of(const Vec& a, const Vec& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
Vec between(const Vec& a, const Vec& b, double share) {
  Vec out;
  for (size_t k = 0; k < 3; ++k) out[k] = a[k] + share * (b[k] - a[k]);
  return out;
}

/// How far a point is from a triangle, in doubles.
double distance_to(const Vec& p, const Vec (&t)[3]) {
  const auto minus = [](const Vec& a, const Vec& b) { return Vec{a[0] - b[0], a[1] - b[1], a[2] - b[2]}; };
  const auto dot = [](const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto cross = [](const Vec& a, const Vec& b) {
    return Vec{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Vec n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  bool is_over = true;
  double least = HUGE_VAL;
  for (size_t k = 0; k < 3; ++k) {
    const Vec side = minus(t[(k + 1) % 3], t[k]), way = minus(p, t[k]);
    is_over = is_over && dot(cross(n, side), way) >= 0;
    const double share = std::clamp(dot(way, side) / dot(side, side), 0.0, 1.0);
    least = std::min(least, distance_of(p, between(t[k], t[(k + 1) % 3], share)));
  }
  return is_over ? std::fabs(dot(n, minus(p, t[0]))) / std::sqrt(dot(n, n)) : least;
}

/// What a body crosses, as pairs of vertex sets: its own part, and a part of the other one; none for walls.
struct Crossings {
  std::set<std::vector<uint32_t>> walls;
  std::set<std::pair<std::vector<uint32_t>, std::vector<uint32_t>>> bodies;
  double depth = 0;
  bool empty() const { return walls.empty() && bodies.empty(); }
};

/// A body at one level, its obstacles, and what is true of them.
class Truth {
 public:
  Truth(World& world, const BodyPlan* other) : world_(world), other_(other) {}

  Crossings of(const BodyState& body, bool faces, bool self) {
    Crossings found;
    for (const auto& e : body.edges) look_at_edge(body, e[0], e[1], found);
    if (faces && found.walls.empty()) {
      for (const auto& f : body.faces) look_at_face(body, {f[0], f[1], f[2]}, found);
    }
    if (other_ != nullptr) pair(body, faces, state_of(*other_), true, found);
    if (self) pair(body, faces, body, faces, found);
    return found;
  }

 private:
  bool is_inside(const Vec& p) {
    const int cell = world_.locate(world_.body(p.data()));
    return cell >= 0 && world_.cell_marked[static_cast<size_t>(cell)] == 0;
  }
  double depth_at(const Vec& p) const {
    double least = HUGE_VAL;
    for (const Triangle& t : world_.triangles) {
      if (!world_.impassable(t.face)) continue;
      const auto at = [&](int k) { return world_.mesh.points[static_cast<size_t>(t.v[k])]; };
      least = std::min(least, distance_to(p, {at(0), at(1), at(2)}));
    }
    return least;
  }

  void look_at_edge(const BodyState& body, uint32_t a, uint32_t b, Crossings& found) {
    const Vec &p = body.at[a], &q = body.at[b];
    if (world_.cast(world_.body(p.data()), world_.body(q.data())).outcome == Walk::kReached) return;
    found.walls.insert(sorted({a, b}));
    for (int i = 0; i <= 8; ++i) {
      const Vec at = between(p, q, i / 8.0);
      if (!is_inside(at)) found.depth = std::max(found.depth, depth_at(at));
    }
  }

  void look_at_face(const BodyState& body, const std::vector<uint32_t>& f, Crossings& found) {
    const std::vector<Q3> face = points(body, f);
    for (const Triangle& t : world_.triangles) {
      if (!world_.impassable(t.face)) continue;
      for (int k = 0; k < 3; ++k) {
        const auto at = [&](int i) { return exact::exact(world_.mesh.points[static_cast<size_t>(t.v[i % 3])]); };
        if (!Span(at(k), at(k + 1), face).first(false)) continue;
        found.walls.insert(sorted(f));
        return;
      }
    }
  }

  static std::vector<uint32_t> sorted(std::vector<uint32_t> v) {
    std::sort(v.begin(), v.end());
    return v;
  }
  static std::vector<Q3> points(const BodyState& body, const std::vector<uint32_t>& part) {
    std::vector<Q3> out;
    for (const uint32_t v : part) out.push_back(exact::exact(body.at[v]));
    return out;
  }

  /// Edges with faces, faces with edges; edges hardly ever touch edges.
  void pair(const BodyState& a, bool faces_of_a, const BodyState& b, bool faces_of_b, Crossings& found) {
    const auto compare = [&](const BodyState& of_edge, const std::array<uint32_t, 2>& e, const BodyState& of_face,
                             const std::array<uint32_t, 3>& f, bool edge_is_own) {
      if (&a == &b && (std::count(f.begin(), f.end(), e[0]) != 0 || std::count(f.begin(), f.end(), e[1]) != 0)) return;
      const std::vector<uint32_t> edge = sorted({e[0], e[1]}), face = sorted({f[0], f[1], f[2]});
      if (!Span(exact::exact(of_edge.at[e[0]]), exact::exact(of_edge.at[e[1]]), points(of_face, face)).first(false))
        return;
      found.bodies.insert(edge_is_own ? std::make_pair(edge, face) : std::make_pair(face, edge));
      const Vec t[3] = {of_face.at[f[0]], of_face.at[f[1]], of_face.at[f[2]]};
      found.depth = std::max(found.depth, std::min(distance_to(of_edge.at[e[0]], t), distance_to(of_edge.at[e[1]], t)));
    };
    for (const auto& e : a.edges) {
      for (const auto& f : b.faces) {
        if (faces_of_b) compare(a, e, b, f, true);
      }
    }
    if (&a == &b) return;
    for (const auto& e : b.edges) {
      for (const auto& f : a.faces) {
        if (faces_of_a) compare(b, e, a, f, false);
      }
    }
  }

  World& world_;
  const BodyPlan* other_;
};

/// A wire, a sheet or a closed surface round a place.
BodyPlan make_plan(const Vec& from, const Vec& to, Rng& rng) {
  BodyPlan plan;
  const double length = distance_of(from, to);
  const auto shaken = [&](const Vec& p, double share) {
    Vec out = p;
    for (size_t k = 0; k < 3; ++k) out[k] += share * length * rng.range(-1, 1);
    return out;
  };
  const uint32_t kind = rng.below(3u);
  if (kind == 0) {
    const uint32_t count = 3 + rng.below(6u);
    for (uint32_t i = 0; i < count; ++i) plan.at.push_back(shaken(between(from, to, i / (count - 1.0)), 0.3 / count));
    for (uint32_t i = 0; i + 1 < count; ++i) plan.edges.push_back({i, i + 1});
  } else if (kind == 1) {
    const Vec side = shaken({0, 0, 0}, 0.3);
    for (uint32_t r = 0; r < 3; ++r) {
      for (uint32_t i = 0; i < 5; ++i) {
        Vec p = between(from, to, i / 4.0);
        for (size_t k = 0; k < 3; ++k) p[k] += (r - 1.0) * side[k];
        plan.at.push_back(shaken(p, 0.02));
      }
    }
    for (uint32_t r = 0; r < 2; ++r) {
      for (uint32_t i = 0; i < 4; ++i) plan.faces.push_back({5 * r + i, 5 * r + i + 1, 5 * r + i + 6, 5 * r + i + 5});
    }
  } else {
    plan = tetrahedron(from, length);
    for (Vec& p : plan.at) p = shaken(p, 0.1);
  }
  return plan;
}

/// Counts of a test.
struct Counts {
  int begun = 0, freed = 0, shallow = 0, shallow_freed = 0, crossed_after = 0, untold = 0;
};

class Freeing {
 public:
  Freeing(Place& place, Rng& rng, Counts& counts) : world_(*place.world), place_(place), rng_(rng), counts_(counts) {}

  void run(const std::string& where) {
    Motions motions(world_, rng_);
    const Vec from = motions.start();
    const double reach = world_.size * rng_.range(0.05, 0.4);
    Vec to = from;
    for (size_t k = 0; k < 3; ++k) to[k] += reach * rng_.range(-1, 1);
    const BodyPlan plan = make_plan(from, to, rng_);
    for (const Vec& p : plan.at) {
      if (!finite(p)) return;
    }
    const dsw_level level = rng_.chance(0.6) ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT;
    const bool faces = level == DSW_LEVEL_FACES, meets = rng_.chance(0.5), self = meets && rng_.chance(0.5);
    const ScenePtr scene = make_scene(place_.get(), meets ? uint32_t{DSW_FEATURE_BODY_CONTACTS} : 0);
    const BodyPlan obstacle = tetrahedron(between(from, to, 0.5), 0.6 * reach);
    dsw_body_id other{}, body{};
    const bool has_other = meets && create_body(scene.get(), obstacle, DSW_LEVEL_FACES, 0, {}, &other) == DSW_STATUS_OK;
    Truth truth(world_, has_other ? &obstacle : nullptr);
    const uint32_t flags = DSW_BODY_START_PENETRATING | (self ? uint32_t{DSW_BODY_SELF_CONTACTS} : 0) |
                           (rng_.chance(0.2) ? uint32_t{DSW_BODY_RIGID} : 0);
    ASSERT_EQ(create_body(scene.get(), plan, level, flags, {}, &body), DSW_STATUS_OK) << dsw_last_error_message();
    BodyState before;
    ASSERT_EQ(read_body(scene.get(), body, before), "") << where;
    const Crossings crossings = truth.of(before, faces, self);
    uint32_t penetrates = 2;
    ASSERT_EQ(dsw_body_is_penetrating(scene.get(), body, &penetrates), DSW_STATUS_OK);
    EXPECT_EQ(penetrates, crossings.empty() ? 0u : 1u) << where;
    if (crossings.empty()) return;
    look_at_list(scene.get(), body, before, crossings, where);
    ++counts_.begun;
    double least = HUGE_VAL;
    for (const auto& e : before.edges) least = std::min(least, distance_of(before.at[e[0]], before.at[e[1]]));
    const bool is_shallow = crossings.depth <= least / 2;
    counts_.shallow += is_shallow ? 1 : 0;
    free_it(scene.get(), body, before, truth, faces, self, is_shallow, where);
  }

 private:
  void look_at_list(dsw_scene* scene, dsw_body_id body, const BodyState& state, const Crossings& truth,
                    const std::string& where) {
    const dsw_penetration* list = nullptr;
    size_t count = 0;
    ASSERT_EQ(dsw_body_find_penetrations(scene, body, &list, &count), DSW_STATUS_OK) << dsw_last_error_message();
    const auto name = [&](const dsw_contact_partner& part, const BodyState& of) {
      std::vector<uint32_t> corners;
      if (part.edge.generation != 0) corners = {of.edges[part.edge.index][0], of.edges[part.edge.index][1]};
      if (part.face.generation != 0) corners.assign(of.faces[part.face.index].begin(), of.faces[part.face.index].end());
      std::sort(corners.begin(), corners.end());
      return corners;
    };
    Crossings said;
    for (size_t i = 0; i < count; ++i) {
      EXPECT_TRUE(list[i].part.body.index == body.index && list[i].part.body.generation == body.generation) << where;
      if (list[i].other.body.generation == 0) {
        said.walls.insert(name(list[i].part, state));
        continue;
      }
      BodyState other = state;
      if (list[i].other.body.index != body.index) {
        ASSERT_EQ(read_body(scene, list[i].other.body, other), "");
      }
      said.bodies.insert({name(list[i].part, state), name(list[i].other, other)});
    }
    EXPECT_EQ(said.walls, truth.walls) << where;
    EXPECT_EQ(said.bodies, truth.bodies) << where;
  }

  void free_it(dsw_scene* scene, dsw_body_id body, const BodyState& before, Truth& truth, bool faces, bool self,
               bool is_shallow, const std::string& where) {
    uint32_t freed = 2, penetrates = 2;
    double distance = -1;
    ASSERT_EQ(dsw_body_depenetrate(scene, body, {}, 0, &freed, &distance), DSW_STATUS_OK) << dsw_last_error_message();
    ASSERT_EQ(dsw_body_is_penetrating(scene, body, &penetrates), DSW_STATUS_OK);
    EXPECT_EQ(penetrates, 1 - freed) << where;
    BodyState after;
    ASSERT_EQ(read_body(scene, body, after), "") << where;
    if (freed == 0) {
      EXPECT_EQ(bits_of(after), bits_of(before)) << where;
      const uint32_t* vertices = nullptr;
      size_t left = 0;
      ASSERT_EQ(dsw_scene_get_offending_edges(scene, &vertices, &left), DSW_STATUS_OK);
      EXPECT_GT(left, 0u) << where;
      counts_.untold += left == 0 ? 1 : 0;
      return;
    }
    ++counts_.freed;
    counts_.shallow_freed += is_shallow ? 1 : 0;
    double most = 0;
    for (size_t v = 0; v < before.at.size(); ++v) most = std::max(most, distance_of(before.at[v], after.at[v]));
    EXPECT_NEAR(most, distance, 1e-9 * (most + world_.size)) << where;
    const bool is_free = truth.of(after, faces, self).empty();
    EXPECT_TRUE(is_free) << where;
    counts_.crossed_after += is_free ? 0 : 1;
    EXPECT_EQ(dsw_body_move(scene, body, before.at[0].data(), before.at.size(), sizeof(Vec), nullptr, nullptr),
              DSW_STATUS_OK)
        << where << dsw_last_error_message();
  }

  World& world_;
  Place& place_;
  Rng& rng_;
  Counts& counts_;
};

/// Walls without thickness.
void mark_thin_walls(Place& place, Rng& rng) {
  World& world = *place.world;
  for (Face& f : world.faces) {
    if (!rng.chance(0.05)) continue;
    f.marked = true;
    const dsw_face_id id = face_id(world, static_cast<int>(&f - world.faces.data()));
    EXPECT_EQ(dsw_environment_mark_faces(place.get(), &id, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
}

TEST_P(PenetrationsTest, WhatIsFreedIsFreeAndOthersAreTold) {
  Counts counts;
  for (uint64_t seed = 51; seed < 51 + seeds_of(4, 2); ++seed) {
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    Rng rng(seed);
    if (place.world->outer_boundary_crosses()) continue;
    if (seed % 2 == 0) mark_thin_walls(place, rng);
    Freeing freeing(place, rng, counts);
    for (int i = 0; i < 30; ++i) {
      freeing.run(GetParam() + " seed " + std::to_string(seed) + " body " + std::to_string(i) + " ");
    }
  }
  RecordProperty("penetrating", counts.begun);
  RecordProperty("freed", counts.freed);
  RecordProperty("shallow", counts.shallow);
  RecordProperty("shallow_freed", counts.shallow_freed);
  RecordProperty("crossed_after", counts.crossed_after);
  RecordProperty("penetrations_untold", counts.untold);
  if (counts.shallow >= 10) {
    EXPECT_GE(10 * counts.shallow_freed, 7 * counts.shallow);
  }
}

/// How far two convex polyhedra have to go at least to be apart, along any direction: along a normal of a face, or of
/// two edges.
double depth_of(const BodyPlan& a, const BodyPlan& b) {
  std::vector<Vec> normals;
  const auto minus = [](const Vec& p, const Vec& q) { return Vec{p[0] - q[0], p[1] - q[1], p[2] - q[2]}; };
  const auto cross = [](const Vec& p, const Vec& q) {
    return Vec{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  };
  const auto edges_of = [&](const BodyPlan& plan) {
    std::vector<Vec> edges;
    for (const auto& f : plan.faces) {
      for (size_t k = 0; k < 3; ++k) edges.push_back(minus(plan.at[f[(k + 1) % 3]], plan.at[f[k]]));
      normals.push_back(cross(minus(plan.at[f[1]], plan.at[f[0]]), minus(plan.at[f[2]], plan.at[f[0]])));
    }
    return edges;
  };
  const std::vector<Vec> of_a = edges_of(a), of_b = edges_of(b);
  for (const Vec& p : of_a) {
    for (const Vec& q : of_b) normals.push_back(cross(p, q));
  }
  double least = HUGE_VAL;
  for (const Vec& n : normals) {
    const double length = std::hypot(n[0], n[1], n[2]);
    if (!(length > 1e-12)) continue;
    const auto reach = [&](const BodyPlan& plan, double sign) {
      double most = -HUGE_VAL;
      for (const Vec& p : plan.at) most = std::max(most, sign * (p[0] * n[0] + p[1] * n[1] + p[2] * n[2]) / length);
      return most;
    };
    least = std::min({least, reach(a, 1) + reach(b, -1), reach(a, -1) + reach(b, 1)});
  }
  return least;
}

TEST(ConvexPairs, LeaveEachOtherByAtMostTwiceTheDepth) {
  const Place place = place_of(hex_grid(axis(2, 8), axis(2, 8), axis(2, 8)));
  ASSERT_PLACE(place);
  Rng rng(7);
  int begun = 0;
  double largest = 0;
  for (int i = 0; i < at_least(200); ++i) {
    const ScenePtr scene = make_scene(place.get(), DSW_FEATURE_BODY_CONTACTS);
    const auto make = [&](double spread) {
      BodyPlan plan = tetrahedron({8, 8, 8}, rng.range(0.2, 2));
      const Vec by = {rng.range(-spread, spread), rng.range(-spread, spread), rng.range(-spread, spread)};
      for (Vec& p : plan.at) {
        for (size_t k = 0; k < 3; ++k) p[k] += by[k] + 0.1 * rng.range(-1, 1);
      }
      return plan;
    };
    const BodyPlan fixed = make(0), moving = make(0.6);
    dsw_body_id first{}, body{};
    ASSERT_EQ(create_body(scene.get(), fixed, DSW_LEVEL_FACES, 0, {}, &first), DSW_STATUS_OK);
    const uint32_t flags = DSW_BODY_START_PENETRATING | (i % 2 == 0 ? uint32_t{DSW_BODY_RIGID} : 0);
    ASSERT_EQ(create_body(scene.get(), moving, DSW_LEVEL_FACES, flags, {}, &body), DSW_STATUS_OK);
    uint32_t penetrates = 0, freed = 0;
    double distance = 0;
    ASSERT_EQ(dsw_body_is_penetrating(scene.get(), body, &penetrates), DSW_STATUS_OK);
    if (penetrates == 0) continue;
    ++begun;
    ASSERT_EQ(dsw_body_depenetrate(scene.get(), body, {}, 0, &freed, &distance), DSW_STATUS_OK);
    EXPECT_EQ(freed, 1u);
    const double depth = depth_of(fixed, moving);
    EXPECT_LE(distance, 2 * depth) << i;
    largest = std::max(largest, distance / depth);
  }
  EXPECT_GT(begun, at_least(200) / 3);
  RecordProperty("convex_largest_share", std::to_string(largest));
  RecordProperty("convex_pairs", begun);
}

}  // namespace
}  // namespace dsw::oracle
