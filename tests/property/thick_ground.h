// Places for thick bodies in every scene of the oracle, in space and in the plane, and the bodies.
#pragma once

#include "edit_ground.h"
#include "plane_arena.h"
#include "sweep_scenes.h"
#include "thick_scene.h"

namespace dsw::oracle {

/// An environment with marks, and where bodies are put and sent in it.
class ThickGround {
 public:
  virtual ~ThickGround() = default;
  virtual dsw_environment* environment() const = 0;
  virtual Places& places() = 0;
  /// Before points that the environment borrows are gone.
  virtual void destroy() = 0;
  double size = 0;     // of the environment
  double largest = 0;  // coordinate
  size_t dimension = 3;
  size_t volume_count = 0;

  /// About as wide as a volume.
  double cell() const {
    const auto count = static_cast<double>(volume_count);
    return size / (dimension == 3 ? std::cbrt(count) : std::sqrt(count));
  }

 protected:
  void take(const std::vector<Vec>& points) {
    for (const Vec& p : points) {
      for (const double x : p) largest = std::max(largest, std::fabs(x));
    }
  }
};

class SpaceThickGround : public ThickGround {
 public:
  SpaceThickGround(std::unique_ptr<Stage> stage, Rng& rng) : stage_(std::move(stage)), places_(*stage_, rng) {
    size = stage_->world.size;
    volume_count = stage_->world.ids.size();
    take(stage_->world.mesh.points);
  }
  dsw_environment* environment() const override { return stage_->environment.get(); }
  Places& places() override { return places_; }
  void destroy() override { stage_->environment.reset(); }

 private:
  std::unique_ptr<Stage> stage_;
  StagePlaces places_;
};

class PlaneThickGround : public ThickGround {
 public:
  PlaneThickGround(plane::World world, std::vector<int> marked, EnvironmentPtr environment, Rng& rng)
      : world_(std::move(world)),
        marked_(std::move(marked)),
        environment_(std::move(environment)),
        arena_(world_, marked_),
        places_(world_, arena_, marked_, rng) {
    dimension = 2;
    size = arena_.size();
    volume_count = world_.cells.size();
    for (const plane::Vec& p : world_.points) take({{p[0], p[1], 0}});
  }
  dsw_environment* environment() const override { return environment_.get(); }
  Places& places() override { return places_; }
  void destroy() override { environment_.reset(); }

 private:
  plane::World world_;
  std::vector<int> marked_;
  EnvironmentPtr environment_;
  PlaneArena arena_;
  PlanePlaces places_;
};

inline std::vector<std::string> sweep_scene_names() {
  std::vector<std::string> names;
  for (const SceneKind& kind : sweep_scenes()) names.emplace_back(kind.name);
  return names;
}
#define DSW_FOR_ALL_SWEEP_SCENES(name)                                                                         \
  INSTANTIATE_TEST_SUITE_P(All, name,                                                                          \
                           testing::ValuesIn(dsw::oracle::drawn_for(#name, dsw::oracle::sweep_scene_names())), \
                           [](const testing::TestParamInfo<std::string>& i) { return i.param; })

/// How much must be seen in a scene. Slivers are so thin that rounding leaves no room for a radius.
inline uint64_t least_of(const std::string& scene, int count) {
  return scene == "tet_slivers" ? 0 : static_cast<uint64_t>(count);
}

/// The seeds that a test goes through are 1 and those up to this one.
inline uint64_t last_thick_seed(int count) { return static_cast<uint64_t>(std::max(2, effort_of(count))); }

/// Null where creation may refuse the mesh.
inline std::unique_ptr<ThickGround> space_ground(const std::string& scene, Transform transform, Rng& rng) {
  for (const SceneKind& kind : sweep_scenes()) {
    if (scene != kind.name) continue;
    SweepReport report;
    std::unique_ptr<Stage> stage = make_stage({&kind, transform}, 0, rng, report);
    if (stage != nullptr && rng.chance(0.5)) stage->mark_vertices(rng, report);
    EXPECT_EQ(report.total.faults(), 0u);
    if (stage == nullptr) return nullptr;
    return std::make_unique<SpaceThickGround>(std::move(stage), rng);
  }
  return nullptr;
}

inline std::unique_ptr<ThickGround> plane_ground(const std::string& scene, size_t number, Rng& rng) {
  std::vector<plane::Turn> turns = plane::turns(scene);
  // A radius that is one of the least numbers can keep no share of itself.
  const auto is_denormal = [](const plane::Turn& turn) { return turn.transform == Transform::kDenormal; };
  turns.erase(std::remove_if(turns.begin(), turns.end(), is_denormal), turns.end());
  const plane::Turn& turn =
      turns[(7 * number + scene.size()) % turns.size()];  // few numbers meet all of them in some scene
  plane::World world = plane::make_world(turn, rng);
  EnvironmentPtr environment = plane::make_environment(turn, world, rng);
  if (environment == nullptr) return nullptr;
  std::vector<int> marked;
  EXPECT_EQ(plane::mark(world, environment.get(), {0.05 * rng.below(3u), 0.1 * rng.below(3u), 0.1 * rng.below(3u)}, rng,
                        marked),
            "");
  return std::make_unique<PlaneThickGround>(std::move(world), std::move(marked), std::move(environment), rng);
}

/// A vertex, two of them, a chain, a ring, a star, triangles round a vertex or the surface of a tetrahedron.
inline BodyPlan thick_shape(ThickGround& ground, Rng& rng, dsw_level level) {
  Places& places = ground.places();
  BodyPlan plan;
  const double share = std::pow(10, rng.range(-2.5, -0.3));
  const auto place = [&](size_t count) {
    plan.at.push_back(places.start());
    while (plan.at.size() < count) {
      const Vec& from = plan.at[rng.chance(0.5) ? plan.at.size() - 1 : 0];
      // In flat scenes only what lies between two points of them lies in them.
      plan.at.push_back(rng.chance(0.4) ? between(from, places.start(), share) : places.near(from, share));
    }
  };
  const bool has_faces = ground.dimension == 3 && (level == DSW_LEVEL_FACES || rng.chance(0.2));
  if (has_faces) {
    const uint32_t triangles = 1 + rng.below(4u);
    place(triangles == 4 ? 4 : triangles + 2);
    for (uint32_t i = 0; i < std::min(triangles, 3u); ++i) plan.faces.push_back({0, i + 1, i % 3 + 2});
    if (triangles == 4) plan.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}};
    return plan;
  }
  place(1 + rng.below(6u));
  const auto count = static_cast<uint32_t>(plan.at.size());
  const uint32_t kind = rng.below(6u);
  for (uint32_t v = 1; v < count && kind > 0; ++v) plan.edges.push_back({kind == 1 ? 0 : v - 1, v});
  if (kind == 2 && count > 2) plan.edges.push_back({count - 1, 0});
  return plan;
}

inline dsw_level any_level(Rng& rng, size_t dimension) {
  return std::array{DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT,
                    DSW_LEVEL_FACES}[rng.below(dimension == 3 ? 4u : 3u)];
}

/// Puts up to `count` thick bodies into a scene: each with a radius that its place allows, up to a few cells.
inline void ask(ThickScene& scene, ThickGround& ground, Rng& rng, size_t count, uint32_t flags = 0) {
  const size_t wanted = scene.bodies.size() + count;
  for (size_t tries = 0; tries < 12 * count && scene.bodies.size() < wanted; ++tries) {
    const dsw_level level = any_level(rng, ground.dimension);
    const BodyPlan plan = thick_shape(ground, rng, level);
    if (!std::all_of(plan.at.begin(), plan.at.end(), finite)) continue;
    // What saves time must not lose anything.
    constexpr uint32_t savers[] = {0, DSW_BODY_NO_SEQUENCES, DSW_BODY_SKIP_BY_ENVIRONMENT, DSW_BODY_SKIP_BY_CLEARANCE,
                                   DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_CLEARANCE};
    if (scene.create(plan, level, 0, flags | savers[rng.below(5u)]) != DSW_STATUS_OK) continue;
    const size_t i = scene.bodies.size() - 1;
    const double room = scene.room(i, 2 * ground.cell());
    const double share = rng.chance(0.3) ? std::pow(10, rng.range(-6, -1)) : rng.range(0.1, 0.99);
    const double radius = rng.chance(0.15) ? 0 : room * share;
    if (!(room > 0) || !(radius >= 0)) {
      scene.destroy(i);
      continue;
    }
    const dsw_status status = scene.set_radius(i, radius);
    EXPECT_EQ(status, DSW_STATUS_OK) << "radius " << number(radius) << " where there is room for " << number(room);
    if (status != DSW_STATUS_OK) scene.destroy(i);
  }
}

}  // namespace dsw::oracle
