#include "ours.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <set>
#include <stdexcept>

namespace dsw::bench {

void check(dsw_status status) {
  if (status != DSW_STATUS_OK) {
    throw std::runtime_error(std::string(dsw_status_string(status)) + ": " + dsw_last_error_message());
  }
}

namespace {

void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
  auto* use = static_cast<MemoryUse*>(user);
  void* memory = ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
  if (memory != nullptr) {
    use->now += bytes;
    use->most = std::max(use->most, use->now);
  }
  return memory;
}

void release(void* user, void* memory, std::size_t bytes, std::size_t alignment) {
  static_cast<MemoryUse*>(user)->now -= bytes;
  ::operator delete(memory, std::align_val_t(alignment));
}

std::uint64_t face_key(dsw_face_id face) { return static_cast<std::uint64_t>(face.volume) << 32 | face.local; }

}  // namespace

World::World(const scenes::VolumeMesh& mesh, std::uint32_t threads, bool count_memory, std::uint32_t kernel) {
  dsw_context_desc context_desc;
  dsw_context_desc_init(&context_desc, sizeof context_desc);
  context_desc.thread_count = threads;
  context_desc.kernel = kernel;
  if (count_memory) {
    context_desc.user = &memory_;
    context_desc.allocate = allocate;
    context_desc.release = release;
  }
  check(dsw_context_create(&context_desc, &context_));

  dsw_environment_desc desc;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.index_bytes = 4;
  desc.points = mesh.points.data();
  desc.point_count = mesh.point_count();
  desc.volume_count = mesh.cell_count();
  desc.connectivity = mesh.connectivity.data();
  desc.connectivity_count = mesh.connectivity.size();
  desc.regions = mesh.regions.empty() ? nullptr : mesh.regions.data();
  desc.uniform_cell_type = mesh.points_per_cell == 8   ? DSW_CELL_TYPE_HEXAHEDRON
                           : mesh.points_per_cell == 5 ? DSW_CELL_TYPE_PYRAMID
                                                       : DSW_CELL_TYPE_TETRA;
  build_report_.struct_size = sizeof build_report_;
  const dsw_status status = dsw_environment_create(context_, &desc, &environment_, &build_report_);
  if (status != DSW_STATUS_OK) dsw_context_destroy(context_);
  check(status);
}

World::World(const World& fine, std::vector<std::uint32_t>& map, dsw_coarsen_report& report) {
  check(dsw_environment_coarsen(fine.environment(), nullptr, &environment_, map.data(), map.size(), &report));
}

World::~World() {
  dsw_scene_destroy(scene_);
  dsw_environment_destroy(environment_);
  dsw_context_destroy(context_);
}

dsw_environment_info World::info() const {
  dsw_environment_info info{};
  info.struct_size = sizeof info;
  check(dsw_environment_get_info(environment_, &info));
  return info;
}

dsw_scene* World::scene(std::uint32_t features) {
  if (scene_ == nullptr) {
    dsw_scene_desc desc;
    dsw_scene_desc_init(&desc, sizeof desc);
    desc.features = features;
    check(dsw_scene_create(environment_, &desc, &scene_));
  }
  return scene_;
}

void World::close_scene() {
  check(dsw_scene_destroy(scene_));
  scene_ = nullptr;
}

std::vector<dsw_volume_id> volume_ids(const World& world, const std::vector<std::uint32_t>& cells) {
  std::vector<dsw_volume_id> ids(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    check(dsw_environment_get_volume_id(world.environment(), cells[i], &ids[i]));
  }
  return ids;
}

void mark_cells(World& world, const std::vector<std::uint8_t>& impassable) {
  std::vector<std::uint32_t> cells;
  for (std::uint32_t cell = 0; cell < impassable.size(); ++cell) {
    if (impassable[cell] != 0) cells.push_back(cell);
  }
  const auto ids = volume_ids(world, cells);
  check(dsw_environment_mark_volumes(world.environment(), ids.data(), ids.size(), DSW_MARK_IMPASSABLE, 0, nullptr));
}

void mark_triangles(World& world, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::size_t> offsets(triangles.size() + 1);
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    indices.insert(indices.end(), triangles[i].begin(), triangles[i].end());
    offsets[i + 1] = indices.size();
  }
  std::vector<dsw_face_id> faces(triangles.size());
  std::size_t missing = 0;
  check(dsw_environment_find_faces(world.environment(), faces.size(), offsets.data(), indices.data(), faces.data(),
                                   &missing));
  if (missing != 0) throw std::runtime_error("a face of the scene is not in the environment");
  check(dsw_environment_mark_faces(world.environment(), faces.data(), faces.size(), DSW_MARK_IMPASSABLE));
}

void adopt_triangulation(const World& world, const scenes::VolumeMesh& mesh, std::vector<scenes::Wall>& walls) {
  dsw_trace* trace = nullptr;
  check(dsw_trace_create(nullptr, &trace));
  check(dsw_trace_add_impassable(trace, world.environment(), 1, 0));
  dsw_trace_data data{};
  data.struct_size = sizeof data;
  check(dsw_trace_get_data(trace, &data));

  // The trace carries positions; points of the mesh are told apart by theirs, which are exact copies.
  using Position = std::array<double, 3>;
  const auto position = [](const double* xyz) { return Position{xyz[0], xyz[1], xyz[2]}; };
  std::vector<std::array<Position, 3>> triangles(data.triangle_count);
  for (std::size_t i = 0; i < data.triangle_count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      triangles[i][k] = position(data.points + 3 * std::size_t{data.triangles[3 * i + k]});
    }
    std::sort(triangles[i].begin(), triangles[i].end());
  }
  std::sort(triangles.begin(), triangles.end());
  for (scenes::Wall& wall : walls) {
    if (wall.vertex_count != 4) continue;
    bool found = false;
    for (const std::uint8_t diagonal : {std::uint8_t{0}, std::uint8_t{1}}) {
      wall.diagonal = diagonal;
      std::array<Position, 3> key;
      const auto triangle = wall.triangle(0);
      for (std::size_t k = 0; k < 3; ++k) key[k] = position(mesh.point(triangle[k]));
      std::sort(key.begin(), key.end());
      if (std::binary_search(triangles.begin(), triangles.end(), key)) {
        found = true;
        break;
      }
    }
    if (!found) {
      dsw_trace_destroy(trace);
      throw std::runtime_error("a wall of the scene is not impassable in the environment");
    }
  }
  check(dsw_trace_destroy(trace));
}

std::size_t locate_starts(const World& world, const std::vector<std::uint32_t>& cells, Segments& segments) {
  const std::size_t count = segments.count();
  const auto hints = volume_ids(world, cells);
  std::vector<dsw_location> locations(count);
  segments.starts.resize(count);
  check(dsw_environment_locate_points(world.environment(), segments.from.data(), count, 0, hints.data(),
                                      segments.starts.data(), locations.data()));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (locations[i] != DSW_LOCATION_PASSABLE) continue;
    segments.starts[kept] = segments.starts[i];
    std::copy_n(&segments.from[3 * i], 3, &segments.from[3 * kept]);
    std::copy_n(&segments.to[3 * i], 3, &segments.to[3 * kept]);
    ++kept;
  }
  segments.starts.resize(kept);
  segments.from.resize(3 * kept);
  segments.to.resize(3 * kept);
  return count - kept;
}

Ours::Ours(const World& world, const WallMesh& walls, std::uint32_t flags) : Engine("dartsweep"), world_(world) {
  dsw_cast_options_init(&options_, sizeof options_);
  options_.flags = flags;
  std::vector<std::size_t> offsets(walls.walls.size() + 1);
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < walls.walls.size(); ++i) {
    const auto& vertices = walls.walls[i].vertices;
    indices.insert(indices.end(), vertices.begin(), vertices.begin() + walls.walls[i].vertex_count);
    offsets[i + 1] = indices.size();
  }
  std::vector<dsw_face_id> faces(walls.walls.size());
  std::size_t missing = 0;
  check(dsw_environment_find_faces(world.environment(), faces.size(), offsets.data(), indices.data(), faces.data(),
                                   &missing));
  if (missing != 0) throw std::runtime_error("a wall of the scene is not a face of the environment");
  wall_of_face_.reserve(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) wall_of_face_[face_key(faces[i])] = i;
}

void Ours::prepare(const Segments& segments) {
  segments_ = segments;
  flights_.resize(segments.batch);
}

void Ours::run(std::size_t first, std::size_t count) {
  check(dsw_environment_cast_segments(world_.environment(), count, &segments_.starts[first], &segments_.from[3 * first],
                                      &segments_.to[3 * first], 0, &options_, flights_.data()));
}

Answer Ours::answer_of(const dsw_flight& flight) const {
  if (flight.outcome == DSW_OUTCOME_REACHED) return {};
  const auto found = wall_of_face_.find(face_key(flight.contact.wall));
  // An outcome or a face that cannot be is an index that no wall has: the exact check counts it as wrong.
  const bool sound = flight.outcome == DSW_OUTCOME_CONTACT && found != wall_of_face_.end();
  return {sound ? found->second : kNone - 1, flight.time};
}

Work count_work(World& world, const Segments& segments, std::size_t batches) {
  world.close_scene();
  dsw_scene* scene = world.scene(DSW_FEATURE_STATISTICS);
  Work work;
  dsw_cast_options options;
  dsw_cast_options_init(&options, sizeof options);
  std::vector<dsw_particle_id> particles(segments.batch);
  std::vector<dsw_flight> flights(segments.batch);
  for (std::size_t batch = 0; batch < batches; ++batch) {
    const std::size_t first = batch * segments.batch;
    if (first >= segments.count()) break;
    const std::size_t count = std::min(segments.batch, segments.count() - first);
    check(dsw_scene_create_particles(scene, &segments.from[3 * first], count, 0, &segments.starts[first],
                                     particles.data(), nullptr));
    check(dsw_scene_reset_statistics(scene));
    check(dsw_scene_cast_from_particles(scene, particles.data(), count, &segments.to[3 * first], 0, &options,
                                        flights.data()));
    dsw_statistics statistics{};
    statistics.struct_size = sizeof statistics;
    check(dsw_scene_get_statistics(scene, &statistics));
    work.casts += static_cast<double>(statistics.casts);
    work.cells += static_cast<double>(statistics.volumes_visited);
    work.orientation_tests += static_cast<double>(statistics.orientation_tests);
    work.exact_fallbacks += static_cast<double>(statistics.exact_fallbacks);
    work.ties += static_cast<double>(statistics.ties);
    work.contacts += static_cast<double>(statistics.contacts);
    for (std::size_t i = 0; i < count; ++i) check(dsw_particle_destroy(scene, particles[i]));
  }
  world.close_scene();
  return work;
}

}  // namespace dsw::bench
