#include "use.h"

#include <algorithm>
#include <cmath>

namespace dsw_fuzz {
namespace {

/** Bytes from here on choose a sweep, a body; below, the last two bits choose. */
constexpr uint8_t kSweep = 0xc0, kBody = 0xa0;

bool is_finite(const double* xyz) { return std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]); }

dsw_volume_id pick_volume(const dsw_environment* environment, Bytes* bytes) {
  dsw_volume_id id = {0, 0};
  const uint32_t index = bytes->below(info_of(environment).volume_count + 1);
  dsw_environment_get_volume_id(environment, index, &id);  // one past the end leaves null
  return id;
}

/** In the plane a point has two coordinates. */
void read_point(const dsw_environment* environment, Bytes* bytes, double* xyz) {
  bytes->point(xyz);
  if (info_of(environment).dimension == 2) xyz[2] = 0;
}

void locate_something(const dsw_environment* environment, bool is_partition, Bytes* bytes) {
  double point[3];
  read_point(environment, bytes, point);
  dsw_volume_id volume = {0, 0}, hinted = {0, 0};
  const dsw_volume_id hint = pick_volume(environment, bytes), none = {0, 0};
  dsw_location location = DSW_LOCATION_NONE;
  const dsw_status status = dsw_environment_locate(environment, point, none, &volume, &location);
  require((status == DSW_STATUS_OK) == is_finite(point), "locate answers every finite point and no other");
  if (status != DSW_STATUS_OK) return;
  require((location == DSW_LOCATION_OUTSIDE) == (volume.generation == 0), "outside is the null id");
  require(dsw_environment_locate(environment, point, hint, &hinted, nullptr) == DSW_STATUS_OK, "locate with a hint");
  if (is_partition) {
    require(hinted.index == volume.index && hinted.generation == volume.generation, "a hint changes no answer");
  }
  if (location == DSW_LOCATION_OUTSIDE) return;
  dsw_cell cell;
  require(dsw_environment_classify(environment, point, volume, &cell) == DSW_STATUS_OK, "a located point has a cell");
  dsw_nearest nearest;
  const dsw_status near =
      dsw_environment_find_nearest(environment, point, volume, std::fabs(bytes->number()), &nearest);
  require(near != DSW_STATUS_OUTSIDE && near != DSW_STATUS_INTERNAL, "nearest from a located point");
}

/** What a report of a swept edge always promises. */
void check_sweep(const dsw_sweep& s, bool is_limited) {
  require(s.outcome != DSW_OUTCOME_NONE && s.outcome <= DSW_OUTCOME_IMPASSABLE, "a sweep ends somewhere");
  require(s.outcome != DSW_OUTCOME_WORK_LIMIT || is_limited, "work is limited on demand only");
  require(s.time >= 0.0 && s.time <= 1.0 && is_finite(s.position), "a sweep ends at a time and a place");
  require(s.outcome != DSW_OUTCOME_REACHED || s.time == 1.0, "what came through came through");
  require((s.outcome == DSW_OUTCOME_OUTSIDE) == (s.volume.generation == 0), "the moving end has a volume");
  const bool contact = s.outcome == DSW_OUTCOME_CONTACT;
  require(contact == (s.contact.kind != DSW_CONTACT_NONE) && contact == (s.contact.front.generation != 0),
          "a contact, or none");
  require((s.contact.obstacle.kind == DSW_CELL_NONE) == !contact, "a contact has an obstacle");
  require((s.contact.marked_kind == DSW_CELL_FACE || s.contact.marked_kind == DSW_CELL_VOLUME) ==
              (s.contact.wall.generation != 0),
          "met a face");
  require((s.contact.marked_kind == DSW_CELL_NONE) != contact, "a contact has a mark");
  if (!contact) return;
  require(is_finite(s.point) && s.edge_parameter >= 0.0 && s.edge_parameter <= 1.0,
          "a contact has a place on the edge");
  require(is_unit(s.contact.normal), "a contact has a unit normal");
}

void sweep_something(const dsw_environment* environment, bool is_partition, Bytes* bytes) {
  double from[3], to[3], fixed[3];
  const dsw_volume_id start = pick_volume(environment, bytes);
  dsw_sweep_options options;
  dsw_sweep_options_init(&options, sizeof options);
  options.max_volumes = bytes->below(16) * 2;
  for (double* each : {from, to, fixed}) read_point(environment, bytes, each);
  const bool is_limited = options.max_volumes != 0;
  dsw_sweep found[DSW_LEVEL_EDGES_SWEPT + 1];
  for (int level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
    options.level = static_cast<dsw_level>(level);
    const dsw_status status =
        dsw_environment_sweep_edges(environment, 1, &start, from, to, fixed, 0, &options, &found[level]);
    require((status == DSW_STATUS_OK) == (is_finite(from) && is_finite(to) && is_finite(fixed)),
            "every finite edge is swept and no other");
    if (status != DSW_STATUS_OK) return;
    check_sweep(found[level], is_limited);
  }
  if (!is_partition || is_limited) return;
  const dsw_sweep &points = found[DSW_LEVEL_POINTS], &edges = found[DSW_LEVEL_EDGES],
                  &swept = found[DSW_LEVEL_EDGES_SWEPT];
  require(points.outcome != DSW_OUTCOME_CONTACT || edges.outcome == DSW_OUTCOME_CONTACT, "edges see what points see");
  require(edges.outcome != DSW_OUTCOME_CONTACT || swept.outcome == DSW_OUTCOME_CONTACT,
          "the sweep sees what edges see");
  require(points.outcome != DSW_OUTCOME_CONTACT || swept.time <= points.time, "nothing is met later than at its end");
  require(edges.outcome != DSW_OUTCOME_CONTACT || swept.time == edges.time, "a contact of edges is that of the sweep");
}

void move_particle(dsw_scene* scene, bool is_partition, Bytes* bytes) {
  const dsw_environment* environment = dsw_scene_get_environment(scene);
  double position[3], target[3];
  read_point(environment, bytes, position);
  dsw_particle_id particle;
  if (dsw_particle_create(scene, position, pick_volume(environment, bytes), &particle) != DSW_STATUS_OK) return;
  for (int step = 0; step < 3 && !bytes->empty(); ++step) {
    read_point(environment, bytes, target);
    dsw_cast_options options;
    dsw_cast_options_init(&options, sizeof options);
    options.max_volumes = bytes->below(4);
    dsw_flight flight;
    const dsw_status status = dsw_particle_move(scene, particle, target, &options, &flight);
    require((status == DSW_STATUS_OK) == is_finite(target), "a move to every finite target and no other");
    if (status != DSW_STATUS_OK) continue;
    dsw_volume_id volume, found;
    dsw_location location;
    require(dsw_particle_get_position(scene, particle, position, &volume) == DSW_STATUS_OK, "a particle can be read");
    require(is_finite(position) && flight.time >= 0.0 && flight.time <= 1.0, "position and time are numbers");
    require(dsw_environment_locate(environment, position, volume, &found, &location) == DSW_STATUS_OK,
            "locate a particle");
    if (!is_partition) continue;
    require(found.index == volume.index && found.generation == volume.generation, "a particle lies in its volume");
    require(location == DSW_LOCATION_PASSABLE, "a particle is free");
  }
}

}  // namespace

dsw_environment_info info_of(const dsw_environment* environment) {
  dsw_environment_info info = {};
  info.struct_size = sizeof info;
  require(dsw_environment_get_info(environment, &info) == DSW_STATUS_OK, "info");
  return info;
}

dsw_flight cast(const dsw_environment* environment, dsw_volume_id start, const double* from, const double* to,
                dsw_status* status) {
  dsw_flight flight = {};
  *status = dsw_environment_cast(environment, start, from, to, nullptr, &flight);
  require((*status == DSW_STATUS_OK) == (is_finite(from) && is_finite(to)), "a cast between all finite points");
  if (*status != DSW_STATUS_OK) return flight;
  require(flight.outcome != DSW_OUTCOME_NONE && flight.outcome != DSW_OUTCOME_WORK_LIMIT, "a cast ends somewhere");
  require(flight.time >= 0.0 && flight.time <= 1.0, "a time is a fraction");
  return flight;
}

void mark_something(dsw_environment* environment, Bytes* bytes) {
  const dsw_volume_id volume = pick_volume(environment, bytes);
  const dsw_mark mark = bytes->below(4) != 0 ? DSW_MARK_IMPASSABLE : DSW_MARK_PASSABLE;
  size_t count = 0;
  switch (bytes->below(6)) {
    case 0:
      dsw_environment_mark_volumes(environment, &volume, 1, mark, DSW_MARK_SKIP_OCCUPIED, &count);
      break;
    case 1:
      dsw_environment_mark_region(environment, bytes->byte(), mark, 0, &count, nullptr);
      break;
    case 2:
      dsw_environment_mark_between(environment, bytes->byte() % 3, bytes->byte() % 3, mark, &count);
      break;
    case 3: {
      const dsw_edge_id edge = {volume.index, volume.generation, bytes->byte()};
      dsw_environment_mark_edges(environment, &edge, 1, mark);
      break;
    }
    case 4: {
      const dsw_vertex_id vertex = {bytes->byte(), 1};
      dsw_environment_mark_vertices(environment, &vertex, 1, mark);
      break;
    }
    default: {
      const dsw_face_id face = {volume.index, volume.generation, bytes->below(8)};
      dsw_environment_mark_faces(environment, &face, 1, mark);
      dsw_environment_mark_exits(environment, &face, 1, mark == DSW_MARK_PASSABLE ? 0 : 1 + volume.index % 3);
    }
  }
}

void use_environment(dsw_environment* environment, bool is_partition, Bytes* bytes) {
  dsw_scene* scene = nullptr;
  require(dsw_scene_create(environment, nullptr, &scene) == DSW_STATUS_OK, "a scene");
  for (int step = 0; step < 24 && !bytes->empty(); ++step) {
    const uint8_t choice = bytes->byte();
    if (choice >= kSweep) {
      sweep_something(environment, is_partition, bytes);
      continue;
    }
    if (choice >= kBody) {
      use_body(scene, is_partition, bytes);
      continue;
    }
    switch (choice % 4) {
      case 0:
        mark_something(environment, bytes);
        break;
      case 1:
        locate_something(environment, is_partition, bytes);
        break;
      case 2: {
        double from[3], to[3];
        read_point(environment, bytes, from);
        read_point(environment, bytes, to);
        dsw_status status;
        cast(environment, pick_volume(environment, bytes), from, to, &status);
        break;
      }
      default:
        move_particle(scene, is_partition, bytes);
    }
  }
  require(dsw_scene_destroy(scene) == DSW_STATUS_OK, "the scene goes");
}

void record(dsw_scene* scene, dsw_write_fn write, void* user) {
  dsw_recording_desc to;
  dsw_recording_desc_init(&to, sizeof to);
  to.write = write;
  to.user = user;
  require(dsw_scene_start_recording(scene, &to) == DSW_STATUS_OK, "a recording");
}

std::vector<uint8_t> save(const dsw_environment* environment) {
  size_t size = 0;
  require(dsw_environment_save(environment, nullptr, 0, &size) == DSW_STATUS_OK, "size of a snapshot");
  std::vector<uint8_t> block(size);
  require(dsw_environment_save(environment, block.data(), block.size(), &size) == DSW_STATUS_OK, "save");
  require(size == block.size(), "a snapshot has the size it said");
  return block;
}

std::vector<uint8_t> save(const dsw_scene* scene) {
  size_t size = 0;
  require(dsw_scene_save(scene, nullptr, 0, &size) == DSW_STATUS_OK, "size of a scene's snapshot");
  std::vector<uint8_t> block(size);
  require(dsw_scene_save(scene, block.data(), block.size(), &size) == DSW_STATUS_OK, "save a scene");
  require(size == block.size(), "a snapshot has the size it said");
  return block;
}

namespace {

std::vector<dsw_body_id> bodies_of(const dsw_scene* scene) {
  size_t count = 0;
  require(dsw_scene_get_body_count(scene, &count) == DSW_STATUS_OK, "bodies are counted");
  std::vector<dsw_body_id> ids(count);
  if (count != 0) require(dsw_scene_get_body_ids(scene, ids.data(), count, &count) == DSW_STATUS_OK, "bodies have ids");
  return ids;
}

double radius_of(const dsw_scene* scene, dsw_body_id body) {
  double radius = -1;
  require(dsw_body_get_radius(scene, body, &radius) == DSW_STATUS_OK, "a body has a radius");
  require(radius >= 0 && std::isfinite(radius), "which is a length");
  return radius;
}

}  // namespace

double check_radius(dsw_scene* scene, dsw_body_id body) {
  const double radius = radius_of(scene, body);
  if (radius == 0) return radius;
  uint32_t penetrates = 0;
  require(dsw_body_is_penetrating(scene, body, &penetrates) == DSW_STATUS_OK, "a body penetrates something, or not");
  if (penetrates != 0) return radius;
  double gap = 0, thickest = 0;
  for (const dsw_body_id each : bodies_of(scene)) thickest = std::max(thickest, radius_of(scene, each));
  require(dsw_body_find_least_gap(scene, body, radius, &gap) == DSW_STATUS_OK, "a body has a gap");
  require(gap <= radius, "up to the limit");
  require(gap >= -0x1p-30 * (radius + thickest), "a body keeps its radius");
  return radius;
}

void check_radii(dsw_scene* scene) {
  for (const dsw_body_id each : bodies_of(scene)) check_radius(scene, each);
}

std::vector<uint8_t> repaired(const uint8_t* data, size_t size) {
  constexpr size_t kAtSize = 16, kAtChecksum = 24, kAtSections = 48;
  std::vector<uint8_t> block(data, data + size / 8 * 8);
  if (block.size() < kAtSections) return {};
  const auto put = [&](size_t at, uint64_t value) {
    for (size_t i = 0; i < 8; ++i) block[at + i] = static_cast<uint8_t>(value >> (8 * i));
  };
  put(kAtSize, block.size());
  uint64_t sum = 0;
  for (size_t at = 0; at < block.size(); at += 8) {
    if (at == kAtChecksum) continue;
    uint64_t word = 0;
    for (size_t i = 8; i-- > 0;) word = (word << 8) | block[at + i];
    sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
    sum ^= sum >> 32;
  }
  put(kAtChecksum, sum);
  return block;
}

}  // namespace dsw_fuzz
