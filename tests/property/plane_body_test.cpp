// Bodies in a triangulation of the plane do what they do between walls that stand on it: in a layer of prisms, at one
// height, to the bit.

#include "support.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace {

using namespace dsw::oracle;

constexpr uint32_t kSide = 6;       // squares along the layer's sides
constexpr double kHeight = 0x1p-5;  // of the layer: less than any coordinate in the plane
constexpr double kLevel = kHeight / 2;

/// Points and triangles of the plane.
struct Floor {
  std::vector<double> points;
  std::vector<int32_t> corners;
  size_t count() const { return points.size() / 2; }
};

Floor make_floor(Rng& rng) {
  Floor floor;
  for (uint32_t y = 0; y <= kSide; ++y) {
    for (uint32_t x = 0; x <= kSide; ++x) {
      const double jitter = x == 0 || y == 0 || x == kSide || y == kSide ? 0 : 0.3;
      floor.points.insert(floor.points.end(), {1 + x + rng.range(-jitter, jitter), 1 + y + rng.range(-jitter, jitter)});
    }
  }
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      const auto a = static_cast<int32_t>(x + (kSide + 1) * y), b = a + 1;
      const auto d = a + static_cast<int32_t>(kSide) + 1, c = d + 1;
      floor.corners.insert(floor.corners.end(), {a, b, c, a, c, d});
    }
  }
  return floor;
}

EnvironmentPtr make_plane(const Floor& floor) {
  return create_from(uniform_desc(2, DSW_CELL_TYPE_TRIANGLE, 3, floor.points, floor.corners));
}

/// Cell i stands on triangle i, vertex i + count above vertex i.
EnvironmentPtr make_layer(const Floor& floor) {
  std::vector<double> points;
  std::vector<int32_t> corners;
  for (const double z : {0.0, kHeight}) {
    for (size_t i = 0; i < floor.count(); ++i) {
      points.insert(points.end(), {floor.points[2 * i], floor.points[2 * i + 1], z});
    }
  }
  const auto up = static_cast<int32_t>(floor.count());
  for (size_t i = 0; i < floor.corners.size(); i += 3) {
    const int32_t* const c = floor.corners.data() + i;
    corners.insert(corners.end(), {c[0] + up, c[1] + up, c[2] + up, c[0], c[1], c[2]});
  }
  return create_from(uniform_desc(3, DSW_CELL_TYPE_WEDGE, 6, points, corners));
}

/// A scene in the plane, or in the layer over it.
struct Side {
  int dimension;
  EnvironmentPtr environment;
  ScenePtr scene;
  std::vector<dsw_body_id> bodies;

  Side(int d, const Floor& floor, uint32_t features)
      : dimension(d),
        environment(d == 2 ? make_plane(floor) : make_layer(floor)),
        scene(make_scene(environment.get(), features)) {}

  /// Points of the plane where this side has them.
  std::vector<double> placed(const std::vector<double>& flat) const {
    if (dimension == 2) return flat;
    std::vector<double> out;
    for (size_t i = 0; i < flat.size(); i += 2) out.insert(out.end(), {flat[i], flat[i + 1], kLevel});
    return out;
  }
  dsw_status create(const std::vector<double>& flat, const std::vector<uint32_t>& edges, dsw_level level,
                    uint32_t flags, dsw_body_id* body) const {
    const std::vector<double> points = placed(flat);
    dsw_body_desc desc = defaults(dsw_body_desc_init);
    desc.level = level;
    desc.flags = flags;
    desc.positions = points.data();
    desc.vertex_count = flat.size() / 2;
    desc.edges = edges.data();
    desc.edge_count = edges.size() / 2;
    return dsw_body_create(scene.get(), &desc, body);
  }
  /// In the plane, and in which cells.
  std::vector<double> positions(dsw_body_id body) const {
    size_t count = 0;
    dsw_body_get_positions(scene.get(), body, nullptr, 0, 0, nullptr, &count);
    std::vector<double> all(static_cast<size_t>(dimension) * count), flat;
    std::vector<dsw_volume_id> volumes(count);
    EXPECT_EQ(dsw_body_get_positions(scene.get(), body, all.data(), count, 0, volumes.data(), &count), DSW_STATUS_OK);
    for (size_t i = 0; i < count; ++i) {
      const double* const p = all.data() + static_cast<size_t>(dimension) * i;
      flat.insert(flat.end(), {p[0], p[1], static_cast<double>(volumes[i].index)});
      EXPECT_TRUE(dimension == 2 || volumes[i].generation == 0 || p[2] == kLevel);
    }
    return flat;
  }
};

/// What was touched: the vertex under a wall's edge, or the side under a face, by its vertices.
std::vector<uint32_t> foot(const Side& side, const dsw_cell& cell, size_t floor_count) {
  dsw_vertex_id vertices[8];
  size_t count = 1;
  if (cell.kind == DSW_CELL_VERTEX) {
    vertices[0].index = cell.index;
  } else {
    EXPECT_EQ(dsw_environment_copy_vertices(side.environment.get(), cell, vertices, 8, &count), DSW_STATUS_OK);
  }
  std::vector<uint32_t> found;
  for (size_t i = 0; i < count; ++i) found.push_back(vertices[i].index % static_cast<uint32_t>(floor_count));
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// In the layer walls have edges where the plane has vertices.
int flattened(int kind) { return kind == DSW_CELL_EDGE ? static_cast<int>(DSW_CELL_VERTEX) : kind; }
int flattened_contact(int kind) { return kind == DSW_CONTACT_EDGE ? static_cast<int>(DSW_CONTACT_VERTEX) : kind; }

class PlaneBodies : public testing::TestWithParam<int> {
 protected:
  void run();

  void begin(uint32_t features) {
    sides_.clear();
    floor_ = make_floor(rng_);
    for (const int d : {2, 3}) sides_.emplace_back(d, floor_, features);
  }

  /// A polyline or a closed curve somewhere, of short edges or long ones.
  void add_body(dsw_level level, uint32_t flags) {
    const size_t count = 1 + rng_.below(6u);
    std::vector<double> flat;
    double x = rng_.range(1.2, kSide + 0.8), y = rng_.range(1.2, kSide + 0.8);
    const double step = rng_.chance(0.5) ? 0.4 : 2.5;
    for (size_t i = 0; i < count; ++i) {
      flat.insert(flat.end(), {x, y});
      x = std::min(std::max(x + rng_.range(-step, step), 1.1), kSide + 0.9);
      y = std::min(std::max(y + rng_.range(-step, step), 1.1), kSide + 0.9);
    }
    std::vector<uint32_t> edges;
    for (uint32_t i = 0; i + 1 < count; ++i) edges.insert(edges.end(), {i, i + 1});
    if (count > 2 && rng_.chance(0.5)) edges.insert(edges.end(), {static_cast<uint32_t>(count) - 1, 0});
    both([&](Side& side, int* status) {
      dsw_body_id body;
      *status = side.create(flat, edges, level, flags, &body);
      if (*status == DSW_STATUS_OK) side.bodies.push_back(body);
    });
  }

  /// Both sides go on from where the body is in the plane.
  void join(size_t b, dsw_level level, uint32_t flags) {
    const std::vector<double> at = sides_[0].positions(sides_[0].bodies[b]);
    std::vector<uint32_t> edges(at.size()), kept, number(at.size() / 3);
    std::vector<double> flat;
    size_t count = 0;
    ASSERT_EQ(
        dsw_body_get_edge_indices(sides_[0].scene.get(), sides_[0].bodies[b], edges.data(), edges.size() / 2, &count),
        DSW_STATUS_OK);
    for (size_t i = 0; i < at.size(); i += 3) {
      number[i / 3] = static_cast<uint32_t>(flat.size() / 2);
      if (at[i] != 0) flat.insert(flat.end(), {at[i], at[i + 1]});
    }
    for (size_t e = 0; e < 2 * count; ++e) {
      if (edges[e] != UINT32_MAX) kept.push_back(number[edges[e]]);
    }
    both([&](Side& side, int* status) {
      dsw_body_destroy(side.scene.get(), side.bodies[b]);
      *status = side.create(flat, kept, level, flags, &side.bodies[b]);
      EXPECT_EQ(*status, DSW_STATUS_OK) << dsw_last_error_message();
    });
    parted_ = false;
    ++partings_;
  }

  void mark_something() {
    const uint32_t cell = rng_.below(floor_.corners.size() / 3), corner = rng_.below(3u);
    const auto a = static_cast<uint32_t>(floor_.corners[3 * cell + corner]);
    const auto b = static_cast<uint32_t>(floor_.corners[3 * cell + (corner + 1) % 3]);
    const auto up = static_cast<uint32_t>(floor_.count());
    const uint32_t what = rng_.below(3u);
    const dsw_mark mark = rng_.chance(0.3) ? DSW_MARK_PASSABLE : DSW_MARK_IMPASSABLE;
    const uint32_t flags = rng_.chance(0.5) ? uint32_t{DSW_MARK_SKIP_OCCUPIED} : 0u;
    std::vector<dsw_volume_id> volumes;
    for (int i = rng_.between(1, 4); i > 0; --i) volumes.push_back({rng_.below(floor_.corners.size() / 3), 1});
    both([&](Side& side, int* status) {
      dsw_environment* const environment = side.environment.get();
      if (what == 0) {
        size_t skipped = 0;
        *status = dsw_environment_mark_volumes(environment, volumes.data(), volumes.size(), mark, flags, &skipped);
        if (*status == DSW_STATUS_OK) *status = -static_cast<int>(skipped);
      } else if (what == 1) {
        const size_t offsets[] = {0, side.dimension == 2 ? 2u : 4u};
        const uint32_t around[] = {a, b, b + up, a + up};
        dsw_face_id face;
        EXPECT_EQ(dsw_environment_find_faces(environment, 1, offsets, around, &face, nullptr), DSW_STATUS_OK);
        *status = dsw_environment_mark_faces(environment, &face, 1, mark);
      } else if (side.dimension == 2) {
        const dsw_vertex_id vertex{a, 1};
        *status = dsw_environment_mark_vertices(environment, &vertex, 1, mark);
      } else {
        const uint32_t ends[] = {a, a + up};
        dsw_edge_id edge;
        EXPECT_EQ(dsw_environment_find_edges(environment, 1, ends, &edge, nullptr), DSW_STATUS_OK);
        *status = dsw_environment_mark_edges(environment, &edge, 1, mark);
      }
    });
    const dsw_body_id* occupants[2];
    size_t counts[2];
    for (size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(dsw_scene_get_occupant_bodies(sides_[k].scene.get(), &occupants[k], &counts[k]), DSW_STATUS_OK);
    }
    ASSERT_EQ(counts[0], counts[1]);
    for (size_t i = 0; i < counts[0]; ++i) EXPECT_EQ(occupants[0][i].index, occupants[1][i].index);
  }

  void edit(size_t b) {
    size_t count = 0;
    std::vector<dsw_body_vertex_id> vertices(1 << 15);
    std::vector<dsw_body_edge_id> edges(1 << 15);
    const Side& flat = sides_[0];
    ASSERT_EQ(dsw_body_get_vertex_ids(flat.scene.get(), flat.bodies[b], vertices.data(), 1 << 15, &count),
              DSW_STATUS_OK);
    const dsw_body_vertex_id v = vertices[rng_.below(count)], w = vertices[rng_.below(count)];
    ASSERT_EQ(dsw_body_get_edge_ids(flat.scene.get(), flat.bodies[b], edges.data(), 1 << 15, &count), DSW_STATUS_OK);
    const dsw_body_edge_id e = edges[count == 0 ? 0 : rng_.below(count)];
    const uint32_t what = rng_.below(4u), end = rng_.below(2u);
    const double share = rng_.unit();
    dsw_body_edit done[2] = {};
    both([&](Side& side, int* status) {
      dsw_scene* const scene = side.scene.get();
      const dsw_body_id body = side.bodies[b];
      dsw_body_edit* const edit = &done[side.dimension - 2];
      dsw_body_vertex_id ends[2];
      dsw_body_edge_id made;
      if (what == 0) *status = dsw_body_split_edge(scene, body, e, share, edit);
      if (what == 1) *status = dsw_body_add_edge(scene, body, v, w, &made);
      if (what == 2) *status = count > 4 ? dsw_body_remove_edge(scene, body, e) : DSW_STATUS_OK;
      if (what == 3) {
        *status = dsw_body_get_edge_ends(scene, body, e, ends);
        if (*status == DSW_STATUS_OK) *status = dsw_body_collapse_edge(scene, body, e, ends[end], edit);
      }
    });
    EXPECT_EQ(std::memcmp(&done[0], &done[1], sizeof done[0]), 0);
  }

  dsw_move_options random_options() {
    dsw_move_options o = defaults(dsw_move_options_init);
    o.vertex_response = rng_.chance(0.5) ? DSW_RESPONSE_SLIDE : DSW_RESPONSE_STOP;
    o.edge_response = static_cast<dsw_response>(rng_.below(6u));
    o.search = static_cast<dsw_search>(rng_.below(3u));
    o.min_part = 0.05;
    o.min_length = 0.05;
    o.stand_off = rng_.chance(0.5) ? -1 : 1e-6;
    o.noise_share = rng_.chance(0.5) ? 1e-3 : 0;
    return o;
  }

  void move(size_t b) {
    const std::vector<double> at = sides_[0].positions(sides_[0].bodies[b]);
    std::vector<double> targets;
    const double step = rng_.chance(0.5) ? 0.3 : 3, dx = rng_.range(-step, step), dy = rng_.range(-step, step);
    for (size_t i = 0; i < at.size(); i += 3) {
      const double wobble = rng_.chance(0.5) ? 0 : step / 2;
      targets.push_back(at[i] + dx + rng_.range(-wobble, wobble));
      targets.push_back(at[i + 1] + dy + rng_.range(-wobble, wobble));
    }
    const dsw_move_options o = random_options();
    uses_normals_ = o.vertex_response != DSW_RESPONSE_STOP || o.edge_response != DSW_RESPONSE_STOP || o.stand_off >= 0;
    both([&](Side& side, int* status) {
      const std::vector<double> points = side.placed(targets);
      const size_t count = targets.size() / 2;
      *status =
          dsw_body_move(side.scene.get(), side.bodies[b], points.data(), count, 0, &o, &reports_[side.dimension - 2]);
    });
    compare_reports(b);
  }

  void turn(size_t b) {
    dsw_rigid_motion motion{};
    uses_normals_ = false;
    motion.rotation[2] = rng_.range(-1, 1);
    motion.rotation[3] = 1;
    motion.centre[0] = rng_.range(1, kSide + 1);
    motion.centre[1] = rng_.range(1, kSide + 1);
    motion.translation[0] = rng_.range(-0.5, 0.5);
    both([&](Side& side, int* status) {
      *status = dsw_body_move_rigid(side.scene.get(), side.bodies[b], &motion, nullptr, &reports_[side.dimension - 2]);
    });
    compare_reports(b);
  }

  void compare_reports(size_t b) {
    const dsw_move_report &flat = reports_[0], &tall = reports_[1];
    EXPECT_EQ(flat.fraction, tall.fraction);
    EXPECT_EQ(flat.vertices_moved, tall.vertices_moved);
    const dsw_body_contact* contacts[2];
    const dsw_body_edit* edits[2];
    size_t contact_counts[2], edit_counts[2];
    for (size_t k = 0; k < 2; ++k) {
      dsw_scene* const scene = sides_[k].scene.get();
      ASSERT_EQ(dsw_body_get_contacts(scene, sides_[k].bodies[b], &contacts[k], &contact_counts[k]), DSW_STATUS_OK);
      ASSERT_EQ(dsw_body_get_edits(scene, sides_[k].bodies[b], &edits[k], &edit_counts[k]), DSW_STATUS_OK);
    }
    for (size_t i = 0; i < std::min(contact_counts[0], contact_counts[1]); ++i) {
      compare_contacts(contacts[0][i], contacts[1][i]);
      if (parted_) return;
    }
    ASSERT_EQ(contact_counts[0], contact_counts[1]);
    EXPECT_EQ(flat.vertices_stopped, tall.vertices_stopped);
    ASSERT_EQ(edit_counts[0], edit_counts[1]);
    EXPECT_EQ(std::memcmp(edits[0], edits[1], edit_counts[0] * sizeof(dsw_body_edit)), 0);
    contacts_ += contact_counts[0];
    edits_ += edit_counts[0];
  }

  void compare_contacts(const dsw_body_contact& flat, const dsw_body_contact& tall) {
    EXPECT_EQ(flat.time, tall.time);
    EXPECT_EQ(flat.contact.kind, flattened_contact(tall.contact.kind));
    // At a vertex the plane names the lowest wall there, an edge in space one that the moving end looks at.
    const bool chosen = flat.contact.kind == DSW_CONTACT_VERTEX && flat.contact.wall.generation != 0;
    EXPECT_TRUE(chosen || flat.contact.marked_kind == flattened(tall.contact.marked_kind));
    EXPECT_EQ(flat.vertex.index, tall.vertex.index);
    EXPECT_EQ(flat.edge.index, tall.edge.index);
    EXPECT_EQ(flat.edge.generation, tall.edge.generation);
    EXPECT_EQ(flat.contact.obstacle.kind, flattened(tall.contact.obstacle.kind));
    EXPECT_EQ(foot(sides_[0], flat.contact.obstacle, floor_.count()),
              foot(sides_[1], tall.contact.obstacle, floor_.count()));
    EXPECT_EQ(flat.contact.wall.generation, tall.contact.wall.generation);
    EXPECT_EQ(flat.history, tall.history);
    EXPECT_EQ(flat.distance_left, tall.distance_left);
    for (size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(flat.from[k], tall.from[k]);
      EXPECT_EQ(flat.to[k], tall.to[k]);
      EXPECT_EQ(flat.fixed[0][k], tall.fixed[0][k]);
      EXPECT_EQ(flat.position[k], tall.position[k]);
      EXPECT_NEAR(flat.point[k], tall.point[k], 1e-12);
    }
    compare_normals(flat, tall);
    EXPECT_EQ(flat.point[2], 0);
    EXPECT_EQ(flat.contact.normal[2], 0);
    EXPECT_EQ(flat.fixed[1][0], 0);
    EXPECT_NEAR(flat.edge_parameter, tall.edge_parameter, 1e-9);
  }

  /// On which side of an edge that moves along itself, but for a little, an obstacle is, is what rounding makes of it,
  /// and so is the normal of an edge that is hardly there. Where they differ by a bit, what slides goes elsewhere.
  void compare_normals(const dsw_body_contact& flat, const dsw_body_contact& tall) {
    const double *const a = flat.contact.normal, *const b = tall.contact.normal;
    parted_ = uses_normals_ && std::memcmp(a, b, 2 * sizeof(double)) != 0;
    if (std::hypot(flat.fixed[0][0] - flat.point[0], flat.fixed[0][1] - flat.point[1]) < 1e-6) return;
    const double sign = a[0] * b[0] + a[1] * b[1] < 0 ? -1 : 1;
    for (size_t k = 0; k < 2; ++k) EXPECT_NEAR(a[k], sign * b[k], 1e-9);
  }

  /// What a level covers is free: raising it again finds nothing.
  void check_free(size_t b) {
    dsw_scene* const scene = sides_[0].scene.get();
    const dsw_body_id body = sides_[0].bodies[b];
    dsw_level level;
    ASSERT_EQ(dsw_body_get_level(scene, body, &level), DSW_STATUS_OK);
    ASSERT_EQ(dsw_body_set_level(scene, body, DSW_LEVEL_POINTS), DSW_STATUS_OK);
    ASSERT_EQ(dsw_body_set_level(scene, body, level), DSW_STATUS_OK) << dsw_last_error_message();
  }

  /// Does something on both sides, which has to answer the same.
  template <class Do>
  void both(const Do& what) {
    int status[2] = {-1, -1};
    for (size_t k = 0; k < 2; ++k) what(sides_[k], &status[k]);
    EXPECT_EQ(status[0], status[1]) << dsw_last_error_message();
  }

  Rng rng_{static_cast<uint64_t>(GetParam())};
  Floor floor_;
  std::vector<Side> sides_;
  dsw_move_report reports_[2];
  size_t contacts_ = 0, edits_ = 0;
  bool uses_normals_ = false, parted_ = false;
  size_t partings_ = 0;
};

void PlaneBodies::run() {
  begin(GetParam() % 2 == 0 ? 0 : DSW_FEATURE_LIVE_CHANGES);
  const auto level = static_cast<dsw_level>(DSW_LEVEL_POINTS + GetParam() % 3);
  const uint32_t flags =
      GetParam() % 4 < 2 ? 0 : DSW_BODY_SEQUENCES | DSW_BODY_SKIP_BY_ENVIRONMENT | DSW_BODY_SKIP_BY_CLEARANCE;
  for (int i = 0; i < 25; ++i) mark_something();
  for (int i = 0; i < 12; ++i) add_body(level, flags);
  ASSERT_EQ(sides_[0].bodies.size(), sides_[1].bodies.size());
  if (sides_[0].bodies.empty()) return;
  for (int step = 0; step < 200 && !HasFailure(); ++step) {
    SCOPED_TRACE(step);
    if (rng_.chance(0.2)) mark_something();
    const size_t b = rng_.below(sides_[0].bodies.size());
    if (rng_.chance(0.2)) edit(b);
    rng_.chance(0.15) ? turn(b) : move(b);
    check_free(b);
    if (parted_) join(b, level, flags);
    EXPECT_EQ(sides_[0].positions(sides_[0].bodies[b]), sides_[1].positions(sides_[1].bodies[b]));
  }
}

// A scene ends before its bodies have many thousands of vertices: responses insert them.
TEST_P(PlaneBodies, DoWhatTheyDoBetweenWallsInSpace) {
  for (int scene = 0; scene < at_least(1) && !HasFailure(); ++scene) {
    SCOPED_TRACE("scene " + std::to_string(scene));
    run();
  }
  RecordProperty("partings", static_cast<int>(partings_));
  RecordProperty("contacts", static_cast<int>(contacts_));
  RecordProperty("edits", static_cast<int>(edits_));
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlaneBodies, testing::Range(0, std::min(24, effort_of(8 * 24))));

}  // namespace
