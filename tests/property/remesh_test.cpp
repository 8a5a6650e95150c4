// Large random deformations of environments of every kind, with particles and bodies inside: what is repaired before is
// valid before and after, nothing gets lost, and more of the way can be made.
#include <cmath>
#include <set>

#include "capi/scene_handle.h"
#include "deform_support.h"
#include "host_memory.h"
#include "map/dart.h"
#include "map/integrity.h"
#include "sweep/body_probe.h"
#include "topology/repair.h"
#include "walk/cast.h"

namespace dsw::oracle {
namespace {

/// Vertices that are on no outer face.
std::vector<char> inner_vertices(const Environment<3>& env) {
  std::vector<char> inner(env.map.vertex_count, 1);
  for_each_cell(env.map, [&](dsw::Cell c) {
    const Shape shape = env.map.shape(c);
    for (uint32_t d = 0; d < shape.dart_count(); ++d) {
      if (env.map.opposite(env.map.half_facet(c, shape.dart_facet(d))).valid()) continue;
      inner[env.map.vertex(c, shape.dart_vertex(d))] = 0;
    }
  });
  return inner;
}

class RemeshTest : public SceneTest {
 protected:
  /// Makes a scene, the same for the same seed; with walls within it, if they are asked for.
  void begin(uint64_t seed, bool walls = false) {
    scene_.reset();
    place_ = make_place(GetParam(), seed);
    if (place_.environment == nullptr) return;
    Rng rng(seed ^ 0x5e);
    scene_ = make_scene(place_.get(), DSW_FEATURE_DEFORMING);
    if (walls) mark_faces(rng);
    Motions motions(*place_.world, rng);
    for (int i = 0; i < 25; ++i) {
      const Vec p = motions.start();
      dsw_particle_id id;
      dsw_particle_create(scene_.get(), p.data(), {0, 0}, &id);
    }
    const double reach = 0.2 * place_.world->size;
    for (int i = 0; i < 10; ++i) {
      BodyPlan plan;
      plan.at.push_back(motions.start());
      for (int k = 0; k < 3; ++k) {
        Vec p = plan.at.back();
        for (double& x : p) x += rng.range(-reach, reach);
        plan.at.push_back(p);
      }
      if (i % 2 == 0) {
        plan.edges = {{0, 1}, {1, 2}, {2, 3}};
      } else {
        plan.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}};
      }
      dsw_body_id body;
      create_body(scene_.get(), plan, static_cast<dsw_level>(1 + i % 4), DSW_BODY_SEQUENCES, {}, &body);
    }
    next_ = points_of(place_.get());
    const std::vector<char> inner = inner_vertices(env());
    const double far = rng.range(0.1, 0.5) * edge_length();
    for (size_t i = 0; i < next_.size(); ++i) {
      const double by = rng.range(-far, far);
      if (inner[i / 3] != 0) next_[i] += by;
    }
  }
  void mark_faces(Rng& rng) {
    for (size_t i = 0; i < place_.world->ids.size(); i += 3) {
      dsw_face_id face;
      ASSERT_EQ(dsw_environment_get_face_id(place_.get(), place_.world->ids[i], rng.below(4), &face), DSW_STATUS_OK);
      ASSERT_EQ(dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    }
  }
  void TearDown() override {
    scene_.reset();
    place_.environment.reset();  // before what it reads
  }

  Environment<3>& env() { return dsw::capi::space(*place_.get()); }
  double edge_length() {
    double sum = 0;
    size_t count = 0;
    for_each_cell(env().map, [&](dsw::Cell c) {
      for (uint32_t d = 0; d < env().map.shape(c).dart_count(); ++d, ++count) {
        const double *const a = env().point(dart_vertex(env().map, {c, d})), *const b = env().point(
                                                                                 dart_target(env().map, {c, d}));
        sum += std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
      }
    });
    return sum / static_cast<double>(count);
  }
  size_t count_invalid(const double* points) {
    size_t count = 0;
    for_each_cell(env().map, [&](dsw::Cell c) { count += is_valid_with(env(), points, c) ? 0 : 1; });
    return count;
  }
  /// Links, locations, bodies.
  void check_all() {
    ASSERT_STREQ(check_integrity(env().map), nullptr);
    const Scene<3>& s = dsw::capi::space(*scene_);
    for (const ParticleState<3>& p : s.particles) {
      ASSERT_TRUE(!p.cell.valid() || (contains(env(), p.cell, p.position) && !is_closed(env(), p.cell)));
    }
    BodyProbe<3> probe(env(), Obstacle::kCells);
    Array<uint32_t> blocked{Allocator<uint32_t>(s.memory)};
    for (const BodyRecord<3>& record : s.bodies) {
      for (const BodyVertex<3>& v : record.body.vertices) {
        ASSERT_TRUE(!v.cell.valid() || contains(env(), v.cell, v.position));
      }
      probe.find_blocked(record.body, record.body.level, blocked);
    }
    ASSERT_TRUE(blocked.empty());
  }
  dsw_change repair() {
    dsw_remesh_desc desc = defaults(dsw_remesh_desc_init);
    desc.next = next_.data();
    desc.point_count = next_.size() / 3;
    dsw_change report = empty_change();
    EXPECT_EQ(dsw_environment_remesh(place_.get(), &desc, &report), DSW_STATUS_OK) << dsw_last_error_message();
    return report;
  }
  dsw_deform_report deform(dsw_invalid_response invalid, dsw_deform_method method) {
    dsw_deform_options options = defaults(dsw_deform_options_init);
    options.invalid = invalid;
    options.method = method;
    dsw_deform_report report{};
    EXPECT_EQ(dsw_environment_deform(dsw_scene_get_environment(scene_.get()), next_.data(), next_.size() / 3, &options,
                                     &report),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    return report;
  }

  Place place_;
  ScenePtr scene_;
  std::vector<double> next_;  // lent
};
DSW_FOR_ALL_SCENES(RemeshTest);

TEST_P(RemeshTest, WhatIsRepairedIsValidBeforeAndAfter) {
  for (uint64_t seed = 1; seed <= seeds_of(3); ++seed) {
    begin(seed);
    if (place_.environment == nullptr) continue;
    const size_t invalid = count_invalid(next_.data());
    const dsw_change report = repair();
    ASSERT_EQ(report.volumes_invalid, invalid);
    ASSERT_LE(report.volumes_added, report.volumes_removed);
    ASSERT_EQ(count_invalid(env().points), 0u);
    ASSERT_EQ(count_invalid(next_.data()), report.unrepaired_count);
    const dsw_volume_id* left = change_of(place_.get()).unrepaired;
    const size_t count = change_of(place_.get()).unrepaired_count;
    ASSERT_EQ(count, report.unrepaired_count);
    for (size_t i = 0; i < count; ++i) ASSERT_TRUE(env().map.is_alive(left[i].index, left[i].generation));
    check_all();
    ASSERT_EQ(dsw_environment_check(place_.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  }
}

TEST_P(RemeshTest, DeformationsGoFartherWithIt) {
  size_t held[2] = {}, walls[2] = {};
  for (const dsw_deform_method method : {DSW_DEFORM_SWEPT, DSW_DEFORM_END_STATE}) {
    for (uint64_t seed = 1; seed <= seeds_of(2); ++seed) {
      for (const dsw_invalid_response invalid : {DSW_INVALID_HOLD, DSW_INVALID_REMESH}) {
        begin(seed, seed % 2 == 0);
        if (place_.environment == nullptr) continue;
        const dsw_deform_report report = deform(invalid, method);
        if (seed % 2 != 0)
          held[invalid == DSW_INVALID_REMESH ? 1 : 0] += report.held_count + (report.fraction < 1 ? 1 : 0);
        ASSERT_TRUE(invalid == DSW_INVALID_REMESH || report.remeshed_count == 0);
        check_all();
        const dsw_wall_contact* contacts = nullptr;
        size_t count = 0;
        dsw_environment_get_wall_contacts(dsw_scene_get_environment(scene_.get()), &contacts, &count);
        for (size_t i = 0; i < count; ++i) {
          const dsw_contact& c = contacts[i].contact;
          ASSERT_TRUE(c.wall.generation == 0 || env().map.is_alive(c.wall.volume, c.wall.generation));
          ASSERT_TRUE(env().map.is_alive(c.front.index, c.front.generation));
          ASSERT_TRUE(c.behind.generation == 0 || env().map.is_alive(c.behind.index, c.behind.generation));
          ASSERT_TRUE(c.obstacle.kind == DSW_CELL_VERTEX ||
                      env().map.is_alive(c.obstacle.index, c.obstacle.generation));
          ++walls[invalid == DSW_INVALID_REMESH ? 1 : 0];
        }
      }
    }
  }
  RecordProperty("contacts of walls after a repair", static_cast<int>(walls[1]));
  RecordProperty("held without", static_cast<int>(held[0]));
  RecordProperty("held with", static_cast<int>(held[1]));
  EXPECT_LE(held[1], held[0]);
  if (GetParam().rfind("tet", 0) == 0) {
    EXPECT_GT(walls[0] + walls[1], 0u);
  }
}

class RemeshMemoryTest : public MemoryTest {
 protected:
  void SetUp() override {
    MemoryTest::SetUp();
    scene_.reset();
    scene_ = make_scene(place_.get(), DSW_FEATURE_DEFORMING);
  }
};

TEST_F(RemeshMemoryTest, DeformingWithIt) {
  const double at[3] = {1.25, 1.5, 1.5};
  dsw_particle_id particle;
  ASSERT_EQ(dsw_particle_create(scene(), at, {0, 0}, &particle), DSW_STATUS_OK);
  const dsw_body_id body = make(tetrahedron({0.6, 1.5, 1.25}, 1.1), DSW_LEVEL_EDGES, DSW_BODY_SEQUENCES);
  // Once it has moved it knows the facets that its edges pass.
  const double targets[12] = {0.7, 1.5, 1.25, 1.8, 1.5, 1.25, 0.7, 2.6, 1.25, 0.7, 1.5, 2.35};
  ASSERT_EQ(dsw_body_move(scene(), body, targets, 4, 0, nullptr, nullptr), DSW_STATUS_OK);
  const Corridors<3>& sequences = dsw::capi::space(*scene()).bodies[body.index].body.corridors;
  const auto passes = [&](size_t e) { return sequences[e].known() && !sequences[e].facets.empty(); };
  ASSERT_TRUE(passes(0) || passes(1) || passes(2) || passes(3) || passes(4) || passes(5));
  dsw_deform_options options = defaults(dsw_deform_options_init);
  options.invalid = DSW_INVALID_REMESH;
  std::vector<double> next = points_of(place_.get());
  next[3 * size_t{point(2, 2, 1)}] += 1.1;  // beyond the next point of the grid
  const std::vector<double> asked = next, before = points_of(place_.get());
  const std::string bits = bits_of(read(body));
  const auto saved = [&] {
    std::string block(1 << 20, '\0');
    size_t size = 0;
    EXPECT_EQ(dsw_environment_save(place_.get(), &block[0], block.size(), &size), DSW_STATUS_OK);
    block.resize(size);
    std::string of_scene(1 << 20, '\0');
    EXPECT_EQ(dsw_scene_save(scene(), &of_scene[0], of_scene.size(), &size), DSW_STATUS_OK);
    return block + of_scene.substr(0, size);
  };
  // Tables for changes are made once, whatever becomes of the first.
  dsw_remesh_desc nothing = defaults(dsw_remesh_desc_init);
  ASSERT_EQ(dsw_environment_remesh(place_.get(), &nothing, nullptr), DSW_STATUS_OK);
  const std::string block = saved();
  dsw_deform_report report{};
  const size_t refusals = until_it_succeeds(
      [&] {
        return dsw_environment_deform(dsw_scene_get_environment(scene()), next.data(), next.size() / 3, &options,
                                      &report);
      },
      [&] {
        double now[3];
        return dsw_particle_get_position(scene(), particle, now, nullptr) == DSW_STATUS_OK &&
               std::equal(now, now + 3, at) && next == asked && points_of(place_.get()) == before &&
               bits_of(read(body)) == bits && saved() == block;
      });
  EXPECT_GE(refusals, 50u);
  EXPECT_GT(report.remeshed_count, 0u);
  EXPECT_EQ(report.outcome, DSW_DEFORM_DONE);
  scene_.reset();
  place_.environment.reset();  // before the array that it reads
}

}  // namespace
}  // namespace dsw::oracle
