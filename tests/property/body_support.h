// A grid of unit cubes with a scene in it, and bodies made from lists.
#pragma once

#include "body_state.h"
#include "support.h"

#include <cmath>
#include <cstring>

namespace dsw::oracle {

/// 4 x 4 x 3 unit cubes; cube (x, y, z) is volume x + 4 * (y + 4 * z).
class BodyTest : public testing::Test {
 protected:
  void SetUp() override {
    place_ = place_of(hex_grid(axis(4, 1), axis(4, 1), axis(3, 1)));
    ASSERT_PLACE(place_);
    scene_ = make_scene(place_.get());
  }

  dsw_scene* scene() { return scene_.get(); }
  dsw_volume_id cube(uint32_t x, uint32_t y, uint32_t z) const { return place_.world->ids[x + 4 * (y + 4 * z)]; }
  static uint32_t point(uint32_t x, uint32_t y, uint32_t z) { return x + 5 * (y + 5 * z); }
  dsw_face_id face_between(uint32_t x, uint32_t y, uint32_t z) const {  // cube (x, y, z) and the next along x
    const dsw_volume_id v = cube(x, y, z);
    return {v.index, v.generation, 1};
  }
  void mark_wall(uint32_t x, uint32_t y, uint32_t z) {
    const dsw_face_id face = face_between(x, y, z);
    ASSERT_EQ(dsw_environment_mark_faces(place_.get(), &face, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  /// The edge of the grid from a point along z.
  void mark_edge(uint32_t x, uint32_t y, uint32_t z) {
    const uint32_t ends[2] = {point(x, y, z), point(x, y, z + 1)};
    dsw_edge_id edge;
    ASSERT_EQ(dsw_environment_find_edges(place_.get(), 1, ends, &edge, nullptr), DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_mark_edges(place_.get(), &edge, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
  }
  void mark_volume(dsw_volume_id volume) {
    ASSERT_EQ(dsw_environment_mark_volumes(place_.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr), DSW_STATUS_OK);
  }

  dsw_body_id make(const BodyPlan& plan, dsw_level level = DSW_LEVEL_EDGES_SWEPT, uint32_t flags = 0) {
    dsw_body_id body = {0, 0};
    EXPECT_EQ(create_body(scene(), plan, level, flags, {}, &body), DSW_STATUS_OK) << dsw_last_error_message();
    return body;
  }
  BodyState read(dsw_body_id body) {
    BodyState state;
    EXPECT_EQ(read_body(scene(), body, state), "");
    return state;
  }
  size_t body_count() {
    size_t count = 999;
    EXPECT_EQ(dsw_scene_get_body_count(scene(), &count), DSW_STATUS_OK);
    return count;
  }

  Place place_;
  ScenePtr scene_;
};

/// Everything that the interface tells of a body, for "nothing has changed".
inline std::string bits_of(const BodyState& s) {
  std::string text;
  for (size_t v = 0; v < s.at.size(); ++v) {
    text += hex(s.at[v]) + std::to_string(s.volumes[v].index) + "v" + std::to_string(s.vertices[v].index) + "." +
            std::to_string(s.vertices[v].generation) + "\n";
  }
  for (size_t e = 0; e < s.edges.size(); ++e) {
    text += "e" + std::to_string(s.edge_ids[e].index) + "." + std::to_string(s.edge_ids[e].generation) + " " +
            std::to_string(s.edges[e][0]) + "-" + std::to_string(s.edges[e][1]) + "\n";
  }
  for (size_t f = 0; f < s.faces.size(); ++f) {
    text += "f" + std::to_string(s.face_ids[f].index) + "." + std::to_string(s.face_ids[f].generation);
    for (uint32_t v : s.faces[f]) text += " " + std::to_string(v);
    text += "\n";
  }
  return text;
}

inline BodyPlan segment(const Vec& a, const Vec& b) { return {{a, b}, {{0, 1}}, {}}; }
/// A closed surface of 4 * rings + 2 vertices.
inline BodyPlan ball(const Vec& centre, double radius, uint32_t rings) {
  BodyPlan plan;
  const auto at = [&](double x, double y, double z) {
    plan.at.push_back({centre[0] + radius * x, centre[1] + radius * y, centre[2] + radius * z});
  };
  at(0, 0, 1);
  for (uint32_t r = 0; r < rings; ++r) {
    const double z = 1 - 2.0 * (r + 1) / (rings + 1), wide = 1 - z * z;
    for (const auto& [x, y] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{-1, 0}, std::pair{0, -1}})
      at(wide * x, wide * y, z);
  }
  at(0, 0, -1);
  const uint32_t last = 4 * rings + 1;
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t j = (i + 1) % 4;
    plan.faces.push_back({0, 1 + i, 1 + j});
    for (uint32_t r = 0; r + 1 < rings; ++r)
      plan.faces.push_back({1 + 4 * r + i, 5 + 4 * r + i, 5 + 4 * r + j, 1 + 4 * r + j});
    plan.faces.push_back({last, last - 4 + j, last - 4 + i});
  }
  return plan;
}

/// The surface of a tetrahedron, turned outwards.
inline BodyPlan tetrahedron(const Vec& at, double size) {
  const auto corner = [&](double x, double y, double z) {
    return Vec{at[0] + size * x, at[1] + size * y, at[2] + size * z};
  };
  return {{at, corner(1, 0, 0), corner(0, 1, 0), corner(0, 0, 1)}, {}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

}  // namespace dsw::oracle
