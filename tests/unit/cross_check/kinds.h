// Random environments and bodies, their contacts, and both features of a contact.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include "cross_check/penetration.h"
#include "dartsweep/dartsweep.h"
#include "touches.h"

namespace dsw::test {

constexpr double kLeastShare = 0.9, kMostDegrees = 0.01;  // of all touches; at the 99th percentile
constexpr uint32_t kSide = 3;

struct Delete {
  void operator()(dsw_environment* environment) const { dsw_environment_destroy(environment); }
  void operator()(dsw_scene* scene) const { dsw_scene_destroy(scene); }
};
using Environment = std::unique_ptr<dsw_environment, Delete>;
using Scene = std::unique_ptr<dsw_scene, Delete>;

class CrossCheckKinds : public testing::Test {
 protected:
  void SetUp() override {
    try {
      require_libccd();
    } catch (const std::exception&) {
      GTEST_SKIP() << "built without libccd";
    }
  }

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  uint32_t below(uint32_t count) { return static_cast<uint32_t>(random_() % count); }
  Vec inside(double margin = 0.1) {
    return {between(margin, kSide - margin), between(margin, kSide - margin), between(margin, kSide - margin)};
  }
  Vec near(const Vec& p, double size) {
    return {p[0] + between(-size, size), p[1] + between(-size, size), p[2] + between(-size, size)};
  }

  /// Cubes of six tetrahedra each, with inner vertices off the grid.
  Environment tetrahedra(dsw_environment_desc& desc) {
    static constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
    static constexpr int kSteps[3] = {1, kSide + 1, (kSide + 1) * (kSide + 1)};
    std::vector<int64_t> cells;
    points_.clear();
    for (uint32_t i = 0; i < (kSide + 1) * (kSide + 1) * (kSide + 1); ++i) {
      for (int k = 0; k < 3; ++k) {
        const uint32_t at = i / static_cast<uint32_t>(kSteps[k]) % (kSide + 1);
        points_.push_back(at + (at == 0 || at == kSide ? 0 : between(-0.15, 0.15)));
      }
    }
    for (uint32_t cube = 0; cube < kSide * kSide * kSide; ++cube) {
      const int64_t p =
          cube % kSide + kSteps[1] * int64_t{cube / kSide % kSide} + kSteps[2] * int64_t{cube / kSide / kSide};
      for (int i = 0; i < 6; ++i) {
        const int64_t a = p + kSteps[kOrders[i][0]], b = a + kSteps[kOrders[i][1]], c = b + kSteps[kOrders[i][2]];
        cells.insert(cells.end(), {p, i >= 3 ? b : a, i >= 3 ? a : b, c});
      }
    }
    dsw_environment_desc_init(&desc, sizeof desc);
    desc.points = points_.data();
    desc.point_count = points_.size() / 3;
    desc.uniform_cell_type = DSW_CELL_TYPE_TETRA;
    desc.volume_count = cells.size() / 4;
    desc.connectivity = cells.data();
    desc.connectivity_count = cells.size();
    return create(desc);
  }
  Environment tetrahedra() {
    dsw_environment_desc desc;
    return tetrahedra(desc);
  }
  static Environment create(const dsw_environment_desc& desc) {
    dsw_environment* environment = nullptr;
    EXPECT_EQ(dsw_environment_create(nullptr, &desc, &environment, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    return Environment(environment);
  }
  static Scene scene_of(const Environment& environment, uint32_t features) {
    dsw_scene_desc desc;
    dsw_scene* scene = nullptr;
    dsw_scene_desc_init(&desc, sizeof desc);
    desc.features = features;
    EXPECT_EQ(dsw_scene_create(environment.get(), &desc, &scene), DSW_STATUS_OK) << dsw_last_error_message();
    return Scene(scene);
  }

  /// A share of the volumes becomes impassable.
  void mark_volumes(const Environment& environment, double share) {
    dsw_environment_info info{};
    info.struct_size = sizeof info;
    ASSERT_EQ(dsw_environment_get_info(environment.get(), &info), DSW_STATUS_OK);
    for (uint32_t v = 0; v < info.volume_count; ++v) {
      const dsw_volume_id volume = {v, 1};
      if (between(0, 1) < share)
        dsw_environment_mark_volumes(environment.get(), &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr);
    }
  }

  /// A body of edges or of triangles, or false where it is not free.
  static bool add(const Scene& scene, const Points& at, const std::vector<uint32_t>& parts, bool of_faces,
                  uint32_t flags, double radius, dsw_body_id& body) {
    std::vector<uint32_t> offsets;
    for (uint32_t i = 0; 3 * i <= parts.size(); ++i) offsets.push_back(3 * i);
    dsw_body_desc desc;
    dsw_body_desc_init(&desc, sizeof desc);
    desc.flags = flags;
    desc.radius = radius;
    desc.level = of_faces ? DSW_LEVEL_FACES : DSW_LEVEL_EDGES_SWEPT;
    desc.positions = at[0].data();
    desc.vertex_count = at.size();
    if (of_faces) {
      desc.face_offsets = offsets.data();
      desc.face_corners = parts.data();
      desc.face_count = parts.size() / 3;
      desc.face_corner_count = parts.size();
    } else {
      desc.edges = parts.data();
      desc.edge_count = parts.size() / 2;
    }
    return dsw_body_create(scene.get(), &desc, &body) == DSW_STATUS_OK;
  }
  /// Two triangles at an edge, or a chain of two edges.
  bool add_random(const Scene& scene, bool of_faces, double size, dsw_body_id& body, double radius = 0) {
    Points at = {inside()};
    while (at.size() < (of_faces ? 4 : 3)) at.push_back(near(at[0], size));
    return add(scene, at, of_faces ? std::vector<uint32_t>{0, 1, 2, 0, 2, 3} : std::vector<uint32_t>{0, 1, 1, 2},
               of_faces, 0, radius, body);
  }

  static Points positions(const Scene& scene, dsw_body_id body) {
    Points at(64);
    size_t count = 0;
    EXPECT_EQ(dsw_body_get_positions(scene.get(), body, at[0].data(), at.size(), 0, nullptr, &count), DSW_STATUS_OK);
    at.resize(count);
    return at;
  }
  /// The vertices of a part of a body: of a face, else of an edge, else of a vertex.
  static Points part(const Scene& scene, dsw_body_id body, dsw_body_vertex_id vertex, dsw_body_edge_id edge,
                     dsw_body_face_id face) {
    const Points at = positions(scene, body);
    dsw_body_vertex_id ids[3] = {vertex};
    size_t count = 1;
    if (face.generation != 0) {
      EXPECT_EQ(dsw_body_get_face_corners(scene.get(), body, face, ids), DSW_STATUS_OK);
      count = 3;
    } else if (edge.generation != 0) {
      EXPECT_EQ(dsw_body_get_edge_ends(scene.get(), body, edge, ids), DSW_STATUS_OK);
      count = 2;
    }
    Points points;
    for (size_t i = 0; i < count; ++i) points.push_back(at[ids[i].index]);
    return points;
  }
  /// What touched, at the time of the touch.
  static Points moving_part(const dsw_body_contact& contact) {
    Points points = {to_vec(contact.position)};
    if (contact.edge.generation != 0 || contact.face.generation != 0) points.push_back(to_vec(contact.fixed[0]));
    if (contact.face.generation != 0) points.push_back(to_vec(contact.fixed[1]));
    return points;
  }
  static Points cell(const Environment& environment, const dsw_cell& cell) {
    dsw_vertex_id vertices[8];
    size_t count = 0;
    EXPECT_EQ(dsw_environment_copy_vertices(environment.get(), cell, vertices, 8, &count), DSW_STATUS_OK)
        << dsw_last_error_message();
    Points points(count);
    for (size_t i = 0; i < count; ++i) {
      EXPECT_EQ(dsw_environment_get_vertex_position(environment.get(), vertices[i], points[i].data()), DSW_STATUS_OK);
    }
    return points;
  }
  /// A vertex on a face, two edges, or a face on a vertex: only these have one normal.
  static bool has_one_normal(const Points& a, const Points& b) { return a.size() + b.size() == 4; }

  /// Moves one vertex of a body, or all of them; the contacts.
  std::vector<dsw_body_contact> push(const Scene& scene, dsw_body_id body, double size, bool all) {
    Points at = positions(scene, body);
    const uint32_t one = below(static_cast<uint32_t>(at.size()));
    for (uint32_t v = 0; v < at.size(); ++v) {
      if (all || v == one) at[v] = near(at[v], size);
    }
    dsw_move_options options;
    dsw_move_options_init(&options, sizeof options);
    options.order = &one;
    options.order_count = 1;
    EXPECT_EQ(dsw_body_move(scene.get(), body, at[0].data(), at.size(), 0, all ? nullptr : &options, nullptr),
              DSW_STATUS_OK)
        << dsw_last_error_message();
    const dsw_body_contact* contacts = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_body_get_contacts(scene.get(), body, &contacts, &count), DSW_STATUS_OK);
    return {contacts, contacts + count};
  }

  /// Asks of random bodies that touch marked edges or vertices; the outer boundary is left out.
  void ask_of_marked(const Environment& environment, bool of_faces, Figures& figures) {
    const Scene scene = scene_of(environment, 0);
    for (int i = 0; i < 60; ++i) {
      dsw_body_id body;
      if (!add_random(scene, of_faces || i % 2 == 0, 0.5, body)) continue;
      for (int step = 0; step < 6; ++step) {
        for (const dsw_body_contact& contact : push(scene, body, 0.8, true)) {
          if (contact.contact.wall.generation != 0) continue;
          const Points moving = moving_part(contact), marked = cell(environment, contact.contact.obstacle);
          if (has_one_normal(moving, marked))
            figures.ask(moving, marked, to_vec(contact.point), contact.contact.normal);
          else
            figures.leave_out();
        }
      }
    }
  }

  void judge(const char* name, const Figures& figures, size_t least) {
    std::printf("%-34s %s\n", name, figures.text().c_str());
    EXPECT_GE(figures.count(), least) << name;
    EXPECT_GE(figures.share(), kLeastShare) << name;
    EXPECT_LE(figures.quantile(0.99), kMostDegrees) << name;
    std::string key = name;  // for the benchmark
    std::replace(key.begin(), key.end(), ' ', '_');
    key.erase(std::remove(key.begin(), key.end(), ','), key.end());
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", figures.share());
    RecordProperty("contact.kinds." + key + ".share", text);
    std::snprintf(text, sizeof text, "%.6g", figures.quantile(0.99));
    RecordProperty("contact.kinds." + key + ".deg_p99", text);
  }

  std::vector<double> points_;
  std::mt19937_64 random_{7};
};

}  // namespace dsw::test
