// Topology through the interface: ids, counts, the laws of beta1, beta2 and beta3, Euler's formula, volumes.
#include "support.h"

#include <algorithm>
#include <set>

namespace dsw::oracle {
namespace {

class TopologyTest : public SceneTest {};
DSW_FOR_ALL_SCENES(TopologyTest);

std::vector<int> indices(const std::vector<dsw_vertex_id>& ids) {
  std::vector<int> v;
  for (dsw_vertex_id id : ids) v.push_back(static_cast<int>(id.index));
  return v;
}

/// Tells whether two cycles are the same, wherever each starts.
bool same_cycle(std::vector<int> a, const std::vector<int>& b) {
  for (size_t i = 0; i < a.size(); ++i) {
    if (a == b) return true;
    std::rotate(a.begin(), a.begin() + 1, a.end());
  }
  return false;
}

TEST_P(TopologyTest, CountsAndTypesAreTheMeshs) {
  for (uint64_t seed = 1; seed <= seeds_of(3); ++seed) {
    const Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    dsw_environment_info info;
    info.struct_size = sizeof info;
    ASSERT_EQ(dsw_environment_get_info(place.get(), &info), DSW_STATUS_OK);
    EXPECT_EQ(info.dimension, 3u);
    EXPECT_EQ(info.vertex_count, place.mesh.points.size());
    EXPECT_EQ(info.volume_count, place.mesh.cells.size());
    EXPECT_EQ(info.face_count, place.world->faces.size());
    size_t boundary = 0;
    for (const Face& f : place.world->faces) boundary += f.cell[1] < 0;
    EXPECT_EQ(info.boundary_face_count, boundary);
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(info.lower[k], place.world->lower[k]);
      EXPECT_EQ(info.upper[k], place.world->upper[k]);
    }
    for (size_t c = 0; c < place.mesh.cells.size(); ++c) {
      const Cell& cell = place.mesh.cells[c];
      dsw_cell_type type;
      uint32_t v = 0, e = 0, f = 0;
      ASSERT_EQ(dsw_environment_get_volume_counts(place.get(), place.world->ids[c], &type, &v, &e, &f), DSW_STATUS_OK);
      std::set<int> used;
      for (const Loop& loop : cell.faces) used.insert(loop.begin(), loop.end());
      EXPECT_EQ(static_cast<int>(type), cell.type);
      EXPECT_EQ(v, used.size());
      EXPECT_EQ(e, cell_edges(cell).size());
      EXPECT_EQ(f, cell.faces.size());
      EXPECT_EQ(static_cast<int>(v) - static_cast<int>(e) + static_cast<int>(f), 2) << "cell " << c;
      const std::vector<int> listed = indices(vertices_of(place.get(), cell_of(place.world->ids[c])));
      if (cell.type != DSW_CELL_TYPE_POLYHEDRON) {
        EXPECT_EQ(listed, cell.vertices);
      } else {
        std::vector<int> first_use;
        for (const Loop& loop : cell.faces) {
          for (int x : loop) {
            if (std::find(first_use.begin(), first_use.end(), x) == first_use.end()) first_use.push_back(x);
          }
        }
        EXPECT_EQ(listed, first_use);
      }
    }
  }
}

TEST_P(TopologyTest, FaceIdsAgreeFromBothSides) {
  const Place place = make_place(GetParam(), 5);
  ASSERT_PLACE(place);
  const World& world = *place.world;
  for (size_t c = 0; c < place.mesh.cells.size(); ++c) {
    for (size_t f = 0; f < place.mesh.cells[c].faces.size(); ++f) {
      const int face = world.cell_faces[c][f];
      const Face& want = world.faces[static_cast<size_t>(face)];
      dsw_face_id id;
      ASSERT_EQ(dsw_environment_get_face_id(place.get(), world.ids[c], static_cast<uint32_t>(f), &id), DSW_STATUS_OK);
      EXPECT_TRUE(same(id, face_id(world, face))) << cell_of(id);
      // Either name is accepted, and each tells the volumes from its own side (beta3 is an involution).
      const size_t side = want.cell[0] == static_cast<int>(c) ? 0 : 1;
      const dsw_face_id own = face_id(world, face, side);
      dsw_volume_id near_side, far_side;
      ASSERT_EQ(dsw_environment_get_face_volumes(place.get(), own, &near_side, &far_side), DSW_STATUS_OK);
      EXPECT_TRUE(same(near_side, world.ids[c]));
      if (want.cell[1] < 0) {
        EXPECT_TRUE(same(far_side, dsw_volume_id{0, 0}));
      } else {
        EXPECT_TRUE(same(far_side, world.ids[static_cast<size_t>(want.cell[1 - side])]));
      }
      const std::vector<int> loop = indices(vertices_of(place.get(), cell_of(own)));
      EXPECT_TRUE(same_cycle(loop, place.mesh.cells[c].faces[f]));
    }
  }
}

TEST_P(TopologyTest, EveryEdgeOfAVolumeLiesInTwoOfItsFaces) {
  const Place place = make_place(GetParam(), 6);
  ASSERT_PLACE(place);
  const World& world = *place.world;
  for (size_t c = 0; c < place.mesh.cells.size(); ++c) {
    std::map<std::pair<int, int>, int> directed;
    for (size_t f = 0; f < place.mesh.cells[c].faces.size(); ++f) {
      const auto id = world.ids[c];
      const std::vector<int> loop =
          indices(vertices_of(place.get(), cell_of(dsw_face_id{id.index, id.generation, static_cast<uint32_t>(f)})));
      for (size_t i = 0; i < loop.size(); ++i) ++directed[{loop[i], loop[(i + 1) % loop.size()]}];
    }
    for (const auto& [edge, n] : directed) {
      EXPECT_EQ(n, 1);
      EXPECT_EQ(directed.count({edge.second, edge.first}), 1u);
    }
  }
}

TEST_P(TopologyTest, EdgeIdsAreThoseOfTheLowestVolumeRound) {
  const Place place = make_place(GetParam(), 7);
  ASSERT_PLACE(place);
  const Edges edges(*place.world);
  for (size_t c = 0; c < place.mesh.cells.size(); ++c) {
    for (size_t e = 0; e < edges.of_cell[c].size(); ++e) {
      dsw_edge_id id;
      ASSERT_EQ(dsw_environment_get_edge_id(place.get(), place.world->ids[c], static_cast<uint32_t>(e), &id),
                DSW_STATUS_OK);
      EXPECT_TRUE(same(id, edges.id(*place.world, edges.of_cell[c][e])))
          << "cell " << c << " edge " << e << ": " << cell_of(id);
      std::vector<int> ends = indices(vertices_of(place.get(), cell_of(id)));
      ASSERT_EQ(ends.size(), 2u);
      std::sort(ends.begin(), ends.end());
      const auto& want = edges.edges[static_cast<size_t>(edges.of_cell[c][e])].ends;
      EXPECT_EQ(ends[0], want[0]);
      EXPECT_EQ(ends[1], want[1]);
    }
  }
}

TEST_P(TopologyTest, EulerCharacteristicIsThatOfABall) {
  // Random Delaunay meshes need not be balls; those of this seed are.
  const Place place = make_place(GetParam(), 8);
  ASSERT_PLACE(place);
  std::set<std::array<uint32_t, 3>> faces, edge_ids;
  std::set<uint32_t> vertices;
  for (size_t c = 0; c < place.mesh.cells.size(); ++c) {
    const dsw_volume_id id = place.world->ids[c];
    uint32_t ne = 0, nf = 0;
    ASSERT_EQ(dsw_environment_get_volume_counts(place.get(), id, nullptr, nullptr, &ne, &nf), DSW_STATUS_OK);
    for (uint32_t i = 0; i < nf; ++i) {
      dsw_face_id f;
      ASSERT_EQ(dsw_environment_get_face_id(place.get(), id, i, &f), DSW_STATUS_OK);
      faces.insert({f.volume, f.generation, f.local});
    }
    for (uint32_t i = 0; i < ne; ++i) {
      dsw_edge_id e;
      ASSERT_EQ(dsw_environment_get_edge_id(place.get(), id, i, &e), DSW_STATUS_OK);
      edge_ids.insert({e.volume, e.generation, e.local});
    }
    for (dsw_vertex_id v : vertices_of(place.get(), cell_of(id))) vertices.insert(v.index);
  }
  const long chi = static_cast<long>(vertices.size()) - static_cast<long>(edge_ids.size()) +
                   static_cast<long>(faces.size()) - static_cast<long>(place.mesh.cells.size());
  EXPECT_EQ(chi, 1);
}

TEST_P(TopologyTest, CellVolumesAddUpToTheOuterBoundary) {
  for (uint64_t seed = 11; seed < 11 + seeds_of(4); ++seed) {
    const Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    Big sum = 0;
    for (size_t c = 0; c < place.mesh.cells.size(); ++c) {
      const Big volume = place.world->volume6(static_cast<int>(c));
      EXPECT_GT(sgn(volume), 0) << "cell " << c;
      sum += volume;
    }
    EXPECT_EQ(sum, place.world->outer_volume6());
  }
}

TEST_P(TopologyTest, FacesAndEdgesAreFoundByTheirVertices) {
  const Place place = make_place(GetParam(), 9);
  ASSERT_PLACE(place);
  const World& world = *place.world;
  std::vector<size_t> offsets = {0};
  std::vector<uint32_t> list;
  for (const Face& f : world.faces) {
    for (auto v = f.loop.rbegin(); v != f.loop.rend(); ++v) list.push_back(static_cast<uint32_t>(*v));
    offsets.push_back(list.size());
  }
  list.insert(list.end(), {0, 0, 0});  // no such face
  offsets.push_back(list.size());
  std::vector<dsw_face_id> found(offsets.size() - 1);
  size_t missing = 0;
  ASSERT_EQ(dsw_environment_find_faces(place.get(), found.size(), offsets.data(), list.data(), found.data(), &missing),
            DSW_STATUS_OK);
  EXPECT_EQ(missing, 1u);
  for (size_t f = 0; f < world.faces.size(); ++f) EXPECT_TRUE(same(found[f], face_id(world, static_cast<int>(f))));
  EXPECT_TRUE(same(found.back(), dsw_face_id{0, 0, 0}));

  const Edges edges(world);
  std::vector<uint32_t> pairs;
  for (const auto& e : edges.edges) {
    pairs.push_back(static_cast<uint32_t>(e.ends[1]));
    pairs.push_back(static_cast<uint32_t>(e.ends[0]));
  }
  std::vector<dsw_edge_id> found_edges(edges.edges.size());
  ASSERT_EQ(dsw_environment_find_edges(place.get(), found_edges.size(), pairs.data(), found_edges.data(), &missing),
            DSW_STATUS_OK);
  EXPECT_EQ(missing, 0u);
  for (size_t e = 0; e < found_edges.size(); ++e) {
    // Where parts touch along an edge there are several with these ends: any of them is right.
    bool right = false;
    for (size_t o = 0; o < edges.edges.size(); ++o) {
      right = right || (edges.edges[o].ends == edges.edges[e].ends &&
                        same(found_edges[e], edges.id(world, static_cast<int>(o))));
    }
    EXPECT_TRUE(right) << cell_of(found_edges[e]);
  }
}

TEST_P(TopologyTest, CheckPassesOnValidMeshes) {
  for (uint64_t seed = 20; seed < 20 + seeds_of(3); ++seed) {
    const Place place = make_place(GetParam(), seed);
    ASSERT_PLACE(place);
    EXPECT_EQ(dsw_environment_check(place.get(), nullptr), DSW_STATUS_OK) << dsw_last_error_message();
  }
}

}  // namespace
}  // namespace dsw::oracle
