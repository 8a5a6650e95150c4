// Edits of thick bodies and marks near them: refused, or done, and every distance is kept.
#include "thick_checks.h"

namespace dsw::oracle {
namespace {

/// One edit of a body, chosen at random.
class BodyEdits {
 public:
  BodyEdits(ThickScene& scene, ThickChecks& checks, Rng& rng) : scene_(scene), checks_(checks), rng_(rng) {}

  void edit(size_t i) {
    const BodyState s = scene_.bodies[i].state;
    const auto v = [&] { return rng_.below(s.at.size()); };
    const uint32_t a = v(), b = v(), c = v();
    dsw_status status = DSW_STATUS_OK;
    const uint32_t kind = rng_.below(7u);
    ThickPart part;
    dsw_body_edit edit{};
    dsw_body_edge_id edge;
    dsw_body_face_id face;
    switch (kind) {
      case 0: {
        dsw_body_vertex_id vertex;
        const Vec at = checks_.target(i, a);
        part.hull = {at};
        part.vertices = {static_cast<uint32_t>(s.at.size())};
        status = dsw_body_add_vertex(scene_.handle(), id(i), at.data(), {0, 0}, &vertex);
        if (status == DSW_STATUS_OUTSIDE || status == DSW_STATUS_IMPASSABLE) part.hull.clear();
        break;
      }
      case 1:
        part.hull = {s.at[a], s.at[b]};
        part.vertices = {a, b};
        status = dsw_body_add_edge(scene_.handle(), id(i), s.vertices[a], s.vertices[b], &edge);
        if (scene_.bodies[i].level < DSW_LEVEL_EDGES) part.hull.clear();
        break;
      case 2:
        status = dsw_body_add_face(scene_.handle(), id(i), s.vertices[a], s.vertices[b], s.vertices[c], &face);
        part.hull = {s.at[a], s.at[b], s.at[c]};
        part.vertices = {a, b, c};
        if (scene_.bodies[i].level < DSW_LEVEL_FACES) part.hull.clear();
        break;
      case 3:
        if (s.edges.empty()) return;
        status = dsw_body_split_edge(scene_.handle(), id(i), s.edge_ids[rng_.below(s.edges.size())],
                                     rng_.range(0.05, 0.95), &edit);
        break;
      case 4: {
        if (s.edges.empty()) return;
        const size_t e = rng_.below(s.edges.size());
        const uint32_t k = rng_.below(2u), from = s.edges[e][k], to = s.edges[e][1 - k];
        status = dsw_body_collapse_edge(scene_.handle(), id(i), s.edge_ids[e], s.vertices[from], &edit);
        if (status == DSW_STATUS_OK && !scene_.bodies[i].self) {  // its own parts there become its neighbours
          EXPECT_EQ(scene_.too_near_on_way(i, from, s.at[from], s.at[to], kKept), "") << "the vertex that is merged";
        }
        break;
      }
      case 5:
        status = rng_.chance(0.7) || s.edges.empty()
                     ? dsw_body_remove_vertex(scene_.handle(), id(i), s.vertices[a])
                     : dsw_body_remove_edge(scene_.handle(), id(i), s.edge_ids[rng_.below(s.edges.size())]);
        break;
      default: {
        const auto level = static_cast<dsw_level>(1 + rng_.below(4u));
        // At a lower level vertices stand for themselves, and are joined to less than their edges.
        if (scene_.bodies[i].self && level < scene_.bodies[i].level) return;
        status = dsw_body_set_level(scene_.handle(), id(i), level);
        if (status == DSW_STATUS_OK) scene_.bodies[i].level = level;
      }
    }
    (status == DSW_STATUS_OK ? done : refused) += 1;
    if (!part.hull.empty() && scene_.bodies[i].radius > 0 &&
        (status == DSW_STATUS_OK || status == DSW_STATUS_OCCUPIED)) {
      const int said = verdict(i, part);
      if (status == DSW_STATUS_OK) {
        EXPECT_GE(said, 0) << "a part was added that is too near";
      } else if (kind < 2 && !scene_.bodies[i].self) {
        EXPECT_LE(said, 0) << "a part is refused that is far enough";
      }
    }
    BodyState after;
    if (status != DSW_STATUS_OK) {
      ASSERT_EQ(read_body(scene_.handle(), id(i), after), "");
      EXPECT_EQ(after.at, s.at);
      EXPECT_EQ(after.edges, s.edges);
    } else if (kind == 3 || kind == 4) {
      scene_.follow(i, edit);
    }
    scene_.read(i);
    EXPECT_EQ(scene_.too_near(i), "") << "after edit " << kind << " with status " << status;
  }

  uint64_t done = 0, refused = 0;

 private:
  dsw_body_id id(size_t i) const { return scene_.bodies[i].id; }
  int verdict(size_t i, const ThickPart& part) const {
    int said = 1;
    scene_.for_each_foe(i, part, 1, false, [&](const mpq_class& keep, const Hull& foe, int) {
      if (is_nearer(part.hull, foe, Limit(keep, kCounts))) said = -1;
      if (said > 0 && is_nearer(part.hull, foe, Limit(keep))) said = 0;
    });
    return said;
  }

  ThickScene& scene_;
  ThickChecks& checks_;
  Rng& rng_;
};

struct EditCounts {
  uint64_t done = 0, refused = 0;
  void record(const std::string& scene) const {
    testing::Test::RecordProperty("done", std::to_string(done));
    testing::Test::RecordProperty("refused", std::to_string(refused));
    EXPECT_GE(done, least_of(scene, effort_of(20)));
  }
};

void edit_bodies(ThickGround& ground, Rng& rng, EditCounts& counts) {
  const bool meets = rng.chance(0.5);
  const ScenePtr handle = make_scene(ground.environment(), meets ? DSW_FEATURE_BODY_CONTACTS : 0);
  ThickScene scene(handle.get(), meets);
  ask(scene, ground, rng, 4, meets && rng.chance(0.5) ? DSW_BODY_SELF_CONTACTS : 0);
  ThickChecks checks(scene, ground, rng);
  BodyEdits edits(scene, checks, rng);
  for (int round = 0; round < 40 && !testing::Test::HasFailure(); ++round) {
    for (size_t i = 0; i < scene.bodies.size() && !testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE("body " + std::to_string(i) + " round " + std::to_string(round) + " level " +
                   std::to_string(scene.bodies[i].level) + " radius " + number(scene.bodies[i].radius));
      edits.edit(i);
      const auto& vertices = scene.bodies[i].state.vertices;
      if (std::none_of(vertices.begin(), vertices.end(), [](auto v) { return v.generation != 0; })) {
        scene.destroy(i--);
        continue;
      }
      if (round % 4 == 0) checks.move_one(i);
    }
  }
  counts.done += edits.done;
  counts.refused += edits.refused;
}

/// Marks of single cells, near thick bodies above all.
class ThickMarks {
 public:
  ThickMarks(ThickScene& scene, Rng& rng, size_t dimension) : scene_(scene), rng_(rng), dimension_(dimension) {}

  void mark() {
    dsw_environment_info info{};
    info.struct_size = sizeof info;
    dsw_environment* const environment = scene_.environment();
    ASSERT_EQ(dsw_environment_get_info(environment, &info), DSW_STATUS_OK);
    dsw_volume_id volume;
    if (rng_.chance(0.7) && !scene_.bodies.empty()) {
      const BodyState& s = scene_.bodies[rng_.below(scene_.bodies.size())].state;
      volume = s.volumes[rng_.below(s.volumes.size())];
      if (volume.generation == 0) return;
      dsw_volume_id beside{0, 0};
      uint32_t faces = 0;
      ASSERT_EQ(dsw_environment_get_volume_counts(environment, volume, nullptr, nullptr, nullptr, &faces),
                DSW_STATUS_OK);
      ASSERT_EQ(dsw_environment_get_neighbour(environment, volume, rng_.below(faces), &beside, nullptr), DSW_STATUS_OK);
      if (beside.generation != 0 && rng_.chance(0.5)) volume = beside;
    } else if (dsw_environment_get_volume_id(environment, rng_.below(info.volume_index_count), &volume) !=
               DSW_STATUS_OK) {
      return;
    }
    uint32_t vertices = 0, edges = 0, faces = 0;
    ASSERT_EQ(dsw_environment_get_volume_counts(environment, volume, nullptr, &vertices, &edges, &faces),
              DSW_STATUS_OK);
    const dsw_mark mark = rng_.chance(0.7) ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE;
    dsw_status status = DSW_STATUS_OK;
    dsw_cell cell{};
    const uint32_t kind = dimension_ == 3 ? rng_.below(5u) : 2 * rng_.below(3u);  // no edges in the plane
    switch (kind) {
      case 0: {
        dsw_face_id face;
        ASSERT_EQ(dsw_environment_get_face_id(environment, volume, rng_.below(faces), &face), DSW_STATUS_OK);
        cell = cell_of(face);
        status = dsw_environment_mark_faces(environment, &face, 1, mark);
        break;
      }
      case 1: {
        dsw_edge_id edge;
        ASSERT_EQ(dsw_environment_get_edge_id(environment, volume, rng_.below(edges), &edge), DSW_STATUS_OK);
        cell = cell_of(edge);
        status = dsw_environment_mark_edges(environment, &edge, 1, mark);
        break;
      }
      case 2: {
        const auto all = vertices_of(environment, cell_of(volume));
        const dsw_vertex_id vertex = all[rng_.below(all.size())];
        cell = cell_of(vertex);
        status = dsw_environment_mark_vertices(environment, &vertex, 1, mark);
        break;
      }
      default:
        status = dsw_environment_mark_volumes(environment, &volume, 1, mark,
                                              kind == 3 ? uint32_t{DSW_MARK_SKIP_OCCUPIED} : 0, nullptr);
    }
    ASSERT_TRUE(status == DSW_STATUS_OK || (status == DSW_STATUS_OCCUPIED && mark == DSW_MARK_IMPASSABLE && kind != 3))
        << dsw_last_error_message();
    (status == DSW_STATUS_OK ? done : refused) += 1;
    if (status == DSW_STATUS_OK) scene_.read_obstacles();
    EXPECT_EQ(scene_.too_near(), "") << "after mark " << mark << " of kind " << kind << " with status " << status;
    if (status == DSW_STATUS_OCCUPIED && kind < 3) check_refusal(cell);
  }

  uint64_t done = 0, refused = 0;

 private:
  /// What is refused is too near to some body, exactly. A face with more corners than three can be cut in any way.
  void check_refusal(const dsw_cell& cell) {
    Hull hull;
    for (const dsw_vertex_id v : vertices_of(scene_.environment(), cell)) {
      Vec at{};
      EXPECT_EQ(dsw_environment_get_vertex_position(scene_.environment(), v, at.data()), DSW_STATUS_OK);
      hull.push_back(at);
    }
    if (hull.size() > 3) return;
    double least = HUGE_VAL;
    bool is_near = false;
    for (size_t i = 0; i < scene_.bodies.size(); ++i) {
      const ThickBody& body = scene_.bodies[i];
      if (body.radius == 0 || scene_.is_tight(i)) return;
      const Limit limit{mpq_class(body.radius)};
      for (const ThickPart& part : scene_.parts_of(body)) {
        is_near = is_near || is_nearer(part.hull, hull, limit);
        least = std::min(least, apart(part.hull, hull).low / body.radius);
      }
    }
    EXPECT_TRUE(is_near) << "a mark is refused that no body is near to: kind " << cell.kind << ", the nearest one is "
                         << least << " of its radius away";
    const dsw_body_id* occupants = nullptr;
    size_t count = 0;
    EXPECT_EQ(dsw_scene_get_occupant_bodies(scene_.handle(), &occupants, &count), DSW_STATUS_OK);
    EXPECT_GT(count, 0u);
  }

  ThickScene& scene_;
  Rng& rng_;
  size_t dimension_;
};

void mark_cells(ThickGround& ground, Rng& rng, EditCounts& counts) {
  const ScenePtr handle = make_scene(ground.environment(), rng.chance(0.5) ? DSW_FEATURE_LIVE_CHANGES : 0);
  ThickScene scene(handle.get(), false);
  ask(scene, ground, rng, 4);
  ThickChecks checks(scene, ground, rng);
  ThickMarks marks(scene, rng, ground.dimension);
  for (int round = 0; round < 80 && !testing::Test::HasFailure() && !scene.bodies.empty(); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    marks.mark();
    if (round % 4 == 0) checks.move_all(rng.below(scene.bodies.size()));
  }
  counts.done += marks.done;
  counts.refused += marks.refused;
}

/// Calls visit(ground, rng, counts) for some grounds of a scene in space.
template <class Visit>
void in_space(const std::string& scene, Visit visit) {
  EditCounts counts;
  for (uint64_t seed = 1; seed <= last_thick_seed(5) && !testing::Test::HasFailure(); ++seed) {
    Rng rng(seed + 1000);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto ground = space_ground(scene, seed % 4 == 2 ? Transform::kLarge : Transform::kNone, rng);
    if (ground != nullptr) visit(*ground, rng, counts);
  }
  counts.record(scene);
}
template <class Visit>
void in_plane(const std::string& scene, Visit visit) {
  EditCounts counts;
  for (uint64_t seed = 1; seed <= last_thick_seed(5) && !testing::Test::HasFailure(); ++seed) {
    Rng rng(seed + 1000);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto ground = plane_ground(scene, seed, rng);
    if (ground != nullptr) visit(*ground, rng, counts);
  }
  counts.record(scene);
}

class ThickEditsTest : public testing::TestWithParam<std::string> {};
DSW_FOR_ALL_SWEEP_SCENES(ThickEditsTest);
TEST_P(ThickEditsTest, EditsOfBodiesKeepEveryDistance) { in_space(GetParam(), edit_bodies); }
TEST_P(ThickEditsTest, MarksKeepEveryDistance) { in_space(GetParam(), mark_cells); }

class ThickPlaneEditsTest : public testing::TestWithParam<std::string> {};
DSW_FOR_ALL_PLANE_SCENES(ThickPlaneEditsTest);
TEST_P(ThickPlaneEditsTest, EditsOfBodiesKeepEveryDistance) { in_plane(GetParam(), edit_bodies); }
TEST_P(ThickPlaneEditsTest, MarksKeepEveryDistance) { in_plane(GetParam(), mark_cells); }

}  // namespace
}  // namespace dsw::oracle
