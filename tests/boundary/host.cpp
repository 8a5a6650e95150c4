#include "host.h"

namespace boundary {
namespace {

constexpr uint32_t kEverything = 0x1f;  // all features

int append(void* user, const void* bytes, size_t size) {
  auto& all = *static_cast<Block*>(user);
  const auto* const from = static_cast<const unsigned char*>(bytes);
  all.insert(all.end(), from, from + size);
  return 0;
}

int forget_bytes(void*, const void*, size_t) { return 0; }

dsw_scene* make_scene(dsw_environment* environment, uint32_t features) {
  dsw_scene_desc desc;
  dsw_scene_desc_init(&desc, sizeof desc);
  desc.features = features;
  dsw_scene* scene = nullptr;
  need(dsw_scene_create(environment, &desc, &scene) == DSW_STATUS_OK, "a scene");
  return scene;
}

dsw_environment* make_environment(dsw_context* context, uint32_t dimension) {
  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  describe(desc, dimension);
  dsw_environment* environment = nullptr;
  need(dsw_environment_create(context, &desc, &environment, nullptr) == DSW_STATUS_OK, "an environment");
  return environment;
}

// Allocates memory that stays after its owner is destroyed: `user` keeps it.
void* take_for_good(void* user, size_t size, size_t alignment) {
  auto& all = *static_cast<std::vector<std::unique_ptr<unsigned char[]>>*>(user);
  all.emplace_back(new unsigned char[size + alignment]);
  const auto at = reinterpret_cast<uintptr_t>(all.back().get());
  return all.back().get() + (alignment - at % alignment) % alignment;
}
void keep(void*, void*, size_t, size_t) {}

Block make_recording(uint32_t dimension) {
  Block recording;
  dsw_environment* const environment = make_environment(nullptr, dimension);
  dsw_scene* const scene = make_scene(environment, kEverything);
  dsw_recording_desc to;
  dsw_recording_desc_init(&to, sizeof to);
  to.write = append;
  to.user = &recording;
  need(dsw_scene_start_recording(scene, &to) == DSW_STATUS_OK, "a recording");
  for (const double x : {0.5, 1.5}) {
    const double position[] = {x, 0.5, 0.5};
    dsw_particle_id particle;
    need(dsw_particle_create(scene, position, {0, 0}, &particle) == DSW_STATUS_OK, "a call to record");
  }
  dsw_scene_destroy(scene);
  dsw_environment_destroy(environment);
  return recording;
}

const Block& a_recording(uint32_t dimension) {
  static const Block recordings[2] = {make_recording(2), make_recording(3)};
  return recordings[dimension - 2];
}

Graveyard make_graveyard() {
  Graveyard dead = {};
  static std::vector<std::unique_ptr<unsigned char[]>> memory;
  dsw_context_desc desc;
  dsw_context_desc_init(&desc, sizeof desc);
  desc.user = &memory;
  desc.allocate = take_for_good;
  desc.release = keep;
  need(dsw_context_create(&desc, &dead.context) == DSW_STATUS_OK, "a context");
  dead.environment = make_environment(dead.context, 3);
  dead.scene = make_scene(dead.environment, 0);
  need(dsw_trace_create(dead.context, &dead.trace) == DSW_STATUS_OK, "a trace");
  need(dsw_replay_create(dead.context, a_recording(3).data(), a_recording(3).size(), &dead.replay) == DSW_STATUS_OK,
       "a replay");
  need(dsw_replay_destroy(dead.replay) == DSW_STATUS_OK && dsw_trace_destroy(dead.trace) == DSW_STATUS_OK &&
           dsw_scene_destroy(dead.scene) == DSW_STATUS_OK &&
           dsw_environment_destroy(dead.environment) == DSW_STATUS_OK &&
           dsw_context_destroy(dead.context) == DSW_STATUS_OK,
       "all go");
  alignas(64) static unsigned char zeros[1 << 14] = {};
  dead.zeros = zeros;
  return dead;
}

}  // namespace

Block save(const dsw_environment* environment) {
  size_t size = 0;
  need(dsw_environment_save(environment, nullptr, 0, &size) == DSW_STATUS_OK, "size of a snapshot");
  Block block(size);
  need(dsw_environment_save(environment, block.data(), size, &size) == DSW_STATUS_OK, "a snapshot");
  return block;
}

Block save(const dsw_scene* scene) {
  size_t size = 0;
  need(dsw_scene_save(scene, nullptr, 0, &size) == DSW_STATUS_OK, "size of a snapshot");
  Block block(size);
  need(dsw_scene_save(scene, block.data(), size, &size) == DSW_STATUS_OK, "a snapshot");
  return block;
}

const Graveyard& graveyard() {
  static const Graveyard dead = make_graveyard();
  return dead;
}

const Mesh& row_of_cells(uint32_t dimension) {
  static const auto make = [](uint32_t d) {
    Mesh m;
    for (int z = 0; z < (d == 2 ? 1 : 2); ++z) {
      for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 5; ++x) {
          m.points.insert(m.points.end(), {double(x), double(y)});
          if (d == 3) m.points.push_back(z);
        }
      }
    }
    const int64_t corners[] = {0, 1, 6, 5, 10, 11, 16, 15};
    for (int64_t x = 0; x < 4; ++x) {
      for (int k = 0; k < (d == 2 ? 4 : 8); ++k) m.connectivity.push_back(x + corners[k]);
    }
    return m;
  };
  static const Mesh meshes[2] = {make(2), make(3)};
  return meshes[dimension - 2];
}

void Host::make() {
  dsw_context_desc two_threads;
  dsw_context_desc_init(&two_threads, sizeof two_threads);
  two_threads.thread_count = 2;
  need(dsw_context_create(&two_threads, &context) == DSW_STATUS_OK, "a context");
  environment = make_environment(context, dimension);
  scene = make_scene(environment, kEverything);
  shared_environment = make_environment(context, dimension);
  shared_scene = make_scene(shared_environment, 0);
  need(dsw_trace_create(context, &trace) == DSW_STATUS_OK, "a trace");
  recording = a_recording(dimension);
  need(dsw_replay_create(context, recording.data(), recording.size(), &replay) == DSW_STATUS_OK, "a replay");
  for (int i = 0; i < 2; ++i) {
    const double position[] = {0.9, 0.8, 0.3 + 0.2 * i};  // in the plane both at one place
    need(dsw_particle_create(scene, position, {0, 0}, &particles[i]) == DSW_STATUS_OK, "a particle");
    const double at = 0.2 + 0.3 * i;
    const double corners[] = {at, at, at, at + 0.1, at, at, at, at + 0.1, at, at, at, at + 0.1};
    const double flat[] = {at, at, at + 0.1, at, at, at + 0.1, at + 0.1, at + 0.1};
    dsw_body_desc desc;
    dsw_body_desc_init(&desc, sizeof desc);
    describe(desc, dimension);
    desc.positions = dimension == 2 ? flat : corners;
    need(dsw_body_create(scene, &desc, &bodies[i]) == DSW_STATUS_OK, "a body");
  }
  next = row_of_cells(dimension).points;
  // The first change makes tables, also one that is refused; they are part of a snapshot.
  const dsw_face_id lips[] = {{1, 1, 1}, {2, 1, dimension == 2 ? 3u : 0u}};
  need(dsw_environment_unsew_face(environment, lips[0]) == DSW_STATUS_OK &&
           dsw_environment_sew_faces(environment, lips, lips + 1, 1) == DSW_STATUS_OK,
       "a change, and back");
  environment_block = save(environment);
  scene_block = save(scene);
  shared_block = save(shared_scene);
}

void Host::clear() {
  dsw_replay_destroy(replay);
  dsw_trace_destroy(trace);
  if (scene != nullptr) dsw_scene_destroy(scene);
  if (shared_scene != nullptr) dsw_scene_destroy(shared_scene);
  need(dsw_environment_destroy(environment) == DSW_STATUS_OK &&
           dsw_environment_destroy(shared_environment) == DSW_STATUS_OK &&
           dsw_context_destroy(context) == DSW_STATUS_OK,
       "a world goes");
}

void Host::forget(const void* handle) {
  if (handle == context) context = nullptr;
  if (handle == environment) environment = nullptr;
  if (handle == scene) scene = nullptr;
  if (handle == trace) trace = nullptr;
  if (handle == replay) replay = nullptr;
  if (handle == shared_environment) shared_environment = nullptr;
  if (handle == shared_scene) shared_scene = nullptr;
}

bool Host::is_unchanged() const {
  return save(environment) == environment_block && save(scene) == scene_block && save(shared_scene) == shared_block;
}

void describe(dsw_environment_desc& d, uint32_t dimension) {
  const Mesh& mesh = row_of_cells(dimension);
  d.dimension = dimension;
  d.points = mesh.points.data();
  d.point_count = mesh.points.size() / dimension;
  if (dimension == 2) d.uniform_cell_type = DSW_CELL_TYPE_QUAD;
  d.volume_count = mesh.connectivity.size() / (dimension == 2 ? 4 : 8);
  d.connectivity = mesh.connectivity.data();
  d.connectivity_count = mesh.connectivity.size();
}

void describe(dsw_body_desc& d, uint32_t dimension) {
  static const double flat[] = {0.2, 0.8, 0.3, 0.8, 0.2, 0.9, 0.3, 0.9};
  static const double positions[] = {0.2, 0.8, 0.2, 0.3, 0.8, 0.2, 0.2, 0.9, 0.2, 0.2, 0.8, 0.3};
  static const uint32_t edges[] = {0, 1, 1, 2, 2, 3}, offsets[] = {0, 3, 6}, corners[] = {0, 1, 2, 0, 2, 3};
  d.level = DSW_LEVEL_EDGES_SWEPT;
  d.positions = dimension == 2 ? flat : positions;
  d.vertex_count = 4;
  d.edges = edges;
  d.edge_count = 3;
  if (dimension == 2) return;
  d.face_offsets = offsets;
  d.face_corners = corners;
  d.face_count = 2;
  d.face_corner_count = 6;
}

/** A simplex on its own. */
void describe(dsw_volumes_desc& d, uint32_t dimension) {
  static const double points[] = {9, 0, 0, 10, 0, 0, 9, 1, 0, 9, 0, 1}, flat[] = {9, 0, 10, 0, 9, 1};
  static const int64_t connectivity[] = {0, 1, 2, 3};
  d.points = dimension == 2 ? flat : points;
  d.point_count = dimension + 1;
  d.uniform_cell_type = dimension == 2 ? DSW_CELL_TYPE_TRIANGLE : DSW_CELL_TYPE_TETRA;
  d.volume_count = 1;
  d.connectivity = connectivity;
  d.connectivity_count = dimension + 1;
}

/** Across the third cube. */
void describe(dsw_cut_desc& d, uint32_t dimension) {
  static const double flat[2 * 256] = {2.5, -1, 2.5, 2};
  static const double points[3 * 256] = {2.5, -1, -1, 2.5, 2, -1,
                                         2.5, -1, 2,  2.5, 2, 2};  // room for more rows than two
  d.points = dimension == 2 ? flat : points;
  d.rows = 2;
  d.columns = dimension - 1;
}

void describe(dsw_open_crack_desc& d, uint32_t dimension) {
  static const dsw_cut_face faces[] = {{{2, 1, 1}, {3, 1, 0}}}, sides[] = {{{2, 1, 1}, {3, 1, 3}}};
  d.faces = dimension == 2 ? sides : faces;
  d.face_count = 1;
  d.width = 0.1;
}

void describe(dsw_carve_desc& d, uint32_t dimension) {
  static const double flat[] = {2.2, 0.2, 2.8, 0.2, 2.2, 0.8};
  static const uint32_t segments[] = {0, 1, 1, 2, 2, 0};
  static const double points[] = {2.2, 0.2, 0.2, 2.8, 0.2, 0.2, 2.2, 0.8, 0.2, 2.2, 0.2, 0.8};
  static const uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  d.points = dimension == 2 ? flat : points;
  d.point_count = d.triangle_count = dimension + 1;
  d.triangles = dimension == 2 ? segments : triangles;
}

void describe(dsw_tie_desc& d, uint32_t dimension) {
  static const double points[] = {2.5, -1, -1, 2.5, 3, -1, 2.5, 1, 4}, flat[] = {2.5, -1, 2.5, 3};
  d.points = dimension == 2 ? flat : points;
  d.point_count = dimension;
}

void describe(dsw_detach_desc& d, uint32_t) { d.volume = {3, 1}; }

void describe(dsw_recording_desc& d, uint32_t) { d.write = forget_bytes; }

}  // namespace boundary
