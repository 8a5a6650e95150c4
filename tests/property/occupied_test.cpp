// Marking with bodies in the way, against exact arithmetic that looks at every obstacle: a call is refused if and only
// if a body or particle would meet what becomes impassable, changes nothing then, and names all that are in the way;
// what skipping leaves out would be refused by itself.
#include "support.h"

#include <algorithm>

#include "run.h"
#include "sweep_scenes.h"
#include "sweep_truth.h"

namespace dsw::oracle {
namespace {

class OccupiedTest : public SceneTest {};
std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const SceneKind& kind : sweep_scenes()) all.emplace_back(kind.name);
  return all;
}
INSTANTIATE_TEST_SUITE_P(All, OccupiedTest, testing::ValuesIn(drawn_for("OccupiedTest", names())),
                         [](const testing::TestParamInfo<std::string>& i) { return i.param; });

struct TestBody {
  dsw_body_id id{};
  dsw_level level = DSW_LEVEL_POINTS;
  std::vector<Vec> points;
  std::vector<std::array<uint32_t, 2>> edges;  // those of faces included
  std::vector<std::array<uint32_t, 3>> faces;
};

struct Request {
  dsw_mark mark = DSW_MARK_IMPASSABLE;
  enum Kind { kVolumes, kFaces, kEdges, kVertices, kRegion, kBetween, kKinds } kind = kVolumes;
  bool skip = false;
  std::vector<size_t> items;  // volumes, faces, edges or vertices of the model
  int a = 0, b = 0;           // regions
};

Place place_with_regions(const std::string& name, uint64_t seed) {
  Rng rng(seed);
  Mesh mesh;
  for (const SceneKind& kind : sweep_scenes()) {
    if (name == kind.name) mesh = kind.make(rng);
  }
  shuffle_cells(mesh, rng);
  for (size_t c = 0; c < mesh.cells.size(); ++c) mesh.regions.push_back(rng.between(-1, 6));
  return place_of(std::move(mesh));
}

/// A scene with bodies and particles, and the marks as they ought to be.
class Trial {
 public:
  Trial(Place& place, uint64_t seed, uint32_t features)
      : place_(place),
        world_(*place.world),
        edges_(world_),
        edge_marked_(edges_.edges.size()),
        points_marked_(place.mesh.points.size()),
        rng_(seed),
        motions_(world_, rng_),
        scene_(make_scene(place.get(), features)) {
    std::vector<bool> used(points_marked_.size());
    for (const Face& f : world_.faces) {
      for (int v : f.loop) used[static_cast<size_t>(v)] = true;
    }
    for (size_t v = 0; v < used.size(); ++v) {
      if (used[v]) vertices_.push_back(v);
    }
  }

  void add_particle();
  void add_body();
  void move_a_body();
  Request random_request();
  void call(const Request& request);
  size_t body_count() const { return bodies_.size(); }

  size_t refused = 0, applied = 0, left_out = 0;

 private:
  using Marks = std::vector<char>;

  Vec some_point();
  bool is_free(const TestBody& body, SweepWorld& exact);
  void set(const Request& request);
  Marks wanted() const;
  Marks read() const;
  void restore(const Marks& marks);
  std::vector<std::array<int, 2>> marked_edges() const;
  std::vector<uint32_t> bodies_in_the_way();
  std::vector<uint32_t> particles_in_the_way();
  dsw_status ask(const Request& request, size_t* skipped);
  void check_skipped(const Request& request, const Marks& before, size_t skipped);
  void check_free();
  dsw_volume_id volume(size_t i) const { return world_.ids[i]; }

  Place& place_;
  World& world_;
  Edges edges_;
  std::vector<char> edge_marked_, points_marked_;
  std::vector<size_t> vertices_;  // that cells use
  Rng rng_;
  Motions motions_;
  ScenePtr scene_;
  std::vector<TestBody> bodies_;
  std::vector<std::pair<dsw_particle_id, Vec>> particles_;
};

Vec Trial::some_point() {
  const Vec p = motions_.start();
  if (bodies_.empty() || rng_.chance(0.7)) return p;
  const std::vector<Vec>& others = bodies_[rng_.below(bodies_.size())].points;
  return others[rng_.below(others.size())];
}

void Trial::add_particle() {
  const Vec p = some_point();
  dsw_particle_id id;
  if (dsw_particle_create(scene_.get(), p.data(), {0, 0}, &id) == DSW_STATUS_OK) particles_.push_back({id, p});
}

void Trial::add_body() {
  TestBody body;
  body.level = static_cast<dsw_level>(rng_.between(DSW_LEVEL_POINTS, DSW_LEVEL_FACES));
  if (rng_.chance(0.3)) body.level = DSW_LEVEL_FACES;
  const double reach = world_.size * (rng_.chance(0.5) ? 0.15 : 0.6);
  const Vec middle = some_point();
  const auto near = [&] {
    Vec p = rng_.chance(0.3) ? some_point() : middle;
    if (p == middle) {
      for (double& x : p) x += rng_.range(-reach, reach);
    }
    return p;
  };
  const int count = rng_.between(1, 5);
  for (int i = 0; i < count; ++i) body.points.push_back(i == 0 ? middle : near());
  const auto last = static_cast<uint32_t>(count - 1);
  if (count >= 3 && rng_.chance(0.7)) {  // a fan round vertex 0, or the surface of a tetrahedron
    for (uint32_t i = 1; i < last; ++i) body.faces.push_back({0, i, i + 1});
    if (count == 4 && rng_.chance(0.5)) body.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  } else {
    for (uint32_t i = 0; i < last; ++i) body.edges.push_back({i, i + 1});
  }
  std::vector<uint32_t> offsets = {0}, corners;
  for (const auto& f : body.faces) {
    corners.insert(corners.end(), f.begin(), f.end());
    offsets.push_back(static_cast<uint32_t>(corners.size()));
  }
  dsw_body_desc desc = defaults(dsw_body_desc_init);
  desc.level = body.level;
  desc.positions = body.points[0].data();
  desc.vertex_count = body.points.size();
  desc.edges = body.edges.empty() ? nullptr : body.edges[0].data();
  desc.edge_count = body.edges.size();
  desc.face_offsets = offsets.data();
  desc.face_corners = corners.data();
  desc.face_count = body.faces.size();
  desc.face_corner_count = corners.size();
  const dsw_status status = dsw_body_create(scene_.get(), &desc, &body.id);
  for (const auto& f : body.faces) {
    for (size_t k = 0; k < 3; ++k) body.edges.push_back({f[k], f[(k + 1) % 3]});
  }
  SweepWorld exact(world_, marked_edges());
  EXPECT_EQ(status == DSW_STATUS_OK, is_free(body, exact)) << dsw_last_error_message();
  if (status == DSW_STATUS_OK) bodies_.push_back(body);
}

void Trial::move_a_body() {
  if (bodies_.empty()) return;
  TestBody& body = bodies_[rng_.below(bodies_.size())];
  std::vector<Vec> targets;
  for (const Vec& p : body.points) targets.push_back(rng_.chance(0.5) ? p : motions_.target(p));
  for (Vec& t : targets) {
    for (double& x : t) x = std::min(std::max(x, -1e6 * world_.size), 1e6 * world_.size);
  }
  ASSERT_EQ(dsw_body_move(scene_.get(), body.id, targets[0].data(), targets.size(), 0, nullptr, nullptr), DSW_STATUS_OK)
      << dsw_last_error_message();
  size_t count = 0;
  ASSERT_EQ(
      dsw_body_get_positions(scene_.get(), body.id, body.points[0].data(), body.points.size(), 0, nullptr, &count),
      DSW_STATUS_OK);
  ASSERT_EQ(count, body.points.size());
  SweepWorld exact(world_, marked_edges());
  EXPECT_TRUE(is_free(body, exact)) << "after a move at level " << body.level;
}

/// By the truth: every obstacle is looked at.
bool Trial::is_free(const TestBody& body, SweepWorld& exact) {
  for (const Vec& p : body.points) {
    const int cell = world_.locate(world_.body(p.data()));
    if (cell < 0 || world_.cell_marked[static_cast<size_t>(cell)] != 0) return false;
  }
  if (body.level == DSW_LEVEL_POINTS) return true;
  for (const auto& e : body.edges) {
    if (exact.blocked(body.points[e[0]], body.points[e[1]])) return false;
  }
  if (body.level != DSW_LEVEL_FACES) return true;
  return std::all_of(body.faces.begin(), body.faces.end(), [&](const auto& f) {
    return exact.sweep(body.points[f[0]], body.points[f[1]], body.points[f[2]]).swept.empty();
  });
}

Request Trial::random_request() {
  Request r;
  r.kind = static_cast<Request::Kind>(rng_.below(static_cast<int>(Request::kKinds)));
  r.mark = rng_.chance(0.7) ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE;
  r.skip = (r.kind == Request::kVolumes || r.kind == Request::kRegion) && rng_.chance(0.5);
  r.a = rng_.between(-1, 6);
  r.b = rng_.between(-1, 6);
  const size_t sizes[] = {world_.ids.size(), world_.faces.size(), edges_.edges.size(), vertices_.size()};
  if (r.kind > Request::kVertices) return r;
  const size_t all = sizes[r.kind];
  for (int n = rng_.chance(0.15) ? rng_.between(5, 80) : rng_.between(1, 3); n > 0; --n) {
    r.items.push_back(r.kind == Request::kVertices ? vertices_[rng_.below(all)] : rng_.below(all));
  }
  return r;
}

/// Sets the model's marks.
void Trial::set(const Request& r) {
  const bool on = r.mark == DSW_MARK_IMPASSABLE;
  for (const size_t i : r.items) {
    if (r.kind == Request::kVolumes) world_.cell_marked[i] = on;
    if (r.kind == Request::kFaces) world_.faces[i].marked = on;
    if (r.kind == Request::kEdges) edge_marked_[i] = on;
    if (r.kind == Request::kVertices) points_marked_[i] = on;
  }
  const auto region = [&](int cell) { return place_.mesh.regions[static_cast<size_t>(cell)]; };
  for (size_t c = 0; r.kind == Request::kRegion && c < world_.ids.size(); ++c) {
    if (region(static_cast<int>(c)) == r.a) world_.cell_marked[c] = on;
  }
  for (Face& f : world_.faces) {
    if (r.kind != Request::kBetween || f.cell[1] < 0) continue;
    const int x = region(f.cell[0]), y = region(f.cell[1]);
    if ((x == r.a && y == r.b) || (x == r.b && y == r.a)) f.marked = on;
  }
}

/// All marks in one row: volumes, faces, edges, vertices.
Trial::Marks Trial::wanted() const {
  Marks marks(world_.cell_marked);
  for (const Face& f : world_.faces) marks.push_back(f.marked);
  marks.insert(marks.end(), edge_marked_.begin(), edge_marked_.end());
  for (const size_t v : vertices_) marks.push_back(points_marked_[v]);
  return marks;
}

Trial::Marks Trial::read() const {
  Marks marks;
  const auto ask_for = [&](dsw_cell cell) {
    int answer = -1;
    EXPECT_EQ(dsw_environment_is_marked(place_.get(), cell, &answer), DSW_STATUS_OK);
    marks.push_back(static_cast<char>(answer));
  };
  for (const dsw_volume_id id : world_.ids) ask_for(cell_of(id));
  for (size_t f = 0; f < world_.faces.size(); ++f) ask_for(cell_of(face_id(world_, static_cast<int>(f))));
  for (size_t e = 0; e < edge_marked_.size(); ++e) ask_for(cell_of(edges_.id(world_, static_cast<int>(e))));
  for (const size_t v : vertices_) ask_for(cell_of(dsw_vertex_id{static_cast<uint32_t>(v), 1}));
  return marks;
}

void Trial::restore(const Marks& marks) {
  size_t at = 0;
  for (char& c : world_.cell_marked) c = marks[at++];
  for (Face& f : world_.faces) f.marked = marks[at++] != 0;
  for (char& w : edge_marked_) w = marks[at++];
  for (const size_t v : vertices_) points_marked_[v] = marks[at++];
}

std::vector<std::array<int, 2>> Trial::marked_edges() const {
  std::vector<std::array<int, 2>> list;
  for (size_t e = 0; e < edge_marked_.size(); ++e) {
    if (edge_marked_[e] != 0) list.push_back(edges_.edges[e].ends);
  }
  return list;
}

std::vector<uint32_t> Trial::bodies_in_the_way() {
  SweepWorld exact(world_, marked_edges());
  std::vector<uint32_t> list;
  for (const TestBody& body : bodies_) {
    if (!is_free(body, exact)) list.push_back(body.id.index);
  }
  return list;
}

std::vector<uint32_t> Trial::particles_in_the_way() {
  std::vector<uint32_t> list;
  for (const auto& [id, at] : particles_) {
    if (world_.cell_marked[static_cast<size_t>(world_.locate(world_.body(at.data())))] != 0) list.push_back(id.index);
  }
  return list;
}

dsw_status Trial::ask(const Request& r, size_t* skipped) {
  std::vector<dsw_volume_id> volumes;
  std::vector<dsw_face_id> faces;
  std::vector<dsw_edge_id> edges;
  std::vector<dsw_vertex_id> vertices;
  const uint32_t flags = r.skip ? DSW_MARK_SKIP_OCCUPIED : 0;
  dsw_environment* const env = place_.get();
  for (const size_t i : r.items) {
    if (r.kind == Request::kVolumes) volumes.push_back(world_.ids[i]);
    if (r.kind == Request::kFaces) faces.push_back(face_id(world_, static_cast<int>(i)));
    if (r.kind == Request::kEdges) edges.push_back(edges_.id(world_, static_cast<int>(i)));
    if (r.kind == Request::kVertices) vertices.push_back({static_cast<uint32_t>(i), 1});
  }
  switch (r.kind) {
    case Request::kVolumes:
      return dsw_environment_mark_volumes(env, volumes.data(), volumes.size(), r.mark, flags, skipped);
    case Request::kFaces:
      return dsw_environment_mark_faces(env, faces.data(), faces.size(), r.mark);
    case Request::kEdges:
      return dsw_environment_mark_edges(env, edges.data(), edges.size(), r.mark);
    case Request::kVertices:
      return dsw_environment_mark_vertices(env, vertices.data(), vertices.size(), r.mark);
    case Request::kRegion:
      return dsw_environment_mark_region(env, r.a, r.mark, flags, nullptr, skipped);
    default:
      return dsw_environment_mark_between(env, r.a, r.b, r.mark, nullptr);
  }
}

void Trial::call(const Request& r) {
  const Marks before = wanted();
  set(r);
  const std::vector<uint32_t> bodies = bodies_in_the_way(), particles = particles_in_the_way();
  const bool occupied = !bodies.empty() || !particles.empty();
  size_t skipped = 0;
  const dsw_status status = ask(r, &skipped);
  ASSERT_EQ(status, occupied && !r.skip ? DSW_STATUS_OCCUPIED : DSW_STATUS_OK)
      << "kind " << r.kind << ": " << dsw_last_error_message();
  const dsw_body_id* who = nullptr;
  size_t count = 0;
  ASSERT_EQ(dsw_scene_get_occupant_bodies(scene_.get(), &who, &count), DSW_STATUS_OK);
  std::vector<uint32_t> named;
  for (size_t i = 0; i < count; ++i) named.push_back(who[i].index);
  EXPECT_EQ(named, bodies);
  const dsw_particle_id* holders = nullptr;
  ASSERT_EQ(dsw_scene_get_occupants(scene_.get(), &holders, &count), DSW_STATUS_OK);
  named.clear();
  for (size_t i = 0; i < count; ++i) named.push_back(holders[i].index);
  EXPECT_EQ(named, particles);
  if (status != DSW_STATUS_OK) {
    ++refused;
    restore(before);
  } else {
    ++applied;
    if (r.skip && r.mark == DSW_MARK_IMPASSABLE) check_skipped(r, before, skipped);
  }
  EXPECT_EQ(read(), wanted()) << "kind " << r.kind << " status " << status;
  check_free();
}

/// What was left out, taken over into the model, is occupied: marked alone it is refused.
void Trial::check_skipped(const Request& r, const Marks& before, size_t skipped) {
  const Marks all = wanted(), after = read();
  std::vector<size_t> gone;
  for (size_t c = 0; c < world_.ids.size(); ++c) {
    if (all[c] != 0 && after[c] == 0) gone.push_back(c);
  }
  EXPECT_EQ(gone.size(), skipped) << "kind " << r.kind;
  for (const size_t c : gone) {
    EXPECT_EQ(before[c], 0);
    world_.cell_marked[c] = 0;
  }
  left_out += gone.size();
  for (const size_t c : gone) {
    world_.cell_marked[c] = 1;
    const bool occupied = !bodies_in_the_way().empty() || !particles_in_the_way().empty();
    world_.cell_marked[c] = 0;
    EXPECT_TRUE(occupied) << "volume " << c << " was left out for nothing";
    EXPECT_EQ(dsw_environment_mark_volumes(place_.get(), &world_.ids[c], 1, DSW_MARK_IMPASSABLE, 0, nullptr),
              DSW_STATUS_OCCUPIED);
  }
}

/// All bodies are free: by the truth, and by casts and sweeps that know nothing of bodies.
void Trial::check_free() {
  EXPECT_TRUE(bodies_in_the_way().empty());
  EXPECT_TRUE(particles_in_the_way().empty());
  dsw_environment* const env = place_.get();
  for (const TestBody& body : bodies_) {
    for (const auto& e : body.edges) {
      if (body.level == DSW_LEVEL_POINTS) break;
      dsw_flight flight;
      ASSERT_EQ(dsw_environment_cast(env, {0, 0}, body.points[e[0]].data(), body.points[e[1]].data(), nullptr, &flight),
                DSW_STATUS_OK);
      EXPECT_EQ(flight.outcome, DSW_OUTCOME_REACHED);
    }
    for (const auto& f : body.faces) {
      if (body.level != DSW_LEVEL_FACES) break;
      dsw_sweep sweep;
      ASSERT_EQ(dsw_environment_sweep_edges(env, 1, nullptr, body.points[f[0]].data(), body.points[f[1]].data(),
                                            body.points[f[2]].data(), 0, nullptr, &sweep),
                DSW_STATUS_OK);
      EXPECT_EQ(sweep.outcome, DSW_OUTCOME_REACHED);
    }
  }
}

TEST_P(OccupiedTest, RefusedOrLeftOutIfAndOnlyIfSomethingIsInTheWay) {
  size_t refused = 0, applied = 0, left_out = 0;
  for (const uint64_t seed : {61u, 62u}) {
    Place place = place_with_regions(GetParam(), seed);
    ASSERT_PLACE(place);
    Trial trial(place, seed, seed == 61 ? 0 : DSW_FEATURE_LIVE_CHANGES);
    for (int tries = 0; tries < 30 && trial.body_count() < 4; ++tries) trial.add_body();
    trial.add_particle();
    for (int round = 0; round < at_least(40) && !HasFatalFailure(); ++round) {
      if (round % 3 == 0) trial.move_a_body();
      if (round % 8 == 7) trial.add_body();
      trial.call(trial.random_request());
    }
    refused += trial.refused;
    applied += trial.applied;
    left_out += trial.left_out;
  }
  RecordProperty("refused", static_cast<int>(refused));
  RecordProperty("applied", static_cast<int>(applied));
  RecordProperty("left_out", static_cast<int>(left_out));
  EXPECT_GT(applied, 0u);
  EXPECT_GT(refused + left_out, 0u);
}

}  // namespace
}  // namespace dsw::oracle
