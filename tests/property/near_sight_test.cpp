// What hides what from a body: rows beside exact arithmetic where edges lie on rims and vertices of walls, far from the
// origin, at any scale, at closed slits, and after moves, cuts and tears. Properties say how many rows there were.
#include "near_check.h"
#include "plane_support.h"

namespace dsw::oracle {
namespace {

/// On a wall: a vertex, a place on a side, or one inside.
Vec place_on(const NearTruth::Scene& scene, Rng& rng) {
  const NearTruth::Ids& wall = scene.walls[rng.below(scene.walls.size())];
  const auto corner = [&](size_t i) { return scene.points[static_cast<size_t>(wall[i])]; };
  const size_t first = rng.below(wall.size());
  const auto share = [&] { return rng.chance(0.5) ? 0.25 * static_cast<double>(rng.below(5)) : rng.range(0, 1); };
  const Vec on_side = between(corner(first), corner((first + 1) % wall.size()), rng.chance(0.3) ? 0 : share());
  return rng.chance(0.8) ? on_side : between(on_side, corner((first + 2) % wall.size()), share());
}

/// In any direction, or in one of a lattice.
Vec beside(const Vec& at, double way, int dimension, Rng& rng) {
  const bool is_lattice = rng.chance(0.4);
  Vec to = at;
  for (size_t k = 0; k < static_cast<size_t>(dimension); ++k) {
    to[k] += way * (is_lattice ? 0.5 * static_cast<double>(rng.below(5)) - 1 : rng.range(-1, 1));
  }
  return to;
}

/// A vertex, an edge or a face that touches a wall, up to rounding or nearly.
BodyPlan touching_plan(const NearTruth::Scene& scene, double size, Rng& rng) {
  const Vec at = place_on(scene, rng);
  const double way = size * std::pow(10, rng.range(-2.5, -0.5));
  BodyPlan plan;
  plan.at.push_back(rng.chance(0.2) ? at : beside(at, rng.chance(0.2) ? 1e-9 * way : way, scene.dimension, rng));
  if (rng.chance(0.15)) return plan;
  plan.at.push_back(between(at, plan.at[0], -rng.range(0.2, 1.7)));
  if (scene.dimension == 2 || rng.chance(0.7)) {
    plan.edges.push_back({0, 1});
  } else {
    plan.at.push_back(beside(at, way, scene.dimension, rng));
    plan.faces.push_back({0, 1, 2});
  }
  return plan;
}

dsw_status create_in_plane(dsw_scene* scene, const BodyPlan& plan, dsw_level level, dsw_body_id* body) {
  std::vector<double> at;
  std::vector<uint32_t> edges;
  for (const Vec& p : plan.at) at.insert(at.end(), {p[0], p[1]});
  for (const auto& e : plan.edges)
    edges.insert(edges.end(), {static_cast<uint32_t>(e[0]), static_cast<uint32_t>(e[1])});
  dsw_body_desc desc = defaults(dsw_body_desc_init);
  desc.positions = at.data();
  desc.vertex_count = plan.at.size();
  desc.edges = edges.data();
  desc.edge_count = plan.edges.size();
  desc.level = level;
  return dsw_body_create(scene, &desc, body);
}

/// Where a body of a plan is now.
BodyState state_of(const dsw_scene* scene, dsw_body_id body, const BodyPlan& plan, int dimension) {
  BodyState state;
  if (dimension == 3) {
    EXPECT_EQ(read_body(scene, body, state), "");
    return state;
  }
  std::vector<double> at(2 * plan.at.size());
  size_t count = 0;
  EXPECT_EQ(dsw_body_get_positions(scene, body, at.data(), plan.at.size(), 0, nullptr, &count), DSW_STATUS_OK);
  for (size_t i = 0; i < count; ++i) state.at.push_back({at[2 * i], at[2 * i + 1], 0});
  for (const auto& e : plan.edges) state.edges.push_back({static_cast<uint32_t>(e[0]), static_cast<uint32_t>(e[1])});
  return state;
}

/// The rows of bodies that touch walls, and after a move towards walls.
void check_touching(dsw_environment* environment, const NearTruth::Scene& known, double extent, int bodies, Rng& rng,
                    NearTally& tally, const Place* warped = nullptr) {
  const NearTruth truth(known);
  const ScenePtr scene = make_scene(environment);
  const double size = largest(known.points);
  int made = 0;
  for (int i = 0; i < 40 * bodies && made < bodies; ++i) {
    SCOPED_TRACE("body " + std::to_string(i));
    const BodyPlan plan = touching_plan(known, extent, rng);
    const dsw_level level = known.dimension == 2 ? std::array{DSW_LEVEL_POINTS, DSW_LEVEL_EDGES}[rng.below(2)]
                                                 : std::array{DSW_LEVEL_POINTS, DSW_LEVEL_EDGES, DSW_LEVEL_EDGES_SWEPT,
                                                              DSW_LEVEL_FACES}[rng.below(4)];
    dsw_body_id body;
    const dsw_status status = known.dimension == 2 ? create_in_plane(scene.get(), plan, level, &body)
                                                   : create_body(scene.get(), plan, level, 0, {}, &body);
    if (status != DSW_STATUS_OK) continue;
    ++made;
    const double limit = extent * std::pow(10, rng.range(-2, -0.3));
    for (int round = 0; round < 2; ++round) {
      const BodyState state = state_of(scene.get(), body, plan, known.dimension);
      check_rows(rows_with(find_rows(scene.get(), body, limit, 0), {0, 0}), state, truth, limit, level, size, any_pair,
                 tally, warped);
      if (testing::Test::HasFailure()) return;
      const Vec to = place_on(known, rng);
      std::vector<double> targets;
      for (const Vec& p : state.at) {
        const Vec target = between(p, to, rng.chance(0.5) ? 1 : rng.range(0, 1.5));
        targets.insert(targets.end(), target.begin(), target.begin() + known.dimension);
      }
      ASSERT_EQ(dsw_body_move(scene.get(), body, targets.data(), state.at.size(), 0, nullptr, nullptr), DSW_STATUS_OK);
    }
    ASSERT_EQ(dsw_body_destroy(scene.get(), body), DSW_STATUS_OK);
  }
}

class NearSightTest : public SceneTest {};
DSW_FOR_ALL_SCENES(NearSightTest);

TEST_P(NearSightTest, AreAllThatAreSeenFromWhatTouchesWalls) {
  NearTally tally;
  const std::string name = GetParam();
  const bool is_warped = name.find("warped") != std::string::npos;
  // The last two cost exact arithmetic the most.
  struct {
    double factor, offset;
  } const transforms[] = {{1, 0}, {1, 1e8}, {1, 0}, {1, 1e8}, {1, 0}, {1, 1e8}, {1e150, 0}, {1e-150, 0}};
  const int bodies = at_least(24), of_each = 3;  // each transform at least once
  for (uint64_t seed = 1; of_each * static_cast<int>(seed) <= bodies; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    Mesh mesh = kind_named(name).make(rng);
    shuffle_cells(mesh, rng);
    const auto by = transforms[seed % 8];
    // Rounding would move the points of conforming faces off them.
    const bool conforms = !mesh.loose.empty();
    const double factor = conforms ? std::ldexp(1, std::ilogb(by.factor)) : by.factor,
                 offset = conforms ? 0 : by.offset;
    Mesh transformed = mesh;
    for (Vec& p : transformed.points) {
      for (double& x : p) x = x * factor + offset;
    }
    Place place = place_of(transformed);
    if (place.environment == nullptr) place = place_of(mesh);  // no doubles there keep its volumes valid
    if (place.environment == nullptr && may_be_refused(mesh)) continue;
    ASSERT_PLACE(place);
    const Obstacles obstacles(place, rng);
    const bool overlaps = is_warped && place.world->outer_boundary_crosses();
    check_touching(place.get(), near_scene(place, obstacles, overlaps), place.world->size, of_each, rng, tally,
                   overlaps ? &place : nullptr);
    if (HasFailure()) return record(tally);
  }
  record(tally);
  EXPECT_GT(tally.rows, 0u);
}

bool exists(const dsw_environment* environment, dsw_face_id face) {
  int impassable = 0;
  return dsw_environment_is_impassable(environment, cell_of(face), &impassable) == DSW_STATUS_OK;
}

/// Everything impassable of an environment, as it can be asked for. Edges and vertices are not marked.
NearTruth::Scene read_scene(const dsw_environment* environment, int dimension) {
  NearTruth::Scene scene;
  scene.dimension = dimension;
  const double* at = nullptr;
  size_t count = 0;
  EXPECT_EQ(dsw_environment_get_points(environment, &at, &count), DSW_STATUS_OK);
  for (size_t i = 0; i < count; ++i) {
    Vec p{};
    std::copy_n(at + i * static_cast<size_t>(dimension), dimension, p.begin());
    scene.points.push_back(p);
  }
  scene.wall_points = scene.points;
  dsw_trace* trace = nullptr;
  EXPECT_EQ(dsw_trace_create(nullptr, &trace), DSW_STATUS_OK);
  const auto vertices_of = [&](dsw_cell cell) {
    NearTruth::Ids ids;
    for (const dsw_vertex_id& v : oracle::vertices_of(environment, cell)) ids.push_back(static_cast<int>(v.index));
    return ids;
  };
  const auto is_impassable = [&](dsw_cell cell) {
    int impassable = 0;
    EXPECT_EQ(dsw_environment_is_impassable(environment, cell, &impassable), DSW_STATUS_OK);
    return impassable != 0;
  };
  std::set<NearTruth::Ids> walls;
  dsw_environment_info info{};
  info.struct_size = sizeof info;
  EXPECT_EQ(dsw_environment_get_info(environment, &info), DSW_STATUS_OK);
  for (uint32_t i = 0; i < info.volume_index_count; ++i) {
    dsw_volume_id volume;
    if (dsw_environment_get_volume_id(environment, i, &volume) != DSW_STATUS_OK) continue;
    const NearTruth::Ids own = vertices_of(cell_of(volume));
    std::vector<NearTruth::Ids> faces, simplices;
    std::vector<bool> closed;
    for (uint32_t f = 0;; ++f) {
      const dsw_face_id face{volume.index, volume.generation, f};
      if (!exists(environment, face)) break;
      faces.push_back(vertices_of(cell_of(face)));
      closed.push_back(is_impassable(cell_of(face)));
    }
    if (dimension == 2) simplices = faces;
    if (dimension == 3) {
      dsw_trace_clear(trace);
      dsw_trace_data data{};
      data.struct_size = sizeof data;
      EXPECT_EQ(dsw_trace_add_volumes(trace, environment, &volume, 1, 0), DSW_STATUS_OK);
      EXPECT_EQ(dsw_trace_get_data(trace, &data), DSW_STATUS_OK);
      for (size_t t = 0; t < 3 * data.triangle_count; t += 3) {
        NearTruth::Ids ids;
        for (size_t k = 0; k < 3; ++k) {
          const double* const p = data.points + size_t{3} * data.triangles[t + k];
          ids.push_back(*std::find_if(own.begin(), own.end(), [&](int v) {
            return std::equal(p, p + 3, scene.points[static_cast<size_t>(v)].begin());
          }));
        }
        simplices.push_back(ids);
      }
    }
    for (NearTruth::Ids& simplex : simplices) {
      std::sort(simplex.begin(), simplex.end());
      for (size_t f = 0; f < faces.size(); ++f) {
        const auto is_of_face = [&](int v) { return std::find(faces[f].begin(), faces[f].end(), v) != faces[f].end(); };
        if (closed[f] && std::all_of(simplex.begin(), simplex.end(), is_of_face)) walls.insert(simplex);
      }
    }
    if (!is_impassable(cell_of(volume))) scene.volumes.push_back(simplices);
  }
  dsw_trace_destroy(trace);
  scene.walls.assign(walls.begin(), walls.end());
  scene.obstacles = scene.walls;
  return scene;
}

/// Marks a tenth of the volumes and of the faces.
void mark_some(dsw_environment* environment, Rng& rng) {
  dsw_environment_info info{};
  info.struct_size = sizeof info;
  ASSERT_EQ(dsw_environment_get_info(environment, &info), DSW_STATUS_OK);
  for (uint32_t i = 0; i < info.volume_index_count; ++i) {
    dsw_volume_id volume;
    if (dsw_environment_get_volume_id(environment, i, &volume) != DSW_STATUS_OK) continue;
    if (rng.chance(0.1)) dsw_environment_mark_volumes(environment, &volume, 1, DSW_MARK_IMPASSABLE, 0, nullptr);
    const dsw_face_id face{volume.index, volume.generation, rng.below(3)};
    if (rng.chance(0.2)) dsw_environment_mark_faces(environment, &face, 1, DSW_MARK_IMPASSABLE);
  }
}

/// Unsews most of the inner faces for which `is_in(point)` is true of all vertices.
template <class IsIn>
void tear(dsw_environment* environment, int dimension, Rng& rng, IsIn is_in) {
  const NearTruth::Scene scene = read_scene(environment, dimension);
  std::vector<dsw_face_id> faces;
  for (uint32_t i = 0; i < scene.volumes.size(); ++i) {
    dsw_volume_id volume;
    ASSERT_EQ(dsw_environment_get_volume_id(environment, i, &volume), DSW_STATUS_OK);
    for (uint32_t f = 0; f < scene.volumes[i].size(); ++f) {
      const dsw_face_id face{volume.index, volume.generation, f};
      if (!exists(environment, face)) break;
      const std::vector<dsw_vertex_id> vertices = vertices_of(environment, cell_of(face));
      const auto lies_in = [&](const dsw_vertex_id& v) { return is_in(scene.points[v.index]); };
      if (rng.chance(0.7) && std::all_of(vertices.begin(), vertices.end(), lies_in)) faces.push_back(face);
    }
  }
  ASSERT_FALSE(faces.empty());
  const std::vector<double> loads(faces.size(), 1);
  ASSERT_EQ(dsw_environment_tear_faces(environment, faces.data(), loads.data(), faces.size(), 0.5, nullptr),
            DSW_STATUS_OK);
}

void cut(dsw_environment* environment, const std::vector<double>& blade) {
  dsw_cut_desc desc = defaults(dsw_cut_desc_init);
  desc.flags = DSW_CUT_UNSEW;
  desc.points = blade.data();
  desc.rows = desc.columns = 2;
  ASSERT_EQ(dsw_environment_cut(environment, &desc, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
}

/// Hexahedra with a closed slit above z = 1 in the middle, whose sides have points of their own.
Mesh slit_grid() {
  const Mesh whole = hex_grid(axis(4, 1), axis(3, 1), axis(3, 1));
  Mesh mesh;
  mesh.points = whole.points;
  std::map<int, int> copies;
  for (const Cell& cell : whole.cells) {
    const auto x = [&](int v) { return whole.points[static_cast<size_t>(v)][0]; };
    const bool is_left = std::any_of(cell.vertices.begin(), cell.vertices.end(), [&](int v) { return x(v) < 2; });
    std::vector<int> vertices = cell.vertices;
    for (int& v : vertices) {
      const Vec at = whole.points[static_cast<size_t>(v)];
      if (!is_left || at[0] != 2 || at[2] <= 1) continue;
      const auto [copy, is_new] = copies.emplace(v, static_cast<int>(mesh.points.size()));
      if (is_new) mesh.points.push_back(at);
      v = copy->second;
    }
    mesh.add_standard(cell.type, vertices);
  }
  return mesh;
}

/// Bends everything a little. Points in one place go to one place.
void bend(dsw_environment* environment, double size, Rng& rng, std::vector<double>& next) {
  const double* points = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_environment_get_points(environment, &points, &count), DSW_STATUS_OK);
  next.assign(points, points + 3 * count);
  const double share = 0.4 * rng.range(-1, 1) / size;
  for (size_t i = 0; i < 3 * count; i += 3) {
    const Vec p = {points[i], points[i + 1], points[i + 2]};
    for (size_t k = 0; k < 3; ++k) next[i + k] += share * p[(k + 1) % 3] * (p[(k + 2) % 3] - 0.4 * size);
  }
  const ScenePtr scene = make_scene(environment, DSW_FEATURE_DEFORMING);
  ASSERT_EQ(dsw_environment_deform(environment, next.data(), count, nullptr, nullptr), DSW_STATUS_OK);
}

TEST(NearSlitTest, TheOtherLipIsNotSeen) {
  NearTally tally;
  const int bodies = effort_of(240), of_each = std::clamp(bodies / 4, 1, 20);  // four kinds of places
  for (uint64_t seed = 1; of_each * static_cast<int>(seed) <= bodies; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    std::vector<double> bent;  // outlives the environment
    Place place = seed % 4 == 0   ? place_of(hex_grid(axis(4, 1), axis(3, 1), axis(3, 1)))
                  : seed % 4 == 1 ? make_place("tet_kuhn", seed)
                                  : place_of(slit_grid());
    ASSERT_PLACE(place);
    if (seed % 4 == 0) {
      tear(place.get(), 3, rng, [&](const Vec& p) { return p[0] == 2; });
    } else if (seed % 4 == 1) {
      tear(place.get(), 3, rng, [](const Vec&) { return true; });
    } else if (seed % 4 == 2) {
      const double x = 2 + 0.7 * rng.range(-1, 1);
      cut(place.get(), {x, -1, -1, x, 2.5, -1, x, -1, 2.5, x, 2.5, 2.5});
    }
    mark_some(place.get(), rng);
    if (rng.chance(0.4)) bend(place.get(), place.world->size, rng, bent);
    check_touching(place.get(), read_scene(place.get(), 3), place.world->size, of_each, rng, tally);
    if (HasFailure()) return record(tally);
  }
  record(tally);
  EXPECT_GT(tally.rows, static_cast<uint64_t>(effort_of(500)));
}

/// Bodies that touch walls from both sides: a wall hides one from the other.
TEST(NearAcrossWallsTest, BodiesAreSeenWhereNoWallIsBetween) {
  NearTally tally;
  const int bodies = effort_of(180), of_each = std::min(bodies, 6);
  for (uint64_t seed = 1; of_each * static_cast<int>(seed) <= bodies; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    Place place = place_of(hex_grid(axis(3, 1), axis(2, 1), axis(2, 1)));
    ASSERT_PLACE(place);
    mark_some(place.get(), rng);
    const NearTruth::Scene walls = read_scene(place.get(), 3);
    const ScenePtr scene = make_scene(place.get(), DSW_FEATURE_BODY_CONTACTS);
    struct Made {
      dsw_body_id id;
      dsw_level level;
      BodyState state;
    };
    std::vector<Made> made;
    for (int i = 0; i < 40 * of_each && made.size() < static_cast<size_t>(of_each); ++i) {
      Made body{{0, 0}, rng.chance(0.7) ? DSW_LEVEL_FACES : DSW_LEVEL_POINTS, {}};
      const BodyPlan plan = touching_plan(walls, 3, rng);
      if (create_body(scene.get(), plan, body.level, 0, {}, &body.id) != DSW_STATUS_OK) continue;
      ASSERT_EQ(read_body(scene.get(), body.id, body.state), "");
      made.push_back(body);
    }
    for (const Made& body : made) {
      const std::vector<dsw_near_row> rows = find_rows(scene.get(), body.id, 1.5, 0);
      for (const Made& other : made) {
        if (&other == &body) continue;
        NearTruth::Scene known;
        known.points = other.state.at;
        known.wall_points = walls.points;
        known.walls = walls.walls;
        known.is_shifted = false;
        for_each_part(other.state, other.level,
                      [&](const std::vector<int>& ids, const std::vector<Vec>&) { known.obstacles.push_back(ids); });
        check_rows(rows_with(rows, other.id), body.state, NearTruth(known), 1.5, body.level, 4, any_pair, tally);
        if (HasFailure()) return record(tally);
      }
    }
  }
  record(tally);
  EXPECT_GT(tally.rows, static_cast<uint64_t>(effort_of(100)));
  EXPECT_GT(tally.hidden, static_cast<uint64_t>(effort_of(100)));
}

TEST(NearPlaneSightTest, AreAllThatAreSeenFromWhatTouchesWalls) {
  NearTally tally;
  const int bodies = effort_of(600), of_each = std::clamp(bodies / 2, 1, 100);  // two kinds of places
  for (uint64_t seed = 1; of_each * static_cast<int>(seed) <= bodies; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    const EnvironmentPtr environment = make_squares(6, seed % 2 == 0);
    tear(environment.get(), 2, rng, [&](const Vec& p) { return std::fabs(p[0] - 3) < 0.5; });
    mark_some(environment.get(), rng);
    check_touching(environment.get(), read_scene(environment.get(), 2), 6, of_each, rng, tally);
    if (HasFailure()) return record(tally);
  }
  record(tally);
  EXPECT_GT(tally.rows, static_cast<uint64_t>(effort_of(500)));
}

/// Three polygons round a slit from a to b, of which one lip has a point more, m.
EnvironmentPtr make_slit(const Vec& a, const Vec& b, const Vec& m) {
  const std::vector<double> points = {a[0],     a[1],     b[0],     b[1],     m[0],     m[1], a[0] + 3, a[1] - 1,
                                      a[0] + 3, a[1] + 1, a[0] - 3, a[1] + 4, a[0] - 3, a[1], a[0],     a[1] - 3};
  const std::vector<int32_t> corners = {0, 3, 4, 1, 0, 2, 1, 5, 6, 6, 7, 3, 0}, offsets = {0, 4, 9, 13};
  dsw_environment_desc desc = uniform_desc(2, DSW_CELL_TYPE_TRIANGLE, 3, points, corners);
  const std::vector<uint8_t> types(3, DSW_CELL_TYPE_POLYGON);
  desc.cell_types = types.data();
  desc.volume_count = types.size();
  desc.offsets = offsets.data();
  return create_from(desc);
}

/// The point is rounded, so its lip is before the other one, behind it, or in the same place. Whoever is in a polygon meets
/// the lip of that polygon, and sees no other one. The first slit is of numbers at which the other lip was seen.
TEST(NearPlaneSlitTest, TheLipOfThePolygonIsSeen) {
  const std::vector<Vec> right = {{4.0121117852489627, 2.8530332574935975, 0},
                                  {3.8643548025910972, 2.7687392444393053, 0},
                                  {3.8876488506226758, 2.812158861722474, 0},
                                  {3.8799505139910733, 2.7973528788683772, 0},
                                  {3.4540059435129113, 2.0012759728660487, 0}};
  NearTally tally;
  const auto check = [&](const Vec& a, const Vec& b, const Vec& m, double way) {
    const EnvironmentPtr environment = make_slit(a, b, m);
    const ScenePtr scene = make_scene(environment.get());
    for (const bool is_left : {false, true}) {
      BodyPlan plan = {right, {}, {}};
      for (Vec& at : plan.at) {
        at = is_left ? Vec{at[0] - 0.5, at[1] + 0.25, 0} : Vec{at[0] + way, at[1], 0};
      }
      dsw_body_id body;
      ASSERT_EQ(create_in_plane(scene.get(), plan, DSW_LEVEL_POINTS, &body), DSW_STATUS_OK) << dsw_last_error_message();
      size_t rows_of_lip = 0;
      for (const dsw_near_row& row : find_rows(scene.get(), body, 1.25, 0)) {
        const std::vector<int> ids = used(row.obstacle_vertices);
        ++tally.rows;
        tally.phantom += is_left ? ids == std::vector{0, 1} : ids.back() == 2 || ids == std::vector{2};
        rows_of_lip += is_left ? ids.back() == 2 : ids == std::vector{0, 1};
      }
      tally.missed += rows_of_lip < plan.at.size() ? plan.at.size() - rows_of_lip : 0;
      ASSERT_EQ(dsw_body_destroy(scene.get(), body), DSW_STATUS_OK);
    }
  };
  const auto side = [](const Vec& a, const Vec& b, const Vec& m) {
    const mpq_class x = mpq_class(b[0]) - a[0], y = mpq_class(b[1]) - a[1];
    return sgn(mpq_class(x * (mpq_class(m[1]) - a[1]) - y * (mpq_class(m[0]) - a[0])));
  };
  const Vec a = {3.325, 1.76, 0}, b = {4.25, 3.49, 0}, middle = {3.7875, 2.625, 0};
  EXPECT_EQ(side(a, b, middle), -1) << "it is not before the other lip, seen from the right";
  int on_side[3] = {};
  for (const double x : {3.7, middle[0], 3.8}) {
    for (const double y : {2.6, middle[1], 2.7}) {
      const Vec m = {std::nextafter(middle[0], x), std::nextafter(middle[1], y), 0};
      ++on_side[side(a, b, m) + 1];
      check(a, b, m, 0);
    }
  }
  EXPECT_TRUE(on_side[0] > 1 && on_side[2] > 1);
  EXPECT_EQ(side({3.25, 1.5, 0}, {4.25, 3.5, 0}, {3.75, 2.5, 0}), 0);
  check({3.25, 1.5, 0}, {4.25, 3.5, 0}, {3.75, 2.5, 0}, 0.125);
  record(tally);
  EXPECT_GE(tally.rows, 100u);
  EXPECT_EQ(tally.phantom, 0u);
  EXPECT_EQ(tally.missed, 0u);
}

}  // namespace
}  // namespace dsw::oracle
