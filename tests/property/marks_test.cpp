// Marks: what is set, what follows from it, what unmarking leaves, and what occupied volumes refuse.
#include "support.h"

namespace dsw::oracle {
namespace {

class MarksTest : public SceneTest {};
DSW_FOR_ALL_SCENES(MarksTest);

bool asked(const dsw_environment* environment, dsw_cell cell, bool own) {
  int answer = -1;
  const dsw_status status = own ? dsw_environment_is_marked(environment, cell, &answer)
                                : dsw_environment_is_impassable(environment, cell, &answer);
  EXPECT_EQ(status, DSW_STATUS_OK) << dsw_last_error_message();
  EXPECT_TRUE(answer == 0 || answer == 1);
  return answer == 1;
}

/// The marks as the test set them, and their closure worked out from them.
struct Marks {
  explicit Marks(Place& p) : place(p), edges(*p.world), edge(edges.edges.size()), vertex(p.mesh.points.size()) {}

  void compare() {
    World& world = *place.world;
    size_t counts[5] = {0, 0, 0, 0, 0};
    std::vector<bool> edge_closed(edge), vertex_closed(vertex);
    for (size_t f = 0; f < world.faces.size(); ++f) {
      const Face& face = world.faces[f];
      const bool closed = world.impassable(static_cast<int>(f));
      counts[DSW_CELL_FACE] += face.marked;
      for (size_t side = 0; side < (face.cell[1] < 0 ? 1u : 2u); ++side) {
        const dsw_cell cell = cell_of(face_id(world, static_cast<int>(f), side));
        EXPECT_EQ(asked(place.get(), cell, true), face.marked) << cell;
        EXPECT_EQ(asked(place.get(), cell, false), closed) << cell;
      }
      if (closed) {
        for (int v : face.loop) vertex_closed[static_cast<size_t>(v)] = true;
      }
    }
    for (size_t e = 0; e < edges.edges.size(); ++e) {
      bool closed = edge[e];
      for (int f : edges.edges[e].faces) closed = closed || world.impassable(f);
      counts[DSW_CELL_EDGE] += edge[e];
      const dsw_cell cell = cell_of(edges.id(world, static_cast<int>(e)));
      EXPECT_EQ(asked(place.get(), cell, true), edge[e]) << cell;
      EXPECT_EQ(asked(place.get(), cell, false), closed) << cell;
    }
    for (size_t c = 0; c < world.ids.size(); ++c) {
      counts[DSW_CELL_VOLUME] += world.cell_marked[c] != 0;
      EXPECT_EQ(asked(place.get(), cell_of(world.ids[c]), true), world.cell_marked[c] != 0);
      EXPECT_EQ(asked(place.get(), cell_of(world.ids[c]), false), world.cell_marked[c] != 0);
      for (int f : world.cell_faces[c]) {
        for (int v : world.faces[static_cast<size_t>(f)].loop) {
          dsw_vertex_id id;
          ASSERT_EQ(dsw_environment_get_vertex_id(place.get(), static_cast<uint32_t>(v), &id), DSW_STATUS_OK);
          EXPECT_EQ(asked(place.get(), cell_of(id), true), vertex[static_cast<size_t>(v)]) << "vertex " << v;
          EXPECT_EQ(asked(place.get(), cell_of(id), false), vertex_closed[static_cast<size_t>(v)]) << "vertex " << v;
        }
      }
    }
    for (bool v : vertex) counts[DSW_CELL_VERTEX] += v;
    for (dsw_cell_kind kind : {DSW_CELL_VERTEX, DSW_CELL_EDGE, DSW_CELL_FACE, DSW_CELL_VOLUME}) {
      size_t count = 0;
      ASSERT_EQ(dsw_environment_get_mark_count(place.get(), kind, &count), DSW_STATUS_OK);
      EXPECT_EQ(count, counts[kind]) << "kind " << kind;
    }
  }

  void random_change(Rng& rng) {
    World& world = *place.world;
    const dsw_mark mark = rng.chance(0.6) ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE;
    const bool on = mark == DSW_MARK_IMPASSABLE;
    const int kind = rng.between(0, 3);
    for (int n = rng.between(1, 4); n > 0; --n) {
      dsw_status status = DSW_STATUS_OK;
      if (kind == 0) {
        const size_t c = rng.below(world.ids.size());
        world.cell_marked[c] = on;
        const dsw_volume_id twice[2] = {world.ids[c], world.ids[c]};
        status = dsw_environment_mark_volumes(place.get(), twice, 2, mark, 0, nullptr);
      } else if (kind == 1) {
        const size_t f = rng.below(world.faces.size());
        world.faces[f].marked = on;
        const size_t side = world.faces[f].cell[1] >= 0 ? rng.below(2) : 0;
        const dsw_face_id id = face_id(world, static_cast<int>(f), side);
        status = dsw_environment_mark_faces(place.get(), &id, 1, mark);
      } else if (kind == 2) {
        const size_t c = rng.below(world.ids.size());
        const size_t local = rng.below(edges.of_cell[c].size());
        edge[static_cast<size_t>(edges.of_cell[c][local])] = on;
        const dsw_edge_id id = {world.ids[c].index, world.ids[c].generation, static_cast<uint32_t>(local)};
        status = dsw_environment_mark_edges(place.get(), &id, 1, mark);
      } else {
        const Face& f = world.faces[rng.below(world.faces.size())];
        const int v = f.loop[rng.below(f.loop.size())];
        vertex[static_cast<size_t>(v)] = on;
        dsw_vertex_id id;
        ASSERT_EQ(dsw_environment_get_vertex_id(place.get(), static_cast<uint32_t>(v), &id), DSW_STATUS_OK);
        status = dsw_environment_mark_vertices(place.get(), &id, 1, mark);
      }
      ASSERT_EQ(status, DSW_STATUS_OK) << dsw_last_error_message();
    }
  }

  Place& place;
  Edges edges;
  std::vector<bool> edge, vertex;
};

TEST_P(MarksTest, ClosureIsDerivedAndUnmarkingTakesOnlyWhatWasSet) {
  Place place = make_place(GetParam(), 51);
  ASSERT_PLACE(place);
  Marks marks(place);
  marks.compare();
  Rng rng(51);
  for (int round = 0; round < at_least(12); ++round) {
    for (int i = 0; i < 6; ++i) marks.random_change(rng);
    marks.compare();
  }
  // Take everything back: only the outer boundary is left.
  World& world = *place.world;
  ASSERT_EQ(
      dsw_environment_mark_volumes(place.get(), world.ids.data(), world.ids.size(), DSW_MARK_PASSABLE, 0, nullptr),
      DSW_STATUS_OK);
  std::fill(world.cell_marked.begin(), world.cell_marked.end(), 0);
  for (size_t f = 0; f < world.faces.size(); ++f) {
    const dsw_face_id id = face_id(world, static_cast<int>(f));
    world.faces[f].marked = false;
    ASSERT_EQ(dsw_environment_mark_faces(place.get(), &id, 1, DSW_MARK_PASSABLE), DSW_STATUS_OK);
  }
  for (size_t e = 0; e < marks.edge.size(); ++e) {
    const dsw_edge_id id = marks.edges.id(world, static_cast<int>(e));
    ASSERT_EQ(dsw_environment_mark_edges(place.get(), &id, 1, DSW_MARK_PASSABLE), DSW_STATUS_OK);
    marks.edge[e] = false;
  }
  for (size_t v = 0; v < marks.vertex.size(); ++v) {
    dsw_vertex_id id;
    ASSERT_EQ(dsw_environment_get_vertex_id(place.get(), static_cast<uint32_t>(v), &id), DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_mark_vertices(place.get(), &id, 1, DSW_MARK_PASSABLE), DSW_STATUS_OK);
    marks.vertex[v] = false;
  }
  marks.compare();
}

Place with_regions(const std::string& name, uint64_t seed) {
  Rng rng(seed);
  Mesh mesh = kind_named(name).make(rng);
  for (size_t c = 0; c < mesh.cells.size(); ++c) mesh.regions.push_back(rng.between(-1, 1));
  return place_of(std::move(mesh));
}

TEST_P(MarksTest, RegionsAndTheFacesBetweenThem) {
  Place place = with_regions(GetParam(), 53);
  ASSERT_PLACE(place);
  World& world = *place.world;
  Marks marks(place);
  size_t between = 0, marked = 0, skipped = 7;
  for (Face& f : world.faces) {
    if (f.cell[1] < 0) continue;
    const int a = place.mesh.regions[static_cast<size_t>(f.cell[0])],
              b = place.mesh.regions[static_cast<size_t>(f.cell[1])];
    if ((a == -1 && b == 1) || (a == 1 && b == -1)) {
      f.marked = true;
      ++between;
    }
  }
  ASSERT_EQ(dsw_environment_mark_between(place.get(), 1, -1, DSW_MARK_IMPASSABLE, &marked), DSW_STATUS_OK);
  EXPECT_EQ(marked, between);
  marks.compare();
  size_t zero = 0;
  for (size_t c = 0; c < world.ids.size(); ++c) {
    int32_t region = 99;
    ASSERT_EQ(dsw_environment_get_region(place.get(), world.ids[c], &region), DSW_STATUS_OK);
    EXPECT_EQ(region, place.mesh.regions[c]);
    if (region == 0) {
      world.cell_marked[c] = 1;
      ++zero;
    }
  }
  ASSERT_EQ(dsw_environment_mark_region(place.get(), 0, DSW_MARK_IMPASSABLE, 0, &marked, &skipped), DSW_STATUS_OK);
  EXPECT_EQ(marked, zero);
  EXPECT_EQ(skipped, 0u);
  marks.compare();
  // Between a region and itself: the faces inside it.
  size_t inside = 0;
  for (Face& f : world.faces) {
    if (f.cell[1] < 0 || place.mesh.regions[static_cast<size_t>(f.cell[0])] != 1 ||
        place.mesh.regions[static_cast<size_t>(f.cell[1])] != 1) {
      continue;
    }
    f.marked = true;
    ++inside;
  }
  ASSERT_EQ(dsw_environment_mark_between(place.get(), 1, 1, DSW_MARK_IMPASSABLE, &marked), DSW_STATUS_OK);
  EXPECT_EQ(marked, inside);
  marks.compare();
}

TEST_P(MarksTest, OccupiedVolumesRefuseAndSkip) {
  Place place = make_place(GetParam(), 55);
  ASSERT_PLACE(place);
  World& world = *place.world;
  Marks marks(place);
  const ScenePtr scene = make_scene(place.get());
  Rng rng(55);
  Motions motions(world, rng);
  std::vector<dsw_particle_id> particles;
  std::vector<char> held(world.ids.size(), 0);
  while (particles.size() < 3) {
    const Vec p = motions.start();
    const int cell = world.locate(world.body(p.data()));
    if (cell < 0) continue;
    dsw_particle_id id;
    ASSERT_EQ(dsw_particle_create(scene.get(), p.data(), {0, 0}, &id), DSW_STATUS_OK);
    particles.push_back(id);
    held[static_cast<size_t>(cell)] = 1;
  }
  size_t skipped = 99, occupants = 0;
  ASSERT_EQ(
      dsw_environment_mark_volumes(place.get(), world.ids.data(), world.ids.size(), DSW_MARK_IMPASSABLE, 0, &skipped),
      DSW_STATUS_OCCUPIED);
  EXPECT_EQ(skipped, 99u) << "out-arguments are untouched on failure";
  const dsw_particle_id* who = nullptr;
  ASSERT_EQ(dsw_scene_get_occupants(scene.get(), &who, &occupants), DSW_STATUS_OK);
  EXPECT_EQ(occupants, 3u);
  marks.compare();  // nothing changed
  ASSERT_EQ(dsw_environment_mark_volumes(place.get(), world.ids.data(), world.ids.size(), DSW_MARK_IMPASSABLE,
                                         DSW_MARK_SKIP_OCCUPIED, &skipped),
            DSW_STATUS_OK);
  size_t expected = 0;
  for (size_t c = 0; c < held.size(); ++c) {
    world.cell_marked[c] = !held[c];
    expected += held[c] != 0 ? 1u : 0u;
  }
  EXPECT_EQ(skipped, expected);
  ASSERT_EQ(dsw_scene_get_occupants(scene.get(), &who, &occupants), DSW_STATUS_OK);
  EXPECT_EQ(occupants, 3u);
  marks.compare();
  // Still free to move, and only inside what is left.
  Report report;
  report.begin(GetParam(), GetParam());
  Checker checker(world, place.get(), report);
  for (int i = 0; i < at_least(60); ++i) {
    const dsw_particle_id id = particles[rng.below(3u)];
    Vec from;
    ASSERT_EQ(dsw_particle_get_position(scene.get(), id, from.data(), nullptr), DSW_STATUS_OK);
    checker.move(scene.get(), id, motions.target(from), 0, false);
  }
  EXPECT_EQ(report.total.mismatches, 0u);
  EXPECT_EQ(report.total.lost, 0u);
  // A second scene shares the environment: marking is refused.
  const ScenePtr other = make_scene(place.get());
  EXPECT_EQ(dsw_environment_mark_volumes(place.get(), world.ids.data(), 1, DSW_MARK_PASSABLE, 0, nullptr),
            DSW_STATUS_SHARED);
  const dsw_face_id face = face_id(world, 0);
  EXPECT_EQ(dsw_environment_mark_faces(place.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_SHARED);
  EXPECT_EQ(dsw_environment_destroy(place.get()), DSW_STATUS_IN_USE);
  marks.compare();
}

TEST_P(MarksTest, OneStaleIdChangesNothing) {
  Place place = make_place(GetParam(), 57);
  ASSERT_PLACE(place);
  Marks marks(place);
  std::vector<dsw_volume_id> ids = place.world->ids;
  for (const dsw_volume_id bad : {dsw_volume_id{0, 0}, dsw_volume_id{ids[0].index, ids[0].generation + 1},
                                  dsw_volume_id{static_cast<uint32_t>(ids.size()), 1}, dsw_volume_id{0xffffffffu, 1}}) {
    std::vector<dsw_volume_id> list = ids;
    list.push_back(bad);
    EXPECT_EQ(dsw_environment_mark_volumes(place.get(), list.data(), list.size(), DSW_MARK_IMPASSABLE, 0, nullptr),
              DSW_STATUS_STALE_ID);
    const dsw_face_id faces[2] = {face_id(*place.world, 0), {bad.index, bad.generation, 0}};
    EXPECT_EQ(dsw_environment_mark_faces(place.get(), faces, 2, DSW_MARK_IMPASSABLE), DSW_STATUS_STALE_ID);
    const dsw_edge_id edges[2] = {marks.edges.id(*place.world, 0), {bad.index, bad.generation, 0}};
    EXPECT_EQ(dsw_environment_mark_edges(place.get(), edges, 2, DSW_MARK_IMPASSABLE), DSW_STATUS_STALE_ID);
  }
  const dsw_face_id beyond = {ids[0].index, ids[0].generation, 1000};
  EXPECT_EQ(dsw_environment_mark_faces(place.get(), &beyond, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_STALE_ID);
  marks.compare();
}

}  // namespace
}  // namespace dsw::oracle
