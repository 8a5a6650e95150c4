// Pieces of every kind of cell come off: random blobs, in what is passable, beside what is not, or cut out of what is
// impassable all round.
#include <cmath>
#include <cstdlib>
#include <set>

#include "body_check.h"
#include "body_support.h"
#include "space_arena.h"

namespace dsw::oracle {
namespace {

/// Groups of numbered things.
class Groups {
 public:
  explicit Groups(size_t count) : root_(count) { std::iota(root_.begin(), root_.end(), size_t{0}); }
  size_t find(size_t i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }
  void join(size_t a, size_t b) { root_[find(a)] = find(b); }
  int count() {
    int roots = 0;
    for (size_t i = 0; i < root_.size(); ++i) roots += find(i) == i ? 1 : 0;
    return roots;
  }

 private:
  std::vector<size_t> root_;
};

class DetachTest : public SceneTest {
 protected:
  World& world() { return *place_.world; }
  dsw_volume_id id(int cell) { return world().ids[static_cast<size_t>(cell)]; }

  /// Cells that hang together through faces.
  std::set<int> blob(int start, size_t wanted) {
    std::set<int> cells{start};
    for (int tries = 0; cells.size() < wanted && tries < 200; ++tries) {
      auto from = cells.begin();
      std::advance(from, rng_.below(static_cast<uint32_t>(cells.size())));
      const auto& faces = world().cell_faces[static_cast<size_t>(*from)];
      const Face& face = world().faces[static_cast<size_t>(faces[rng_.below(static_cast<uint32_t>(faces.size()))])];
      if (face.cell[1] >= 0) cells.insert(face.cell[face.cell[0] == *from ? 1 : 0]);
    }
    return cells;
  }
  void mark(const std::set<int>& cells) {
    for (const int c : cells) {
      const dsw_volume_id v = id(c);
      ASSERT_EQ(dsw_environment_mark_volumes(place_.get(), &v, 1, DSW_MARK_IMPASSABLE, 0, nullptr), DSW_STATUS_OK);
      world().cell_marked[static_cast<size_t>(c)] = 1;
    }
  }
  /// Faces between the piece and what is impassable become cracks.
  uint32_t part(const std::set<int>& piece) {
    uint32_t cracks = 0;
    for (size_t f = 0; f < world().faces.size(); ++f) {
      const Face& face = world().faces[f];
      if (face.cell[1] < 0 || piece.count(face.cell[0]) == piece.count(face.cell[1])) continue;
      const int other = face.cell[piece.count(face.cell[0])];
      if (world().cell_marked[static_cast<size_t>(other)] == 0 && rng_.chance(0.8)) continue;
      EXPECT_EQ(dsw_environment_unsew_face(place_.get(), face_id(world(), static_cast<int>(f))), DSW_STATUS_OK);
      ++cracks;
    }
    return cracks;
  }
  uint32_t boundary_faces() {
    dsw_environment_info info;
    info.struct_size = sizeof info;
    EXPECT_EQ(dsw_environment_get_info(place_.get(), &info), DSW_STATUS_OK);
    return info.boundary_face_count;
  }

  /// The Euler number of the piece as a solid that is pulled apart where it touches itself. Corners, edges, faces and
  /// cells of all its cells count, each once for the cells that hang together through faces of the piece.
  int euler_number(const std::set<int>& piece) {
    std::map<std::array<int, 2>, size_t> corners;
    std::map<std::array<int, 3>, size_t> edges;
    const auto sorted = [](int c, int a, int b) { return std::array<int, 3>{c, std::min(a, b), std::max(a, b)}; };
    int faces = 0;
    for (const int c : piece) {
      for (const int f : world().cell_faces[static_cast<size_t>(c)]) {
        const Face& face = world().faces[static_cast<size_t>(f)];
        faces += face.cell[0] == c || piece.count(face.cell[0]) == 0 ? 1 : 0;
        for (size_t i = 0; i < face.loop.size(); ++i) {
          const int a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
          corners.emplace(std::array<int, 2>{c, a}, corners.size());
          edges.emplace(sorted(c, a, b), edges.size());
        }
      }
    }
    Groups of_corners(corners.size()), of_edges(edges.size());
    for (const Face& face : world().faces) {
      if (face.cell[1] < 0 || piece.count(face.cell[0]) == 0 || piece.count(face.cell[1]) == 0) continue;
      for (size_t i = 0; i < face.loop.size(); ++i) {
        const int a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
        of_corners.join(corners.at({face.cell[0], a}), corners.at({face.cell[1], a}));
        of_edges.join(edges.at(sorted(face.cell[0], a, b)), edges.at(sorted(face.cell[1], a, b)));
      }
    }
    return of_corners.count() - of_edges.count() + faces - static_cast<int>(piece.size());
  }

  void check_space(const std::set<int>& piece, uint32_t cracks) {
    EXPECT_EQ(report_.detached_count, piece.size());
    EXPECT_EQ(report_.faces_sewn, cracks);
    const dsw_volume_id* volumes = change_of(dsw_scene_get_environment(scene_.get())).detached;
    const size_t count = change_of(dsw_scene_get_environment(scene_.get())).detached_count;
    std::set<uint32_t> found, wanted;
    for (size_t i = 0; i < count; ++i) found.insert(volumes[i].index);
    for (const int c : piece) {
      wanted.insert(id(c).index);
      int impassable = 1;
      ASSERT_EQ(dsw_environment_is_impassable(place_.get(), cell_of(id(c)), &impassable), DSW_STATUS_OK);
      EXPECT_EQ(impassable, 0);
      world().cell_marked[static_cast<size_t>(c)] = 0;
    }
    EXPECT_EQ(found, wanted);
    EXPECT_EQ(dsw_environment_check(place_.get(), nullptr), sound_) << dsw_last_error_message();
  }

  void check_surface(const std::set<int>& piece, const BodyState& state) {
    const dsw_vertex_origin* vertices = nullptr;
    const dsw_face_origin* faces = nullptr;
    size_t vertex_count = 0, face_count = 0;
    vertices = change_of(dsw_scene_get_environment(scene_.get())).body_vertices;
    vertex_count = change_of(dsw_scene_get_environment(scene_.get())).body_vertex_count;
    faces = change_of(dsw_scene_get_environment(scene_.get())).body_faces;
    face_count = change_of(dsw_scene_get_environment(scene_.get())).body_face_count;
    ASSERT_EQ(vertex_count, state.at.size());
    ASSERT_EQ(face_count, state.faces.size());
    EXPECT_EQ(2 * state.edges.size(), 3 * face_count);
    EXPECT_EQ(static_cast<int>(vertex_count + face_count) - static_cast<int>(state.edges.size()),
              2 * euler_number(piece));
    std::vector<Vec> before(vertex_count);
    double farthest = 0;
    for (size_t v = 0; v < vertex_count; ++v) {
      double square = 0;
      for (size_t k = 0; k < 3; ++k) {
        const auto& points = place_.mesh.points;
        before[v][k] = vertices[v].weights[0] * points[vertices[v].from[0].index][k] +
                       vertices[v].weights[1] * points[vertices[v].from[1].index][k];
        square += (before[v][k] - state.at[v][k]) * (before[v][k] - state.at[v][k]);
      }
      farthest = std::max(farthest, std::sqrt(square));
    }
    EXPECT_NEAR(farthest, report_.distance, 1e-9 * farthest);
    double inside = 0, of_cells = 0, size = 0;
    for (size_t f = 0; f < face_count; ++f) {
      const auto& corners = state.faces[f];
      const double sum = volume6(before[corners[0]], before[corners[1]], before[corners[2]]);
      inside += sum;
      size += std::fabs(sum);
      const std::vector<dsw_vertex_id> loop = vertices_of(place_.get(), cell_of(faces[f].face));
      for (const uint32_t corner : corners) {
        for (const dsw_vertex_id& from : vertices[corner].from) {
          EXPECT_TRUE(std::any_of(loop.begin(), loop.end(), [&](dsw_vertex_id v) { return v.index == from.index; }));
        }
      }
      dsw_volume_id sides[2];
      ASSERT_EQ(dsw_environment_get_face_volumes(place_.get(), faces[f].face, &sides[0], &sides[1]), DSW_STATUS_OK);
      EXPECT_TRUE(same(sides[0], faces[f].volume) || same(sides[1], faces[f].volume));
    }
    for (const Triangle& t : world().triangles) {
      const auto& p = place_.mesh.points;
      const double sum =
          volume6(p[static_cast<size_t>(t.v[0])], p[static_cast<size_t>(t.v[1])], p[static_cast<size_t>(t.v[2])]);
      if (piece.count(t.cell[0]) != 0) of_cells += sum;
      if (t.cell[1] >= 0 && piece.count(t.cell[1]) != 0) of_cells -= sum;
    }
    EXPECT_NEAR(inside, of_cells, 1e-9 * size);
    EXPECT_GT(inside, 0);
  }
  double volume6(const Vec& a, const Vec& b, const Vec& c) const {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }

  /// Where the outer boundary passes through itself, the oracle sees walls that are not in the way.
  std::string not_free(const BodyState& state, dsw_level level) {
    if (sound_ != DSW_STATUS_OK) return "";
    SweepReport report(0);
    SpaceArena arena(world());
    return BodyChecker(arena, report).not_free(state, level);
  }

  /// Off it goes, as far as it gets, and a particle through where it was.
  void move_away(dsw_body_id body, const std::set<int>& piece, dsw_level level) {
    BodyState state;
    ASSERT_EQ(read_body(scene_.get(), body, state), "");
    std::vector<Vec> targets = state.at;
    Vec shift;
    for (double& x : shift) x = rng_.range(-0.3, 0.3) * world().size;
    for (Vec& target : targets) {
      for (size_t k = 0; k < 3; ++k) target[k] += shift[k];
    }
    BodyAnswer answer;
    ASSERT_EQ(move_body(scene_.get(), body, targets, nullptr, answer), "");
    EXPECT_EQ(not_free(answer.after, level), "");
    double from[3], to[3];
    ASSERT_EQ(dsw_environment_get_centre(place_.get(), id(*piece.begin()), from), DSW_STATUS_OK);
    for (const Face& face : world().faces) {
      if (face.cell[1] < 0 || piece.count(face.cell[0]) == 0 || piece.count(face.cell[1]) == 0) continue;
      ASSERT_EQ(dsw_environment_get_centre(place_.get(), id(face.cell[0]), from), DSW_STATUS_OK);
      const auto& p = place_.mesh.points;
      for (size_t k = 0; k < 3; ++k) {
        to[k] = 0;
        for (const int v : face.loop) to[k] += p[static_cast<size_t>(v)][k] / static_cast<double>(face.loop.size());
      }
      dsw_particle_id particle;
      ASSERT_EQ(dsw_particle_create(scene_.get(), from, id(face.cell[0]), &particle), DSW_STATUS_OK)
          << dsw_last_error_message();
      dsw_flight flight;
      ASSERT_EQ(dsw_particle_move(scene_.get(), particle, to, nullptr, &flight), DSW_STATUS_OK);
      EXPECT_EQ(dsw_particle_destroy(scene_.get(), particle), DSW_STATUS_OK);
    }
  }

  Rng rng_{1};
  Place place_;
  ScenePtr scene_;
  dsw_change report_ = empty_change();
  dsw_status sound_ = DSW_STATUS_OK;  // what the check said of the mesh: its outer boundary can cross itself
};
DSW_FOR_ALL_SCENES(DetachTest);

TEST_P(DetachTest, ItsSurfaceIsAFreeBodyWhereItWas) {
  const auto wanted = seeds_of(12);
  size_t done = 0, refused[3] = {}, tried[3] = {};
  for (uint64_t seed = 1; seed <= wanted; ++seed) {
    rng_ = Rng(seed ^ 0xde7ac4);
    scene_.reset();
    place_ = make_place(GetParam(), seed);
    if (place_.environment == nullptr) continue;
    ASSERT_PLACE(place_);
    scene_ = make_scene(place_.get(), seed % 2 == 0 ? uint32_t{DSW_FEATURE_BODY_CONTACTS} : 0u);
    sound_ = dsw_environment_check(place_.get(), nullptr);
    const auto cells = static_cast<uint32_t>(world().ids.size());
    const auto start = static_cast<int>(rng_.below(cells));
    const std::set<int> piece = blob(start, 1 + rng_.below(20));
    const uint32_t kind = rng_.below(3);
    std::set<int> marked = piece;
    if (kind == 1) marked = blob(start, 4 * piece.size());
    if (kind == 2) {
      for (int c = 0; c < static_cast<int>(cells); ++c) marked.insert(c);
    }
    marked.insert(piece.begin(), piece.end());
    mark(marked);
    const uint32_t before = boundary_faces(), cracks = part(piece);
    dsw_detach_desc desc = defaults(dsw_detach_desc_init);
    desc.volume = id(start);
    desc.max_volumes = piece.size();
    desc.level = static_cast<dsw_level>(1 + rng_.below(4));
    if (seed % 4 == 0) desc.flags = DSW_BODY_SELF_CONTACTS;
    dsw_body_id body = {0, 0};
    const dsw_status status = dsw_environment_detach(dsw_scene_get_environment(scene_.get()), &desc, &body, &report_);
    ++tried[kind];
    if (status == DSW_STATUS_OCCUPIED) {
      ++refused[kind];
      EXPECT_EQ(boundary_faces(), before + 2 * cracks);
      continue;
    }
    ASSERT_EQ(status, DSW_STATUS_OK) << dsw_last_error_message() << ", seed " << seed;
    ++done;
    EXPECT_EQ(boundary_faces(), before);
    BodyState state;
    ASSERT_EQ(read_body(scene_.get(), body, state), "");
    check_space(piece, cracks);
    check_surface(piece, state);
    EXPECT_EQ(not_free(state, desc.level), "") << "seed " << seed;
    move_away(body, piece, desc.level);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  for (int kind = 0; kind < 3; ++kind) {
    RecordProperty("refused" + std::to_string(kind),
                   std::to_string(refused[kind]) + " of " + std::to_string(tried[kind]));
    if (effort_of(1) > 1)
      std::cout << "kind " << kind << ": " << refused[kind] << " of " << tried[kind] << " refused\n";
  }
  EXPECT_GT(done, 0u);
}

/// The environment as it is now.
std::unique_ptr<World> world_now(const dsw_environment* environment) {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  EXPECT_EQ(dsw_environment_get_info(environment, &info), DSW_STATUS_OK);
  Mesh mesh;
  const double* points = nullptr;
  size_t count = 0;
  EXPECT_EQ(dsw_environment_get_points(environment, &points, &count), DSW_STATUS_OK);
  for (size_t i = 0; i < count; ++i) mesh.points.push_back({points[3 * i], points[3 * i + 1], points[3 * i + 2]});
  World::Changed changed;
  std::vector<char> marked;
  for (uint32_t i = 0; i < info.volume_index_count; ++i) {
    dsw_volume_id v;
    if (dsw_environment_get_volume_id(environment, i, &v) != DSW_STATUS_OK) continue;
    uint32_t faces = 0;
    EXPECT_EQ(dsw_environment_get_volume_counts(environment, v, nullptr, nullptr, nullptr, &faces), DSW_STATUS_OK);
    std::vector<Loop> loops;
    changed.outer.emplace_back();
    for (uint32_t f = 0; f < faces; ++f) {
      loops.emplace_back();
      for (const dsw_vertex_id& at : vertices_of(environment, {DSW_CELL_FACE, v.index, v.generation, f})) {
        loops.back().push_back(static_cast<int>(at.index));
      }
      dsw_volume_id beyond;
      EXPECT_EQ(dsw_environment_get_neighbour(environment, v, f, &beyond, nullptr), DSW_STATUS_OK);
      changed.outer.back().push_back(beyond.generation == 0 ? 1 : 0);
    }
    int impassable = 0;
    EXPECT_EQ(dsw_environment_is_marked(environment, cell_of(v), &impassable), DSW_STATUS_OK);
    marked.push_back(static_cast<char>(impassable));
    changed.volumes.push_back(v);
    mesh.add_polyhedron(std::move(loops));
  }
  auto world = std::make_unique<World>(mesh, environment, changed);
  world->cell_marked = marked;
  return world;
}

/// What cuts leave of something impassable comes off, piece by piece.
TEST_P(DetachTest, WhatCutsPartComesOff) {
  const auto wanted = seeds_of(6);
  size_t done = 0, refused = 0;
  for (uint64_t seed = 1; seed <= wanted; ++seed) {
    rng_ = Rng(seed ^ 0xc07);
    scene_.reset();
    place_ = make_place(GetParam(), seed);
    if (place_.environment == nullptr) continue;
    ASSERT_PLACE(place_);
    dsw_environment_info info;
    info.struct_size = sizeof info;
    ASSERT_EQ(dsw_environment_get_info(place_.get(), &info), DSW_STATUS_OK);
    ASSERT_EQ(dsw_environment_mark_region(place_.get(), 0, DSW_MARK_IMPASSABLE, 0, nullptr, nullptr), DSW_STATUS_OK);
    for (int cuts = 1 + static_cast<int>(rng_.below(3)); cuts > 0; --cuts) {
      double blade[4][3], u[3], v[3];
      for (int k = 0; k < 3; ++k) u[k] = rng_.range(-10, 10) * world().size, v[k] = rng_.range(-10, 10) * world().size;
      for (int k = 0; k < 3; ++k) {
        const double share = rng_.range(0.35, 0.65), middle = share * info.lower[k] + (1 - share) * info.upper[k];
        for (int i = 0; i < 4; ++i) blade[i][k] = middle + (i < 2 ? -u[k] : u[k]) + (i % 2 == 0 ? -v[k] : v[k]);
      }
      dsw_cut_desc desc = defaults(dsw_cut_desc_init);
      desc.points = blade[0];
      desc.rows = desc.columns = 2;
      desc.flags = DSW_CUT_UNSEW;
      ASSERT_EQ(dsw_environment_cut(place_.get(), &desc, nullptr), DSW_STATUS_OK) << dsw_last_error_message();
    }
    if (dsw_environment_check(place_.get(), nullptr) != DSW_STATUS_OK) continue;
    scene_ = make_scene(place_.get());
    for (uint32_t i = 0; i < info.volume_count; i += 1 + info.volume_count / 3) {
      dsw_detach_desc desc = defaults(dsw_detach_desc_init);
      desc.level = static_cast<dsw_level>(1 + rng_.below(4));
      int impassable = 0;
      ASSERT_EQ(dsw_environment_get_volume_id(place_.get(), i, &desc.volume), DSW_STATUS_OK);
      ASSERT_EQ(dsw_environment_is_marked(place_.get(), cell_of(desc.volume), &impassable), DSW_STATUS_OK);
      if (impassable == 0) continue;
      dsw_body_id body;
      const dsw_status status = dsw_environment_detach(dsw_scene_get_environment(scene_.get()), &desc, &body, &report_);
      if (status == DSW_STATUS_OCCUPIED) {
        ++refused;
        if (effort_of(1) > 1) std::cout << "seed " << seed << ": " << dsw_last_error_message() << "\n";
        continue;
      }
      ASSERT_EQ(status, DSW_STATUS_OK) << dsw_last_error_message() << ", seed " << seed;
      ++done;
      place_.world = world_now(place_.get());
      ASSERT_EQ(world().fault(), "");
      BodyState state;
      ASSERT_EQ(read_body(scene_.get(), body, state), "");
      EXPECT_EQ(2 * state.edges.size(), 3 * state.faces.size());
      ASSERT_EQ(not_free(state, desc.level), "") << "seed " << seed;
    }
  }
  RecordProperty("refused", std::to_string(refused) + " of " + std::to_string(refused + done));
  if (effort_of(1) > 1) std::cout << "cut: " << refused << " of " << refused + done << " refused\n";
  EXPECT_GT(done, 0u);
}

}  // namespace
}  // namespace dsw::oracle
