// Environments for the property tests and what topology says of them, worked out from the mesh alone.
#pragma once

#include "../effort.h"
#include "check.h"
#include "run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>

// Where argument-dependent lookup finds it.
inline std::ostream& operator<<(std::ostream& out, const dsw_cell& c) {
  return out << "kind " << c.kind << " " << c.index << "." << c.generation << "/" << c.local;
}

namespace dsw::oracle {

/// How many seeds a test goes through where less effort leaves none out.
inline uint64_t seeds_of(int count) { return static_cast<uint64_t>(at_least(count)); }
/// How many seeds a test goes through where less effort leaves out all but the first ones.
inline uint64_t seeds_of(int count, int first) { return static_cast<uint64_t>(std::max(effort_of(count), first)); }

struct ContextDelete {
  void operator()(dsw_context* c) const { dsw_context_destroy(c); }
};
using ContextPtr = std::unique_ptr<dsw_context, ContextDelete>;

/// One environment with the oracle's picture of it.
struct Place {
  Mesh mesh;
  EnvironmentPtr environment;
  std::unique_ptr<World> world;
  dsw_environment* get() const { return environment.get(); }
};

inline const SceneKind& kind_named(const std::string& name) {
  for (const SceneKind& kind : all_kinds()) {
    if (name == kind.name) return kind;
  }
  throw std::runtime_error("no scene " + name);
}

inline Place place_of(Mesh mesh, uint32_t flags = 0, dsw_context* context = nullptr) {
  Place place;
  place.mesh = std::move(mesh);
  place.environment = create_environment(place.mesh, {}, flags, context);
  if (place.environment != nullptr) place.world = std::make_unique<World>(place.mesh, place.get());
  return place;
}

/// Where the mesh of a seed has inverted cells, as some warped ones do, the next one is drawn.
inline Place make_place(const std::string& name, uint64_t seed, uint32_t flags = 0, dsw_context* context = nullptr) {
  Rng rng(seed);
  Place place;
  do {
    Mesh mesh = kind_named(name).make(rng);
    shuffle_cells(mesh, rng);
    place = place_of(std::move(mesh), flags, context);
  } while (place.environment == nullptr && may_be_refused(place.mesh));
  return place;
}

#define ASSERT_PLACE(place)                \
  ASSERT_NE((place).environment, nullptr); \
  ASSERT_NE((place).world, nullptr);       \
  ASSERT_EQ((place).world->fault(), std::string())

inline EnvironmentPtr create_from(const dsw_environment_desc& desc, dsw_context* context = nullptr) {
  dsw_environment* environment = nullptr;
  EXPECT_EQ(dsw_environment_create(context, &desc, &environment, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  return EnvironmentPtr(environment);
}

/// Volumes of one type, which has so many corners.
inline dsw_environment_desc uniform_desc(uint32_t dimension, dsw_cell_type type, size_t corners_of_each,
                                         const std::vector<double>& points, const std::vector<int32_t>& corners) {
  dsw_environment_desc desc = defaults(dsw_environment_desc_init);
  desc.dimension = dimension;
  desc.points = points.data();
  desc.point_count = points.size() / dimension;
  desc.uniform_cell_type = static_cast<uint8_t>(type);
  desc.volume_count = corners.size() / corners_of_each;
  desc.index_bytes = 4;
  desc.connectivity = corners.data();
  desc.connectivity_count = corners.size();
  return desc;
}

inline ScenePtr make_scene(dsw_environment* environment, uint32_t features = 0) {
  dsw_scene_desc desc = defaults(dsw_scene_desc_init);
  desc.features = features;
  dsw_scene* scene = nullptr;
  EXPECT_EQ(dsw_scene_create(environment, &desc, &scene), DSW_STATUS_OK) << dsw_last_error_message();
  return ScenePtr(scene);
}

inline dsw_cell cell_of(dsw_face_id f) { return {DSW_CELL_FACE, f.volume, f.generation, f.local}; }
inline dsw_cell cell_of(dsw_edge_id e) { return {DSW_CELL_EDGE, e.volume, e.generation, e.local}; }
inline dsw_cell cell_of(dsw_volume_id v) { return {DSW_CELL_VOLUME, v.index, v.generation, 0}; }
inline dsw_cell cell_of(dsw_vertex_id v) { return {DSW_CELL_VERTEX, v.index, v.generation, 0}; }

inline bool same(const dsw_cell& a, const dsw_cell& b) {
  return a.kind == b.kind && a.index == b.index && a.generation == b.generation && a.local == b.local;
}
inline bool same(const dsw_face_id& a, const dsw_face_id& b) { return same(cell_of(a), cell_of(b)); }
inline bool same(const dsw_edge_id& a, const dsw_edge_id& b) { return same(cell_of(a), cell_of(b)); }
inline bool same(const dsw_volume_id& a, const dsw_volume_id& b) { return same(cell_of(a), cell_of(b)); }

/// Edges of the environment: groups of (volume, local edge) that are joined through faces.
struct Edges {
  struct Edge {
    int volume = 0, local = 0;  // canonical: the lowest volume
    std::array<int, 2> ends;
    std::vector<int> faces;
  };
  std::vector<Edge> edges;
  std::vector<std::vector<int>> of_cell;  // cell, local -> edge

  explicit Edges(const World& world) {
    const auto& cells = world.mesh.cells;
    std::vector<std::map<std::pair<int, int>, int>> index(cells.size());
    std::vector<std::array<int, 2>> slots, ends;  // slot -> (cell, local)
    for (size_t c = 0; c < cells.size(); ++c) {
      int local = 0;
      for (const auto& e : cell_edges(cells[c])) {
        index[c][{std::min(e[0], e[1]), std::max(e[0], e[1])}] = static_cast<int>(slots.size());
        slots.push_back({static_cast<int>(c), local++});
        ends.push_back({std::min(e[0], e[1]), std::max(e[0], e[1])});
      }
    }
    std::vector<int> root(slots.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int i) {
      while (root[static_cast<size_t>(i)] != i) i = root[static_cast<size_t>(i)];
      return i;
    };
    const auto for_edges = [&](const Face& f, size_t side, const auto& visit) {
      for (size_t i = 0; i < f.loop.size(); ++i) {
        const int a = f.loop[i], b = f.loop[(i + 1) % f.loop.size()];
        visit(index[static_cast<size_t>(f.cell[side])].at({std::min(a, b), std::max(a, b)}), i);
      }
    };
    for (const Face& f : world.faces) {
      if (f.cell[1] < 0) continue;
      std::vector<int> first;
      for_edges(f, 0, [&](int slot, size_t) { first.push_back(slot); });
      for_edges(f, 1, [&](int slot, size_t i) {
        const int a = find(first[i]), b = find(slot);
        root[static_cast<size_t>(std::max(a, b))] = std::min(a, b);  // slots ascend with cells: the root is canonical
      });
    }
    std::vector<int> edge_of(slots.size(), -1);
    of_cell.resize(cells.size());
    for (size_t s = 0; s < slots.size(); ++s) {
      const auto r = static_cast<size_t>(find(static_cast<int>(s)));
      if (edge_of[r] < 0) {
        edge_of[r] = static_cast<int>(edges.size());
        edges.push_back({slots[r][0], slots[r][1], ends[r], {}});
      }
      of_cell[static_cast<size_t>(slots[s][0])].push_back(edge_of[r]);
    }
    for (size_t f = 0; f < world.faces.size(); ++f) {
      for_edges(world.faces[f], 0, [&](int slot, size_t) {
        edges[static_cast<size_t>(edge_of[static_cast<size_t>(find(slot))])].faces.push_back(static_cast<int>(f));
      });
    }
  }
  dsw_edge_id id(const World& world, int edge) const {
    const Edge& e = edges[static_cast<size_t>(edge)];
    const dsw_volume_id owner = world.ids[static_cast<size_t>(e.volume)];
    return {owner.index, owner.generation, static_cast<uint32_t>(e.local)};
  }
};

inline dsw_face_id face_id(const World& world, int face, size_t side = 0) {
  const Face& f = world.faces[static_cast<size_t>(face)];
  const dsw_volume_id owner = world.ids[static_cast<size_t>(f.cell[side])];
  return {owner.index, owner.generation, static_cast<uint32_t>(f.local[side])};
}

inline std::vector<dsw_vertex_id> vertices_of(const dsw_environment* environment, dsw_cell cell) {
  size_t count = 0;
  EXPECT_EQ(dsw_environment_copy_vertices(environment, cell, nullptr, 0, &count), DSW_STATUS_OK);
  std::vector<dsw_vertex_id> v(count);
  size_t again = 0;
  EXPECT_EQ(dsw_environment_copy_vertices(environment, cell, v.data(), v.size(), &again), DSW_STATUS_OK);
  EXPECT_EQ(again, count);
  return v;
}

inline std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneKind& kind : all_kinds()) names.emplace_back(kind.name);
  return names;
}

/// Every member of what was touched.
inline std::string bits_of(const dsw_contact& c) {
  char rest[400];
  std::snprintf(rest, sizeof rest, " o %d %u.%u/%u w %u.%u/%u f %u.%u b %u.%u k %d m %d tag %u", c.obstacle.kind,
                c.obstacle.index, c.obstacle.generation, c.obstacle.local, c.wall.volume, c.wall.generation,
                c.wall.local, c.front.index, c.front.generation, c.behind.index, c.behind.generation, c.kind,
                c.marked_kind, c.tag);
  return hex(c.normal) + rest;
}

/// Every member of a flight, for comparisons bit by bit.
inline std::string bits_of(const dsw_flight& f) {
  char rest[100];
  std::snprintf(rest, sizeof rest, " t %a v %u.%u o %d n %u", f.time, f.volume.index, f.volume.generation, f.outcome,
                f.volumes_visited);
  return hex(f.position) + bits_of(f.contact) + rest;
}

/// Every member of a sweep's report.
inline std::string bits_of(const dsw_sweep& s) {
  char rest[120];
  std::snprintf(rest, sizeof rest, " t %a a %a v %u.%u o %d n %u", s.time, s.edge_parameter, s.volume.index,
                s.volume.generation, s.outcome, s.volumes_visited);
  return hex(s.position) + hex(s.point) + bits_of(s.contact) + rest;
}

/// The kinds that a suite meets: all of them, unless so little is asked for that `times` this part is less. Then they are as many, spread
/// over the list, from a place that differs from suite to suite and from seed to seed; at least three.
template <class Kind>
std::vector<Kind> drawn_for(const std::string& suite, const std::vector<Kind>& kinds, int times = 4) {
  const size_t count =
      std::min(kinds.size(), static_cast<size_t>(std::max(3, effort_of(times * static_cast<int>(kinds.size())))));
  uint64_t seed = 0;
  for (const char letter : suite) seed = 31 * seed + static_cast<uint64_t>(letter);
  Rng rng(seed);
  const size_t first = rng.below(kinds.size());
  std::vector<Kind> drawn;
  for (size_t i = 0; i < count; ++i) drawn.push_back(kinds[(first + i * kinds.size() / count) % kinds.size()]);
  return drawn;
}

class SceneTest : public testing::TestWithParam<std::string> {};
#define DSW_FOR_ALL_SCENES(name)                                                                                    \
  INSTANTIATE_TEST_SUITE_P(All, name, testing::ValuesIn(dsw::oracle::drawn_for(#name, dsw::oracle::scene_names())), \
                           [](const testing::TestParamInfo<std::string>& i) { return i.param; })

}  // namespace dsw::oracle
