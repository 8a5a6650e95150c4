// libccd's cross-check of normals that dsw_environment_cross_check is not asked about: of walls that move, body against body, a body
// against itself, thick bodies, near rows, marked edges and vertices, and of the plane, extruded. Both features are put together from what
// the reports say. Share and angle of each kind are printed, and have bars.
#include <algorithm>
#include <functional>

#include "../../effort.h"
#include "kinds.h"

namespace dsw::test {
namespace {

/// Rounds: each kind still meets as many contacts as `judge` wants.
int some_of(int rounds) { return std::max(rounds / 4, effort_of(rounds)); }

/// One vertex of the environment moves at a time, so that all others are where they were.
TEST_F(CrossCheckKinds, WallsThatMove) {
  Figures figures;
  for (int round = 0; round < 40; ++round) {
    const Environment environment = tetrahedra();
    mark_volumes(environment, 0.15);
    const Scene scene = scene_of(environment, DSW_FEATURE_DEFORMING);
    dsw_body_id body;
    for (int i = 0; i < 80; ++i) add_random(scene, i % 2 == 0, 0.3, body);
    std::vector<double> arrays[2] = {points_, points_};
    for (int step = 0; step < 60; ++step) {
      std::vector<double>& next = arrays[step % 2];
      const double* now = nullptr;
      size_t count = 0;
      ASSERT_EQ(dsw_environment_get_points(environment.get(), &now, &count), DSW_STATUS_OK);
      const std::vector<double> before(now, now + 3 * count);
      next = before;
      const size_t moved = below(static_cast<uint32_t>(count));
      for (size_t k = 0; k < 3; ++k) next[3 * moved + k] += between(-0.25, 0.25);
      dsw_deform_options options;
      dsw_deform_options_init(&options, sizeof options);
      options.response = DSW_WALL_HOLD;
      ASSERT_EQ(dsw_environment_deform(environment.get(), next.data(), count, &options, nullptr), DSW_STATUS_OK);
      const dsw_wall_contact* contacts = nullptr;
      ASSERT_EQ(dsw_environment_get_wall_contacts(environment.get(), &contacts, &count), DSW_STATUS_OK);
      for (size_t i = 0; i < count; ++i) {
        const dsw_wall_contact& c = contacts[i];
        Points wall = {{}};
        for (size_t k = 0; k < 3; ++k) wall[0][k] = c.from[k] + c.time * (c.to[k] - c.from[k]);
        for (const dsw_vertex_id& other : c.others) {
          if (other.generation != 0) wall.push_back(to_vec(&before[3 * other.index]));
        }
        const Points touched = part(scene, c.body, c.vertex, c.edge, c.face);
        if (has_one_normal(touched, wall))
          figures.ask(touched, wall, to_vec(c.point), c.contact.normal);
        else
          figures.leave_out();
      }
    }
  }
  judge("walls that move", figures, 300);
}

/// One vertex moves at a time, so that what it touches is where it was.
TEST_F(CrossCheckKinds, BodiesThatMeet) {
  Figures figures;
  for (int round = 0; round < some_of(30); ++round) {
    const Environment environment = tetrahedra();
    const Scene scene = scene_of(environment, DSW_FEATURE_BODY_CONTACTS);
    std::vector<dsw_body_id> bodies;
    for (int i = 0; i < 60; ++i) {
      dsw_body_id body;
      if (add_random(scene, i % 2 == 0, 0.7, body)) bodies.push_back(body);
    }
    for (int step = 0; step < 200; ++step) {
      const dsw_body_id body = bodies[below(static_cast<uint32_t>(bodies.size()))];
      const std::vector<dsw_body_contact> contacts = push(scene, body, 0.7, false);
      const dsw_contact_partner* partners = nullptr;
      size_t count = 0;
      ASSERT_EQ(dsw_body_get_contact_partners(scene.get(), body, &partners, &count), DSW_STATUS_OK);
      for (size_t i = 0; i < count; ++i) {
        if (partners[i].body.generation == 0) continue;
        const Points other = part(scene, partners[i].body, partners[i].vertex, partners[i].edge, partners[i].face);
        const Points moving = moving_part(contacts[i]);
        if (has_one_normal(moving, other))
          figures.ask(moving, other, to_vec(contacts[i].point), contacts[i].contact.normal);
        else
          figures.leave_out();
      }
    }
  }
  judge("body with body", figures, 300);
}

TEST_F(CrossCheckKinds, BodiesThatMeetThemselves) {
  Figures figures;
  for (int round = 0; round < some_of(200); ++round) {
    const Environment environment = tetrahedra();
    const Scene scene = scene_of(environment, DSW_FEATURE_BODY_CONTACTS);
    Points at;
    std::vector<uint32_t> parts;
    const bool of_faces = round % 2 == 0;
    const uint32_t corners = of_faces ? 3 : 2;
    for (uint32_t i = 0; i < 8; ++i) {
      at.push_back({between(1, 2), between(1, 2), between(1, 2)});
      for (uint32_t k = 0; k < corners; ++k) {
        if (k > 0) at.push_back(near(at[corners * i], 0.4));
        parts.push_back(corners * i + k);
      }
    }
    dsw_body_id body;
    if (!add(scene, at, parts, of_faces, DSW_BODY_SELF_CONTACTS, 0, body)) continue;
    for (int step = 0; step < 60; ++step) {
      for (const dsw_body_contact& contact : push(scene, body, 0.6, false)) {
        const dsw_contact_partner* partners = nullptr;
        size_t count = 0;
        ASSERT_EQ(dsw_body_get_contact_partners(scene.get(), body, &partners, &count), DSW_STATUS_OK);
        if (count != 1 || partners[0].body.generation == 0) continue;
        const Points other = part(scene, body, partners[0].vertex, partners[0].edge, partners[0].face),
                     moving = moving_part(contact);
        if (has_one_normal(moving, other))
          figures.ask(moving, other, to_vec(contact.point), contact.contact.normal);
        else
          figures.leave_out();
      }
    }
  }
  judge("self", figures, 300);
}

/// The axis touches where it is drawn to the wall by the radius.
TEST_F(CrossCheckKinds, ThickBodies) {
  Figures figures;
  constexpr double kRadius = 0.05;
  for (int round = 0; round < some_of(30); ++round) {
    const Environment environment = tetrahedra();
    mark_volumes(environment, 0.1);
    const Scene scene = scene_of(environment, 0);
    for (int i = 0; i < 60; ++i) {
      dsw_body_id body;
      if (!add_random(scene, i % 2 == 0, 0.5, body, kRadius)) continue;
      for (int step = 0; step < 4; ++step) {
        for (const dsw_body_contact& contact : push(scene, body, 0.8, true)) {
          Points moving = moving_part(contact);
          const Points wall = cell(environment, contact.contact.obstacle);
          if (!has_one_normal(moving, wall)) {
            figures.leave_out();
            continue;
          }
          for (Vec& p : moving) p = along(p, contact.contact.normal, -kRadius);
          figures.ask(moving, wall, along(to_vec(contact.point), contact.contact.normal, -kRadius),
                      contact.contact.normal);
        }
      }
    }
  }
  judge("thick bodies", figures, 300);
}

TEST_F(CrossCheckKinds, NearRows) {
  Figures figures;
  for (int round = 0; round < 20; ++round) {
    const Environment environment = tetrahedra();
    mark_volumes(environment, 0.1);
    const Scene scene = scene_of(environment, DSW_FEATURE_BODY_CONTACTS);
    for (int i = 0; i < 30; ++i) {
      dsw_body_id body;
      if (!add_random(scene, i % 2 == 0, 0.5, body)) continue;
      dsw_near_options options;
      dsw_near_options_init(&options, sizeof options);
      options.margin = 0.3;
      size_t count = 0;
      ASSERT_EQ(dsw_body_find_near_rows(scene.get(), body, &options, &count), DSW_STATUS_OK);
      const dsw_near_row* rows = nullptr;
      ASSERT_EQ(dsw_body_get_near_rows(scene.get(), body, &rows, &count), DSW_STATUS_OK);
      const Points at = positions(scene, body);
      for (size_t r = 0; r < count; ++r) {
        const Points others = rows[r].body.generation != 0 ? positions(scene, rows[r].body) : Points();
        Points own, obstacle;
        for (int k = 0; k < 3; ++k) {
          if (rows[r].vertices[k] != UINT32_MAX)
            own.push_back(along(at[rows[r].vertices[k]], rows[r].normal, -rows[r].distance));
          const uint32_t v = rows[r].obstacle_vertices[k];
          if (v != UINT32_MAX) obstacle.push_back(others.empty() ? to_vec(&points_[3 * v]) : others[v]);
        }
        if (has_one_normal(own, obstacle))
          figures.ask(own, obstacle, to_vec(rows[r].obstacle_point), rows[r].normal);
        else
          figures.leave_out();
      }
    }
  }
  judge("near rows", figures, 300);
}

TEST_F(CrossCheckKinds, MarkedEdges) {
  Figures figures;
  for (int round = 0; round < 6; ++round) {
    const Environment environment = tetrahedra();
    for (uint32_t v = 0; v < 6 * kSide * kSide * kSide; ++v) {
      dsw_edge_id edge;
      ASSERT_EQ(dsw_environment_get_edge_id(environment.get(), {v, 1}, below(6), &edge), DSW_STATUS_OK);
      ASSERT_EQ(dsw_environment_mark_edges(environment.get(), &edge, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    }
    ask_of_marked(environment, false, figures);
  }
  judge("marked edges", figures, 300);
}

/// Only faces meet a marked vertex.
TEST_F(CrossCheckKinds, MarkedVertices) {
  Figures figures;
  for (int round = 0; round < 20; ++round) {
    const Environment environment = tetrahedra();
    for (uint32_t v = 0; v < points_.size() / 3; ++v) {
      const dsw_vertex_id vertex = {v, 1};
      ASSERT_EQ(dsw_environment_mark_vertices(environment.get(), &vertex, 1, DSW_MARK_IMPASSABLE), DSW_STATUS_OK);
    }
    ask_of_marked(environment, true, figures);
  }
  judge("marked vertices", figures, 100);
}

/// Corners of the plane become edges along z, sides become rectangles.
Points extruded(const Points& flat) {
  Points points;
  for (const Vec& p : flat) {
    points.push_back({p[0], p[1], -1});
    points.push_back({p[0], p[1], 1});
  }
  return points;
}

constexpr uint32_t kCells = 6;

/// Squares of two triangles each; inner vertices are off the grid by `off`.
dsw_environment_desc triangles_desc(std::vector<double>& points, std::vector<int64_t>& cells,
                                    const std::function<double()>& off) {
  for (uint32_t i = 0; i < (kCells + 1) * (kCells + 1); ++i) {
    for (const uint32_t at : {i % (kCells + 1), i / (kCells + 1)})
      points.push_back(at + (at == 0 || at == kCells ? 0 : off()));
  }
  for (uint32_t i = 0; i < kCells * kCells; ++i) {
    const int64_t a = i % kCells + (kCells + 1) * int64_t{i / kCells};
    cells.insert(cells.end(), {a, a + 1, a + kCells + 2, a, a + kCells + 2, a + kCells + 1});
  }
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.dimension = 2;
  desc.points = points.data();
  desc.point_count = points.size() / 2;
  desc.uniform_cell_type = DSW_CELL_TYPE_TRIANGLE;
  desc.volume_count = cells.size() / 3;
  desc.connectivity = cells.data();
  desc.connectivity_count = cells.size();
  return desc;
}

void ask_in_plane(const Environment& environment, const std::vector<double>& points, const dsw_body_contact& contact,
                  Figures& figures) {
  Points moving = {{contact.position[0], contact.position[1], 0}}, wall;
  if (contact.edge.generation != 0) moving.push_back({contact.fixed[0][0], contact.fixed[0][1], 0});
  dsw_vertex_id ids[8];
  size_t corners = 0;
  ASSERT_EQ(dsw_environment_copy_vertices(environment.get(), contact.contact.obstacle, ids, 8, &corners),
            DSW_STATUS_OK);
  for (size_t k = 0; k < corners; ++k) wall.push_back({points[2 * ids[k].index], points[2 * ids[k].index + 1], 0});
  const double normal[3] = {contact.contact.normal[0], contact.contact.normal[1], 0};
  if (moving.size() + wall.size() != 3) {
    figures.leave_out();
  } else {
    figures.ask(moving.size() == 1 ? moving : extruded(moving), extruded(wall), {contact.point[0], contact.point[1], 0},
                normal);
  }
}

TEST_F(CrossCheckKinds, ThePlaneExtruded) {
  static constexpr uint32_t kEdges[4] = {0, 1, 1, 2};
  Figures figures;
  for (int round = 0; round < some_of(10); ++round) {
    std::vector<double> points;
    std::vector<int64_t> cells;
    const Environment environment = create(triangles_desc(points, cells, [this] { return between(-0.2, 0.2); }));
    mark_volumes(environment, 0.1);
    const Scene scene = scene_of(environment, 0);
    for (int i = 0; i < 60; ++i) {
      double at[6];
      for (int k = 0; k < 6; ++k) at[k] = k < 2 ? between(0.1, kCells - 0.1) : at[k % 2] + between(-0.6, 0.6);
      dsw_body_desc desc;
      dsw_body_desc_init(&desc, sizeof desc);
      desc.positions = at;
      desc.vertex_count = 3;
      desc.edges = kEdges;
      desc.edge_count = 2;
      dsw_body_id body;
      if (dsw_body_create(scene.get(), &desc, &body) != DSW_STATUS_OK) continue;
      for (int step = 0; step < 6; ++step) {
        size_t count = 0;
        ASSERT_EQ(dsw_body_get_positions(scene.get(), body, at, 3, 0, nullptr, &count), DSW_STATUS_OK);
        for (double& x : at) x += between(-0.8, 0.8);
        ASSERT_EQ(dsw_body_move(scene.get(), body, at, 3, 0, nullptr, nullptr), DSW_STATUS_OK);
        const dsw_body_contact* contacts = nullptr;
        ASSERT_EQ(dsw_body_get_contacts(scene.get(), body, &contacts, &count), DSW_STATUS_OK);
        for (size_t c = 0; c < count; ++c) ask_in_plane(environment, points, contacts[c], figures);
      }
    }
  }
  judge("the plane, extruded", figures, 300);
}

/// A normal that is turned by a known angle is told by that angle, or has no answer: the bars mean something.
TEST_F(CrossCheckKinds, AWrongNormalIsNoticed) {
  Figures right, wrong;
  for (int i = 0; i < 1000; ++i) {
    const Points triangle = {near({0, 0, 0}, 1), near({1, 0, 0}, 0.3), near({0, 1, 0}, 0.3)};
    Vec u, v, point;
    for (size_t k = 0; k < 3; ++k) u[k] = triangle[1][k] - triangle[0][k], v[k] = triangle[2][k] - triangle[0][k];
    double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]),
                 side = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (size_t k = 0; k < 3; ++k)
      n[k] /= length, u[k] /= side, point[k] = (triangle[0][k] + triangle[1][k] + triangle[2][k]) / 3;
    right.ask({point}, triangle, point, n);
    const double angle = 0.02 / (180 / 3.14159265358979323846);
    double turned[3];
    for (size_t k = 0; k < 3; ++k) turned[k] = std::cos(angle) * n[k] + std::sin(angle) * u[k];
    wrong.ask({point}, triangle, point, turned);
  }
  EXPECT_GT(right.share(), 0.99);
  EXPECT_LT(right.quantile(1), 1e-4);
  EXPECT_GT(wrong.share(), 0.9);
  EXPECT_NEAR(wrong.quantile(0.01), 0.02, 1e-4);
  EXPECT_NEAR(wrong.quantile(0.99), 0.02, 1e-4);
}

}  // namespace
}  // namespace dsw::test
