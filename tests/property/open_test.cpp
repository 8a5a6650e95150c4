// Cuts into a tissue with air beside it that open: what lies in the air can enter, down to where the cut ends.
#include <cmath>
#include <map>
#include <set>

#include "environment/validity.h"
#include "map/integrity.h"
#include "random_edits.h"

namespace dsw::oracle {
namespace {

/// Cubes with 6 tetrahedra each, shaken.
Mesh block_of_tets(int n, Rng& rng) {
  const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
  Mesh mesh;
  const auto at = [&](const int* p) { return p[0] + (n + 1) * (p[1] + (n + 1) * p[2]); };
  int p[3];
  for (p[2] = 0; p[2] <= n; ++p[2]) {
    for (p[1] = 0; p[1] <= n; ++p[1]) {
      for (p[0] = 0; p[0] <= n; ++p[0]) {
        Vec x;
        for (size_t k = 0; k < 3; ++k) x[k] = p[k] + (p[k] == 0 || p[k] == n ? 0 : rng.range(-0.15, 0.15));
        mesh.points.push_back(x);
      }
    }
  }
  for (int i = 0; i < 6 * n * n * n; ++i) {
    int q[3] = {i / 6 % n, i / 6 / n % n, i / 6 / n / n};
    std::vector<int> corners{at(q)};
    for (const int k : orders[i % 6]) {
      ++q[k];
      corners.push_back(at(q));
    }
    if (i % 6 >= 3) std::swap(corners[2], corners[3]);
    mesh.add_standard(DSW_CELL_TYPE_TETRA, corners);
  }
  return mesh;
}

/// Edges by the vertices at their ends.
using Ridge = std::pair<uint32_t, uint32_t>;
Ridge ridge_between(uint32_t v, uint32_t w) { return {std::min(v, w), std::max(v, w)}; }

/// What of a crack must open and be entered, known from the vertices that came apart by the report. A vertex where
/// volumes would become invalid stays one, and closes off what lies behind it. A face with a parted vertex opens. The gap goes on to the next
/// face over an edge with a parted vertex, and to the air over such an edge of the rim that lies in the air.
struct CrackTruth {
  std::vector<std::vector<Ridge>> faces;
  std::set<Ridge> in_air;  // not on the outer boundary
  std::set<uint32_t> parted;

  static bool is_open(const Ridge& ridge, const std::set<uint32_t>& parted) {
    return parted.count(ridge.first) != 0 || parted.count(ridge.second) != 0;
  }
  size_t opened() const {
    const auto open = [&](const std::vector<Ridge>& face) {
      return std::any_of(face.begin(), face.end(), [&](const Ridge& ridge) { return is_open(ridge, parted); });
    };
    return static_cast<size_t>(std::count_if(faces.begin(), faces.end(), open));
  }
  /// The number of faces whose gaps join the air.
  size_t entered() const {
    std::map<Ridge, std::vector<size_t>> users;
    for (size_t f = 0; f < faces.size(); ++f) {
      for (const Ridge& ridge : faces[f]) users[ridge].push_back(f);
    }
    std::set<size_t> reached;
    std::vector<size_t> ahead;
    const auto reach = [&](size_t f) {
      if (reached.insert(f).second) ahead.push_back(f);
    };
    for (const auto& [ridge, at] : users) {
      EXPECT_LE(at.size(), 2u);
      if (at.size() == 1 && in_air.count(ridge) != 0 && is_open(ridge, parted)) reach(at[0]);
    }
    while (!ahead.empty()) {
      const size_t f = ahead.back();
      ahead.pop_back();
      for (const Ridge& ridge : faces[f]) {
        if (is_open(ridge, parted)) std::for_each(users[ridge].begin(), users[ridge].end(), reach);
      }
    }
    return reached.size();
  }
};

class OpenTissueTest : public testing::Test {
 protected:
  const Environment<3>& env() const { return dsw::capi::space(*place_.get()); }

  /// What lies below a plane through the middle is tissue.
  void mark_tissue(Rng& rng) {
    const double normal[3] = {rng.range(-0.3, 0.3), rng.range(-0.3, 0.3), 1};
    std::vector<dsw_volume_id> tissue;
    for_each_cell(env().map, [&](dsw::Cell c) {
      double at[3], height = 0;
      centre(env(), c, at);
      for (int k = 0; k < 3; ++k) height += normal[k] * (at[k] - 0.5 * (env().lower[k] + env().upper[k]));
      if (height < 0) tissue.push_back(volume_id(env().map, c));
    });
    ASSERT_EQ(dsw_environment_mark_volumes(place_.get(), tissue.data(), tissue.size(), DSW_MARK_IMPASSABLE, 0, nullptr),
              DSW_STATUS_OK);
  }
  /// A cut from the air into the tissue, not through it. Its faces between volumes of the tissue.
  std::vector<dsw_cut_face> cut_tissue(Rng& rng) {
    double blade[12], turn = rng.range(-0.2, 0.2);
    for (int i = 0; i < 4; ++i) {
      const double side = i % 2 == 0 ? -10 : 10, share[3] = {0.47, 0.5, i < 2 ? 0.2 : 2};
      for (int k = 0; k < 3; ++k) blade[3 * i + k] = (1 - share[k]) * env().lower[k] + share[k] * env().upper[k];
      blade[3 * i] += turn * side * place_.world->size;
      blade[3 * i + 1] += side * place_.world->size;
    }
    dsw_cut_desc desc = defaults(dsw_cut_desc_init);
    desc.points = blade;
    desc.rows = desc.columns = 2;
    EXPECT_EQ(dsw_environment_cut(place_.get(), &desc, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    const dsw_cut_face* faces = change_of(place_.get()).faces;
    const size_t count = change_of(place_.get()).face_count;
    std::vector<dsw_cut_face> inside;
    for (size_t i = 0; i < count; ++i) {
      const Map<3>& map = env().map;
      if (map.marked(map.cell(faces[i].front.volume)) && map.marked(map.cell(faces[i].back.volume))) {
        inside.push_back(faces[i]);
      }
    }
    return inside;
  }
  std::vector<dsw::Cell> gap() const {
    const dsw_volume_change* changes = change_of(place_.get()).volumes;
    const size_t count = change_of(place_.get()).volume_count;
    std::vector<dsw::Cell> cells;
    for (size_t i = 0; i < count; ++i) {
      if (changes[i].before.generation == 0) cells.push_back(env().map.cell(changes[i].after.index));
    }
    return cells;
  }
  /// Lets a particle go from the air into every volume of the gap that hangs together with the air. How many these are.
  size_t enter(const std::vector<dsw::Cell>& gap) {
    const Map<3>& map = env().map;
    const ScenePtr scene = make_scene(place_.get());
    std::set<uint32_t> is_gap, left;
    for (const dsw::Cell c : gap) is_gap.insert(c.unit);
    left = is_gap;
    for_each_cell(map, [&](dsw::Cell c) {
      if (map.marked(c) || is_gap.count(c.unit) != 0) return;
      double at[3];
      centre(env(), c, at);
      dsw_particle_id particle;
      ASSERT_EQ(dsw_particle_create(scene.get(), at, volume_id(map, c), &particle), DSW_STATUS_OK);
      enter_beyond(scene.get(), particle, c, is_gap, left);
      ASSERT_EQ(dsw_particle_destroy(scene.get(), particle), DSW_STATUS_OK);
    });
    return is_gap.size() - left.size();
  }
  void move(dsw_scene* scene, dsw_particle_id particle, const double* to) const {
    dsw_flight flight;
    ASSERT_EQ(dsw_particle_move(scene, particle, to, nullptr, &flight), DSW_STATUS_OK);
    EXPECT_EQ(flight.outcome, DSW_OUTCOME_REACHED);
  }
  /// From the centre of a volume into those of the gap next to it, and on from these.
  void enter_beyond(dsw_scene* scene, dsw_particle_id particle, dsw::Cell c, const std::set<uint32_t>& is_gap,
                    std::set<uint32_t>& left) {
    const Map<3>& map = env().map;
    const Shape shape = map.shape(c);
    double back[3];
    centre(env(), c, back);
    for (uint32_t f = 0; f < shape.facet_count(); ++f) {
      const HalfFacet h = map.half_facet(c, f), o = map.opposite(h);
      if (!o.valid() || left.erase(map.cell_of(o).unit) == 0) continue;
      const double* p[3];
      simplex_points(env(), c, shape, shape.simplex_first(f), p);
      double door[3], at[3];
      for (int k = 0; k < 3; ++k) door[k] = (p[0][k] + p[1][k] + p[2][k]) / 3;
      centre(env(), map.cell_of(o), at);
      move(scene, particle, door);
      move(scene, particle, at);
      enter_beyond(scene, particle, map.cell_of(o), is_gap, left);
      move(scene, particle, door);
      move(scene, particle, back);
    }
  }

  /// A crack before it is opened.
  CrackTruth read_crack(const std::vector<dsw_cut_face>& crack) const {
    const Map<3>& map = env().map;
    CrackTruth truth;
    const auto ridge_of = [&](Dart d) { return ridge_between(dart_vertex(map, d), dart_target(map, d)); };
    for (const dsw_cut_face& face : crack) {
      const dsw::Cell c = map.cell(face.front.volume);
      const Shape shape = map.shape(c);
      truth.faces.emplace_back();
      for (uint32_t d = shape.facet_first(face.front.local); d < shape.facet_first(face.front.local + 1); ++d) {
        truth.faces.back().push_back(ridge_of({c, d}));
      }
    }
    std::set<Ridge> outside;
    for_each_cell(map, [&](dsw::Cell c) {
      const Shape shape = map.shape(c);
      for (uint32_t d = 0; d < shape.dart_count(); ++d) {
        if (!map.marked(c)) truth.in_air.insert(ridge_of({c, d}));
        if (!map.opposite(half_facet(map, Dart{c, d})).valid()) outside.insert(ridge_of({c, d}));
      }
    });
    for (const Ridge& ridge : outside) truth.in_air.erase(ridge);
    return truth;
  }

  /// A cut into a tissue that is opened, with all that has to hold afterwards.
  /// `is_whole`: no edge has three faces of the crack, so what joins what is known from the vertices that came apart.
  void open_cut(Rng& rng, bool is_whole) {
    mark_tissue(rng);
    const std::vector<dsw_cut_face> crack = cut_tissue(rng);
    const bool is_partition = dsw_environment_check(place_.get(), nullptr) == DSW_STATUS_OK;
    CrackTruth truth = read_crack(crack);
    dsw_open_crack_desc desc = defaults(dsw_open_crack_desc_init);
    desc.faces = crack.data();
    desc.face_count = crack.size();
    desc.width = 0.02 * place_.world->size;
    dsw_change report = empty_change();
    ASSERT_EQ(dsw_environment_open_crack(place_.get(), &desc, &report), DSW_STATUS_OK) << dsw_last_error_message();
    ASSERT_EQ(check_integrity(env().map), nullptr);
    for_each_cell(env().map, [&](dsw::Cell c) {
      EXPECT_TRUE(check_cell(env(), c) == CellState::kValid || check_cell(env(), c) == CellState::kValidConvex);
    });
    if (is_partition) {
      EXPECT_EQ(dsw_environment_check(place_.get(), nullptr), DSW_STATUS_OK);
    }
    const std::vector<dsw::Cell> cells = gap();
    ASSERT_EQ(cells.size(), report.face_count);
    for (const dsw::Cell c : cells) EXPECT_FALSE(env().map.marked(c));
    check_vertices(report, desc.width);
    faces_ += crack.size();
    opened_ += cells.size();
    const size_t entered = enter(cells);
    entered_ += entered;
    if (!is_whole) return;
    for (size_t i = 0; i < change_of(place_.get()).vertex_count; ++i) {
      truth.parted.insert(change_of(place_.get()).vertices[i].from[0].index);
    }
    EXPECT_EQ(cells.size(), truth.opened());
    EXPECT_EQ(entered, truth.entered());
  }
  /// Copies are as far from each other as the report says.
  void check_vertices(const dsw_change& report, double width) const {
    const dsw_vertex_origin* vertices = nullptr;
    size_t count = 0, shortened = 0;
    vertices = change_of(place_.get()).vertices;
    count = change_of(place_.get()).vertex_count;
    ASSERT_EQ(count, 2 * report.vertices_parted);
    for (size_t i = 0; i < count; i += 2) {
      ASSERT_EQ(vertices[i].from[0].index, vertices[i + 1].from[1].index);
      const double* const p = env().point(vertices[i].vertex.index);
      const double* const q = env().point(vertices[i + 1].vertex.index);
      const double distance = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      EXPECT_GE(distance, report.smallest_width * (1 - 1e-9));
      EXPECT_LE(distance, report.largest_width * (1 + 1e-9));
      shortened += distance < 0.9 * width ? 1u : 0u;
    }
    EXPECT_EQ(shortened, report.vertices_shortened);
    EXPECT_LE(report.largest_width, width * (1 + 1e-9));
  }

  Place place_;
  size_t faces_ = 0, opened_ = 0, entered_ = 0;
};
class OpenTest : public OpenTissueTest, public testing::WithParamInterface<std::string> {};
DSW_FOR_ALL_SCENES(OpenTest);

TEST_P(OpenTest, ParticlesEnterTheCut) {
  for (uint64_t seed = 1; seed <= seeds_of(15); ++seed) {
    place_ = make_place(GetParam(), seed);
    if (place_.environment == nullptr) continue;
    Rng rng(seed);
    open_cut(rng, false);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
  RecordProperty("faces", static_cast<int>(faces_));
  RecordProperty("opened", static_cast<int>(opened_));
  RecordProperty("entered", static_cast<int>(entered_));
}

TEST_F(OpenTissueTest, TheWholeCutIsEnteredWhereVolumesAreSmall) {
  for (uint64_t seed = 1; seed <= seeds_of(5); ++seed) {
    Rng rng(seed);
    place_ = place_of(block_of_tets(6, rng));
    ASSERT_NE(place_.environment, nullptr);
    SCOPED_TRACE("seed " + std::to_string(seed));
    open_cut(rng, true);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
  EXPECT_GT(faces_, 200u);
  EXPECT_GE(opened_, faces_ - faces_ / 20);
}

}  // namespace
}  // namespace dsw::oracle
