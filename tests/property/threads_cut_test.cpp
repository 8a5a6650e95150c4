// Threads that a blade cuts: exactly the edges that cross it in rational numbers, and what is left is free.
#include "ray_truth.h"
#include "support.h"

#include <map>
#include <set>

namespace dsw::oracle::cuts {
namespace {

using exact::Q3;

class ThreadCutsTest : public SceneTest {};
DSW_FOR_ALL_SCENES(ThreadCutsTest);

mpq_class det(const Q3& a, const Q3& b, const Q3& c) { return exact::dot(a, exact::cross(b, c)); }
Q3 plus(const Q3& a, const Q3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

/// The sign of f at the infinitesimal shift (e, e^2, e^3); f is linear in the shift.
template <class F>
int shifted_sign(F f) {
  const mpq_class still = f(Q3{0, 0, 0});
  if (still != 0) return sgn(still);
  for (size_t k = 0; k < 3; ++k) {
    Q3 unit{0, 0, 0};
    unit[k] = 1;
    const mpq_class slope = f(unit);
    if (slope != 0) return sgn(slope);
  }
  return 0;
}

/// Whether a segment passes through a triangle that the shift moves.
bool passes(const Q3& a, const Q3& b, const Q3 (&t)[3]) {
  const auto side = [&](const Q3& v) {
    return shifted_sign([&](const Q3& by) {
      return det(exact::minus(t[1], t[0]), exact::minus(t[2], t[0]), exact::minus(exact::minus(v, t[0]), by));
    });
  };
  const int at_a = side(a), at_b = side(b);
  if (at_a == 0 || at_b == 0 || at_a == at_b) return false;
  int turns[3];
  for (size_t k = 0; k < 3; ++k) {
    turns[k] = shifted_sign([&](const Q3& by) {
      return det(exact::minus(b, a), exact::minus(plus(t[k], by), a), exact::minus(plus(t[(k + 1) % 3], by), a));
    });
  }
  return turns[0] != 0 && turns[0] == turns[1] && turns[1] == turns[2];
}

struct Blade {
  uint32_t rows, columns;
  std::vector<Vec> points;

  bool crosses(const Vec& a, const Vec& b) const {
    const Q3 from = exact::exact(a), to = exact::exact(b);
    for (uint32_t r = 0; r + 1 < rows; ++r) {
      for (uint32_t c = 0; c + 1 < columns; ++c) {
        const auto at = [&](uint32_t i, uint32_t j) { return exact::exact(points[(r + i) * columns + c + j]); };
        if (passes(from, to, {at(0, 0), at(0, 1), at(1, 1)}) || passes(from, to, {at(0, 0), at(1, 1), at(1, 0)}))
          return true;
      }
    }
    return false;
  }
};

/// A coarse lattice, so that blades often touch vertices, and lie along edges.
double coarse(double x, double size) { return std::round(8 * x / size) * size / 8; }

struct Thread {
  dsw_body_id id{};
  std::vector<Vec> at;
  std::map<std::array<uint32_t, 2>, std::array<uint32_t, 2>> edges;  // id -> indices of its ends

  void read(dsw_scene* scene) {
    dsw_body_counts counts{};
    counts.struct_size = sizeof counts;
    ASSERT_EQ(dsw_body_get_counts(scene, id, &counts), DSW_STATUS_OK);
    at.assign(counts.vertex_slots, Vec{});
    size_t count = 0;
    if (!at.empty()) {
      ASSERT_EQ(dsw_body_get_positions(scene, id, at[0].data(), at.size(), 0, nullptr, &count), DSW_STATUS_OK);
    }
    std::vector<dsw_body_edge_id> ids(counts.edge_count);
    ASSERT_EQ(dsw_body_get_edge_ids(scene, id, ids.data(), ids.size(), &count), DSW_STATUS_OK);
    edges.clear();
    for (const dsw_body_edge_id edge : ids) {
      dsw_body_vertex_id ends[2];
      ASSERT_EQ(dsw_body_get_edge_ends(scene, id, edge, ends), DSW_STATUS_OK);
      edges[{edge.index, edge.generation}] = {ends[0].index, ends[1].index};
    }
  }
};

class Cutting {
 public:
  Cutting(Place& place, Rng& rng)
      : world_(*place.world),
        rng_(rng),
        scene_(make_scene(place.get(), rng.chance(0.5) ? uint32_t{DSW_FEATURE_BODY_CONTACTS} : 0)) {
    Motions motions(world_, rng_);
    for (int i = 0; i < 40 && threads_.size() < 6; ++i) add(motions);
  }

  size_t threads() const { return threads_.size(); }
  int cuts = 0, wrong = 0, not_free = 0, parts = 0;

  void cut_once(const std::string& where) {
    const int before = failures();
    const Blade blade = make_blade();
    for (Thread& thread : threads_) thread.read(scene_.get());
    const std::vector<Thread> were = threads_;
    std::set<std::array<uint32_t, 3>> crossed, said;
    for (const Thread& thread : were) {
      for (const auto& [id, ends_of] : thread.edges) {
        if (blade.crosses(thread.at[ends_of[0]], thread.at[ends_of[1]]))
          crossed.insert({thread.id.index, id[0], id[1]});
      }
    }
    dsw_cut_desc desc = defaults(dsw_cut_desc_init);
    desc.points = blade.points[0].data();
    desc.rows = blade.rows;
    desc.columns = blade.columns;
    size_t count = 0;
    ASSERT_EQ(dsw_scene_cut_bodies(scene_.get(), &desc, nullptr, 0, &count), DSW_STATUS_OK) << dsw_last_error_message();
    const dsw_body_cut* found = nullptr;
    size_t found_count = 0;
    ASSERT_EQ(dsw_scene_get_body_cuts(scene_.get(), &found, &found_count), DSW_STATUS_OK);
    ASSERT_EQ(count, found_count);
    for (Thread& thread : threads_) thread.read(scene_.get());
    for (size_t i = 0; i < count; ++i) {
      said.insert({found[i].body.index, found[i].edge.index, found[i].edge.generation});
      look_at(found[i], where);
    }
    EXPECT_EQ(said, crossed) << where;
    cuts += static_cast<int>(crossed.size());
    wrong += failures() != before ? 1 : 0;
    look_at_the_rest(were, crossed, blade, where);
  }

 private:
  static int failures() { return testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count(); }

  void add(Motions& motions) {
    const uint32_t count = 2 + rng_.below(6u);
    Thread thread;
    thread.at.push_back(motions.start());
    while (thread.at.size() < count) {
      Vec next = motions.start();
      const bool is_coarse = rng_.chance(0.4);
      for (size_t k = 0; k < 3; ++k) {
        const double near = thread.at.back()[k] + rng_.range(0.1, 1) * (next[k] - thread.at.back()[k]);
        next[k] = is_coarse ? coarse(near, world_.size) : near;
      }
      thread.at.push_back(next);
    }
    std::vector<uint32_t> edges;
    for (uint32_t i = 0; i + 1 < count; ++i) edges.insert(edges.end(), {i, i + 1});
    dsw_body_desc desc = defaults(dsw_body_desc_init);
    desc.positions = thread.at[0].data();
    desc.vertex_count = count;
    desc.edges = edges.data();
    desc.edge_count = count - 1;
    desc.level = rng_.chance(0.3) ? DSW_LEVEL_EDGES : DSW_LEVEL_EDGES_SWEPT;
    if (dsw_body_create(scene_.get(), &desc, &thread.id) == DSW_STATUS_OK) threads_.push_back(thread);
  }

  Blade make_blade() {
    Blade blade{2 + rng_.below(3u), 2 + rng_.below(3u), {}};
    const bool is_coarse = rng_.chance(0.6);
    const Thread& thread = threads_[rng_.below(threads_.size())];
    Vec middle = thread.at[rng_.below(thread.at.size())], u, v;
    const double reach = world_.size * (rng_.chance(0.5) ? 0.6 : 0.1);
    for (size_t k = 0; k < 3; ++k) {
      u[k] = rng_.range(-reach, reach);
      v[k] = rng_.range(-reach, reach);
    }
    for (uint32_t r = 0; r < blade.rows; ++r) {
      for (uint32_t c = 0; c < blade.columns; ++c) {
        Vec p;
        for (size_t k = 0; k < 3; ++k) {
          p[k] = middle[k] + (r - 0.5 * (blade.rows - 1)) * u[k] + (c - 0.5 * (blade.columns - 1)) * v[k] +
                 (rng_.chance(0.3) ? 0.2 * rng_.range(-reach, reach) : 0);
          if (is_coarse) p[k] = coarse(p[k], world_.size);
        }
        blade.points.push_back(p);
      }
    }
    return blade;
  }

  /// Both ends are free, on their own parts, which are what the report says.
  void look_at(const dsw_body_cut& cut, const std::string& where) {
    const auto thread =
        std::find_if(threads_.begin(), threads_.end(), [&](const Thread& t) { return t.id.index == cut.body.index; });
    ASSERT_NE(thread, threads_.end()) << where;
    EXPECT_EQ(thread->edges.count({cut.edge.index, cut.edge.generation}), 0u) << where;
    EXPECT_GE(cut.edge_parameter, 0);
    EXPECT_LE(cut.edge_parameter, 1);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(cut.vertices[k].generation != 0, cut.parts[k].generation != 0) << where;
      if (cut.parts[k].generation == 0) continue;
      ++parts;
      const auto part = thread->edges.find({cut.parts[k].index, cut.parts[k].generation});
      ASSERT_NE(part, thread->edges.end()) << where;
      const uint32_t end = cut.vertices[k].index;
      EXPECT_EQ(part->second[static_cast<size_t>(1 - k)], end) << where;
      int at_end = 0;
      for (const auto& [id, ends_of] : thread->edges) at_end += ends_of[0] == end || ends_of[1] == end ? 1 : 0;
      EXPECT_EQ(at_end, 1) << where;
    }
  }

  void look_at_the_rest(const std::vector<Thread>& were, const std::set<std::array<uint32_t, 3>>& crossed,
                        const Blade& blade, const std::string& where) {
    for (size_t i = 0; i < were.size(); ++i) {
      for (const auto& [id, ends_of] : were[i].edges) {
        if (crossed.count({were[i].id.index, id[0], id[1]}) != 0) continue;
        const auto now = threads_[i].edges.find(id);
        ASSERT_NE(now, threads_[i].edges.end()) << where;
        EXPECT_EQ(now->second, ends_of) << where;
      }
      for (size_t v = 0; v < were[i].at.size(); ++v) EXPECT_EQ(threads_[i].at[v], were[i].at[v]) << where;
      for (const auto& [id, ends_of] : threads_[i].edges) {
        const Vec &a = threads_[i].at[ends_of[0]], &b = threads_[i].at[ends_of[1]];
        const bool is_free =
            !blade.crosses(a, b) && world_.cast(world_.body(a.data()), world_.body(b.data())).outcome == Walk::kReached;
        EXPECT_TRUE(is_free) << where;
        not_free += is_free ? 0 : 1;
      }
    }
    // Loading proves all that is certain of bodies, also that they are apart.
    size_t size = 0;
    dsw_scene_save(scene_.get(), nullptr, 0, &size);
    std::vector<unsigned char> block(size);
    ASSERT_EQ(dsw_scene_save(scene_.get(), block.data(), size, &size), DSW_STATUS_OK);
    dsw_scene* loaded = nullptr;
    const dsw_status status = dsw_scene_load(dsw_scene_get_environment(scene_.get()), block.data(), size, &loaded);
    EXPECT_EQ(status, DSW_STATUS_OK) << where << dsw_last_error_message();
    not_free += status == DSW_STATUS_OK ? 0 : 1;
    dsw_scene_destroy(loaded);
  }

  World& world_;
  Rng& rng_;
  ScenePtr scene_;
  std::vector<Thread> threads_;
};

TEST_P(ThreadCutsTest, WhatCrossesIsCutAndNothingElse) {
  int calls = 0, cuts = 0, wrong = 0, not_free = 0, parts = 0;
  for (uint64_t seed = 21; seed < 21 + seeds_of(4, 1); ++seed) {
    Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    Rng rng(seed);
    if (place.world->outer_boundary_crosses()) continue;
    Cutting cutting(place, rng);
    if (cutting.threads() == 0) continue;
    for (int i = 0; i < 8; ++i, ++calls) {
      cutting.cut_once(GetParam() + " seed " + std::to_string(seed) + " cut " + std::to_string(i));
    }
    cuts += cutting.cuts;
    wrong += cutting.wrong;
    not_free += cutting.not_free;
    parts += cutting.parts;
  }
  RecordProperty("thread_cuts", cuts);
  RecordProperty("threads_wrong", wrong);
  RecordProperty("threads_not_free", not_free);
  if (calls > 50) {
    EXPECT_GT(cuts, calls / 10);
    EXPECT_GT(parts, cuts);  // hardly a part is lost
  }
}

}  // namespace
}  // namespace dsw::oracle::cuts
