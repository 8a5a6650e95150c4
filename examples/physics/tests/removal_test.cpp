#include "removal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "channel.h"
#include "random_line.h"
#include "verify.h"
#include "world.h"

namespace physics {
namespace {

Environment make_room(bool post) {
  Channel channel;
  channel.cubes = {8, 4, 4};
  if (post) {
    channel.obstacles = {{4, 2, 1}};
  }
  return make_channel(channel);
}

// A cube of triangles.
BodyMesh make_cube() {
  BodyMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.corners.emplace_back(2.5 + (i & 1), 1.5 + (i >> 1 & 1), 1.5 + (i >> 2));
  }
  mesh.triangles = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return mesh;
}

// A body with its inserted vertices, outside of SoftBody.
struct Split {
  explicit Split(const BodyMesh& mesh) : environment(make_room(false)), world(environment.get()) {
    SoftBodyOptions options;
    body = world.add(std::make_unique<SoftBody>(world.scene(), mesh, 1, options));
  }

  std::vector<std::vector<std::uint32_t>> faces() const {
    std::vector<std::uint32_t> corners(3000);
    std::size_t slots = 0;
    check(dsw_body_get_face_indices(world.scene(), body->id(), corners.data(), 1000, &slots), "reading faces");
    std::vector<std::vector<std::uint32_t>> sorted;
    for (std::size_t f = 0; f < slots; ++f) {
      std::vector<std::uint32_t> face(corners.begin() + static_cast<std::ptrdiff_t>(3 * f),
                                      corners.begin() + static_cast<std::ptrdiff_t>(3 * f + 3));
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      if (face[0] != UINT32_MAX) {
        sorted.push_back(face);
      }
    }
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

  void split(dsw_body_edge_id edge, double share) {
    dsw_body_edit edit;
    check(dsw_body_split_edge(world.scene(), body->id(), edge, share, &edit), "splitting an edge");
    inserted.split(edit.ends[0].index, edit.ends[1].index, edit.vertex.index);
  }

  bool remove(const std::vector<double>& pulls, const std::vector<char>& colliding) {
    dsw_body_edit edit;
    if (!remove_one(world.scene(), body->id(), inserted, pulls, 0.5, colliding, &edit)) {
      return false;
    }
    inserted.merge(edit.vertex.index, edit.ends[0].index);
    return true;
  }

  Environment environment;
  World world;
  SoftBody* body = nullptr;
  InsertedVertices inserted;
};

TEST(Removal, OfManyVerticesInAnyOrderLeavesTheFacesOfTheBeginning) {
  std::mt19937 bits(7);
  for (int round = 0; round < 20; ++round) {
    Split split(make_cube());
    const auto first = split.faces();
    for (int k = 0; k < 25; ++k) {
      std::vector<dsw_body_edge_id> edges(1000);
      std::size_t count = 0;
      check(dsw_body_get_edge_ids(split.world.scene(), split.body->id(), edges.data(), edges.size(), &count),
            "reading edges");
      split.split(edges[bits() % count], 0.25 + 0.5 * static_cast<double>(bits()) / 4294967296.0);
    }
    EXPECT_NE(split.faces(), first);
    const std::vector<double> pulls(split.inserted.slots(), 0);
    for (int tries = 0; tries < 2000 && !split.inserted.empty(); ++tries) {
      std::vector<char> colliding(pulls.size(), 1);  // all but one
      colliding[bits() % colliding.size()] = 0;
      split.remove(pulls, colliding);
    }
    EXPECT_TRUE(split.inserted.empty()) << "round " << round;
    EXPECT_EQ(split.faces(), first) << "round " << round;
  }
}

TEST(Removal, NeedsThatNothingCollidesAndThatPullsAreNegligible) {
  Split split(BodyMesh{{{1, 1, 1}, {2, 1, 1}, {3, 1, 1}, {4, 1, 1}}, {0, 1, 1, 2, 2, 3}, {}});
  std::vector<dsw_body_edge_id> edges(3);
  std::size_t count = 0;
  check(dsw_body_get_edge_ids(split.world.scene(), split.body->id(), edges.data(), 3, &count), "reading edges");
  split.split(edges[1], 0.5);  // vertex 4 between 1 and 2
  const std::vector<char> nobody(5, 0);
  EXPECT_FALSE(split.remove(std::vector<double>(5, 0), {0, 0, 0, 0, 1}));
  EXPECT_FALSE(split.remove({0, 0, 0, 0, 0.6}, nobody)) << "it is pulled";
  EXPECT_FALSE(split.remove({0, 0.6, 0, 0, 0}, nobody)) << "a neighbour is";
  EXPECT_FALSE(split.remove({0, 0, 0, 0, std::nan("")}, nobody));
  EXPECT_TRUE(split.remove({0.6, 0.5, 0.5, 0.6, 0.5}, {1, 1, 1, 1, 0})) << "others are";
  EXPECT_FALSE(split.remove(std::vector<double>(5, 0), nobody)) << "gone";
}

TEST(Removal, WhatTheLibraryRefusesStaysAndIsTriedAgain) {
  const Environment environment = make_room(true);
  World world(environment.get());
  // A line bent round the upper edges of the post, which is 4 < x < 5, 2 < y < 3, 1 < z < 2; it does not move.
  SoftBodyOptions options;
  options.level = DSW_LEVEL_EDGES_SWEPT;
  options.move.noise_share = 0;
  options.match = 1e-9;
  SoftBody* body =
      world.add(std::make_unique<SoftBody>(world.scene(), Positions{{3.5, 2.5, 2.6}, {5.5, 2.5, 2.6}}, 1, options));
  body->shape.emplace(body->points);
  body->points.held = {1, 1};
  body->points.velocity = {Vector3(0, 0, -1), Vector3(0, 0, -1)};
  while (body->points.position[0].z() > 1.5) {
    world.step(0.01);
  }
  ASSERT_GT(body->count(), 2u);
  body->options.negligible = 10;  // of the radius: everything is
  body->points.rest();
  std::size_t bent = 0;
  for (int step = 0; step < 20; ++step) {
    world.step(0.01);
    bent = body->count();
    EXPECT_GT(bent, 2u);
  }
  EXPECT_EQ(world.report(0).move.contact_count, 0u) << "it is the library that keeps them";
  EXPECT_TRUE(verify(world.scene(), body->id()).good());
  body->points.velocity[0] = body->points.velocity[1] = Vector3(0, 0, 1);
  for (int step = 0; step < 200 && body->count() > 2; ++step) {
    world.step(0.01);
    EXPECT_TRUE(verify(world.scene(), body->id()).good());
  }
  EXPECT_EQ(body->count(), 2u);
  EXPECT_EQ(body->points.mass[0], 1);
  EXPECT_EQ(body->points.mass[1], 1);
}

}  // namespace
}  // namespace physics
