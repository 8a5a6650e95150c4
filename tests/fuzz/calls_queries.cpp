// What is asked, with ids that live and others: any answer but INTERNAL, and what it hands out can be read to its end.

#include <array>

#include "calls.h"

namespace dsw_fuzz {
namespace {

/** The first answer that is INTERNAL, else the last. */
class Answers {
 public:
  Answers& operator<<(dsw_status next) {
    if (worst_ != DSW_STATUS_INTERNAL) worst_ = next;
    return *this;
  }
  operator dsw_status() const { return worst_; }

 private:
  dsw_status worst_ = DSW_STATUS_OK;
};

/** Calls get(items, count) and reads all that it hands out, a byte at a time. */
template <class T, class Get>
dsw_status read_all(const Get& get) {
  const T* items = nullptr;
  size_t count = 0;
  const dsw_status status = get(&items, &count);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(items);
  unsigned sum = 0;
  for (size_t i = 0; i < count * sizeof(T); ++i) sum += bytes[i];
  require(status == DSW_STATUS_OK || (items == nullptr && count == 0), "what fails hands out nothing");
  return sum == UINT32_MAX ? DSW_STATUS_INTERNAL : status;  // never: the sum is smaller
}

/** Calls get(buffer, capacity, count) with no room, one entry too little, and enough. */
template <class T, class Get>
dsw_status copy_all(const Get& get) {
  size_t count = 0;
  const dsw_status asked = get(static_cast<T*>(nullptr), 0, &count);
  if ((asked != DSW_STATUS_OK && asked != DSW_STATUS_BUFFER_TOO_SMALL) || count == 0) return asked;
  const size_t needed = count;
  std::vector<T> buffer(needed - 1);
  require(get(buffer.data(), needed - 1, &count) != DSW_STATUS_INTERNAL && count == needed, "it says how many");
  buffer.resize(needed);
  return get(buffer.data(), needed, &count);
}

int forget(void*, const void*, size_t) { return 0; }

}  // namespace

dsw_status Calls::look(uint32_t which) {
  switch (which) {
    case 0:
      return look_at_cells();
    case 1:
      return look_at_changes();
    case 2:
      return look_at_scene();
    case 3:
      return look_at_body();
    case 4:
      return ask();
    case 5:
      return draw();
    default:
      return make_copies();
  }
}

dsw_status Calls::look_at_cells() {
  const dsw_environment* const e = environment_;
  const dsw_volume_id v = volume();
  const uint32_t local = bytes_.below(16);
  const dsw_face_id f = {v.index, v.generation, local};
  const dsw_edge_id ed = {v.index, v.generation, local};
  const dsw_vertex_id corner = vertex();
  const dsw_cell cell = {static_cast<dsw_cell_kind>(bytes_.below(6)), v.index, v.generation, local};
  dsw_cell_type type;
  uint32_t counts[3], tag;
  dsw_face_id face_out;
  dsw_edge_id edge_out;
  dsw_volume_id near_side, far_side;
  double xyz[3];
  int flag;
  int32_t region;
  Answers answers;
  answers << dsw_environment_get_volume_counts(e, v, &type, counts, counts + 1, counts + 2)
          << dsw_environment_get_face_id(e, v, local, &face_out) << dsw_environment_get_edge_id(e, v, local, &edge_out)
          << dsw_environment_get_face_volumes(e, f, &near_side, &far_side)
          << dsw_environment_get_neighbour(e, v, local, &near_side, &flag) << dsw_environment_get_centre(e, v, xyz)
          << dsw_environment_get_vertex_position(e, corner, xyz) << dsw_environment_get_region(e, v, &region)
          << dsw_environment_get_tag(e, v, &tag) << dsw_environment_is_valid(e, v, &flag)
          << dsw_environment_is_marked(e, cell, &flag) << dsw_environment_is_impassable(e, cell, &flag);
  for (const dsw_cell& each : {cell, dsw_cell{DSW_CELL_FACE, f.volume, f.generation, local},
                               dsw_cell{DSW_CELL_EDGE, ed.volume, ed.generation, local}}) {
    answers << copy_all<dsw_vertex_id>([&](dsw_vertex_id* out, size_t capacity, size_t* count) {
      return dsw_environment_copy_vertices(e, each, out, capacity, count);
    });
  }
  size_t count = 0;
  answers << dsw_environment_get_mark_count(e, static_cast<dsw_cell_kind>(bytes_.below(6)), &count);
  const uint32_t indices[] = {corner.index, bytes_.below(16), bytes_.below(16), bytes_.below(16)};
  const size_t offsets[] = {0, 1 + bytes_.below(3), bytes_.below(5)};
  dsw_face_id faces[2];
  dsw_edge_id edges[2];
  return answers << dsw_environment_find_faces(e, 2, offsets, indices, faces, &count)
                 << dsw_environment_find_edges(e, 2, indices, edges, &count);
}

dsw_status Calls::look_at_changes() {
  dsw_change change;
  change.struct_size = sizeof change;
  Answers answers;
  answers << dsw_environment_get_change(environment_, &change);
  const auto read = [&](const auto* items, size_t count) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(items)>>;
    answers << read_all<T>([&](const T** out, size_t* size) {
      *out = items;
      *size = count;
      return DSW_STATUS_OK;
    });
  };
  read(change.volumes, change.volume_count);
  read(change.vertices, change.vertex_count);
  read(change.faces, change.face_count);
  read(change.whole, change.whole_count);
  read(change.carved, change.carved_count);
  read(change.unrepaired, change.unrepaired_count);
  read(change.detached, change.detached_count);
  read(change.body_vertices, change.body_vertex_count);
  read(change.body_faces, change.body_face_count);
  dsw_build_report report;
  report.struct_size = sizeof report;
  // Not always: it takes longer than most calls.
  return wild() ? answers << dsw_environment_check(environment_, &report) : answers;
}

dsw_status Calls::look_at_scene() {
  const auto of_scene = [&](auto get) {
    return [this, get](auto items, size_t* count) { return get(scene_, items, count); };
  };
  const auto copied = [&](auto get) {
    return [this, get](auto out, size_t capacity, size_t* count) { return get(scene_, out, capacity, count); };
  };
  dsw_statistics statistics;
  statistics.struct_size = sizeof statistics;
  uint64_t memory;
  size_t count = 0, flights = 0;
  const dsw_crossing* crossings = nullptr;
  const size_t* first = nullptr;
  const dsw_particle_id ids[] = {particle(), particle()};
  double positions[6];
  dsw_volume_id volumes[2];
  Answers answers;
  const auto of_environment = [&](auto get) {
    return [this, get](auto items, size_t* items_count) { return get(environment_, items, items_count); };
  };
  answers << read_all<dsw_wall_contact>(of_environment(dsw_environment_get_wall_contacts))
          << read_all<dsw_vertex_id>(of_environment(dsw_environment_get_held_vertices))
          << read_all<dsw_volume_id>(of_environment(dsw_environment_get_invalid_volumes))
          << read_all<dsw_particle_id>(of_scene(dsw_scene_get_occupants))
          << read_all<dsw_exit>(of_scene(dsw_scene_get_exits))
          << read_all<dsw_body_id>(of_scene(dsw_scene_get_occupant_bodies))
          << read_all<uint32_t[2]>([&](const uint32_t(**items)[2], size_t* pairs) {
               const uint32_t* vertices = nullptr;
               const dsw_status status = dsw_scene_get_offending_edges(scene_, &vertices, pairs);
               *items = reinterpret_cast<const uint32_t(*)[2]>(vertices);
               return status;
             })
          << copy_all<dsw_particle_id>(copied(dsw_scene_get_particle_ids))
          << copy_all<dsw_body_id>(copied(dsw_scene_get_body_ids)) << dsw_scene_get_statistics(scene_, &statistics)
          << dsw_scene_get_memory_bytes(scene_, &memory) << dsw_scene_get_particle_count(scene_, &count)
          << dsw_scene_get_body_count(scene_, &count)
          << dsw_scene_get_particle_positions(scene_, ids, 2, positions, 0, volumes)
          << dsw_particle_get_position(scene_, ids[0], positions, volumes);
  const dsw_status status = dsw_scene_get_crossings(scene_, &crossings, &first, &flights);
  if (status == DSW_STATUS_OK && flights != 0) {
    require(first[0] == 0 && (first[flights] == 0 || crossings[first[flights] - 1].time <= 1), "crossings can be read");
  }
  return answers << status;
}

dsw_status Calls::look_at_body() {
  const dsw_body_id id = body();
  /** One path through three poses. */
  const auto find_free_fraction = [&](dsw_body_id of) {
    double poses[21], centre[3];
    for (double& number : poses) number = bytes_.number();
    for (double& number : centre) number = bytes_.number();
    const uint32_t indices[] = {bytes_.below(3), bytes_.below(3), bytes_.below(4)}, offsets[] = {0, 3};
    dsw_free_fraction fraction;
    return dsw_body_find_free_fractions(scene_, of, centre, poses, 3, indices, offsets, 1, &fraction, nullptr);
  };
  const auto of_body = [&](auto get) {
    return [this, id, get](auto items, size_t* count) { return get(scene_, id, items, count); };
  };
  const auto copied = [&](auto get) {
    return [this, id, get](auto out, size_t capacity, size_t* count) { return get(scene_, id, out, capacity, count); };
  };
  /** Several numbers for each entry. */
  const auto tuples = [&](auto get) {
    return [this, id, get](auto out, size_t capacity, size_t* count) {
      return get(scene_, id, out == nullptr ? nullptr : &(*out)[0], capacity, count);
    };
  };
  dsw_level level;
  double radius, gap;
  uint32_t category, mask;
  dsw_body_vertex_id corners[3];
  dsw_near_options near;
  dsw_near_options_init(&near, sizeof near);
  near.flags = bytes_.below(3);
  near.margin = std::fabs(bytes_.number());
  near.radius = bytes_.below(2) == 0 ? 0 : bytes_.number();
  return Answers() << dsw_body_get_level(scene_, id, &level) << dsw_body_get_filter(scene_, id, &category, &mask)
                   << dsw_body_get_radius(scene_, id, &radius) << dsw_body_find_least_gap(scene_, id, near.radius, &gap)
                   << find_free_fraction(id) << dsw_body_get_edge_ends(scene_, id, body_edge(id), corners)
                   << dsw_body_get_face_corners(scene_, id, body_face(id), corners)
                   << copy_all<dsw_body_vertex_id>(copied(dsw_body_get_vertex_ids))
                   << copy_all<dsw_body_edge_id>(copied(dsw_body_get_edge_ids))
                   << copy_all<dsw_body_face_id>(copied(dsw_body_get_face_ids))
                   << copy_all<std::array<uint32_t, 2>>(tuples(dsw_body_get_edge_indices))
                   << copy_all<std::array<uint32_t, 3>>(tuples(dsw_body_get_face_indices))
                   << read_all<dsw_body_contact>(of_body(dsw_body_get_contacts))
                   << read_all<dsw_contact_partner>(of_body(dsw_body_get_contact_partners))
                   << read_all<dsw_previous_contact>(of_body(dsw_body_get_previous_contacts))
                   << read_all<dsw_body_edit>(of_body(dsw_body_get_edits))
                   << read_all<dsw_exit>(of_body(dsw_body_get_exits))
                   << read_all<dsw_penetration>(of_body(dsw_body_find_penetrations))
                   << dsw_body_find_near_rows(scene_, id, &near, nullptr)
                   << read_all<dsw_near_row>(of_body(dsw_body_get_near_rows))
                   << read_all<uint32_t>(of_body(dsw_body_get_near_offsets))
                   << read_all<uint32_t>(of_body(dsw_body_get_near_columns))
                   << read_all<double>(of_body(dsw_body_get_near_values));
}

/** Casts, sweeps, searches and a pair, without a particle. */
dsw_status Calls::ask() {
  const dsw_environment* const e = environment_;
  double points[18];
  places(points);
  const double *const from = points, *const to = points + 2 * dimension_, *const fixed = points + 4 * dimension_;
  const dsw_volume_id starts[] = {volume(), {0, 0}};
  dsw_cast_options cast;
  dsw_cast_options_init(&cast, sizeof cast);
  cast.flags = bytes_.below(9);
  cast.max_volumes = bytes_.below(4);
  dsw_sweep_options sweep;
  dsw_sweep_options_init(&sweep, sizeof sweep);
  sweep.flags = bytes_.below(5);
  sweep.level = static_cast<dsw_level>(bytes_.below(5));
  dsw_volume_id volumes[2] = {};
  dsw_location locations[2];
  dsw_cell cell;
  dsw_flight flights[2];
  dsw_sweep sweeps[2];
  dsw_contact_partner partners[2];
  dsw_nearest nearest[2];
  dsw_segment_nearest segments[2];
  double inside[6];
  const double radius = std::fabs(bytes_.number());
  const uint8_t kind = static_cast<uint8_t>(cast.flags);
  const uint32_t motions[] = {bytes_.below(3), UINT32_MAX};
  dsw_pair_touch touch;
  Answers answers;
  answers << dsw_environment_locate(e, from, starts[0], volumes, locations)
          << dsw_environment_locate_points(e, points, 2, 0, bytes_.below(2) == 0 ? starts : nullptr, volumes, locations)
          << dsw_environment_classify(e, from, starts[0], &cell) << dsw_environment_classify(e, from, volumes[0], &cell)
          << dsw_environment_cast(e, starts[0], from, to, &cast, flights)
          << dsw_environment_cast_segments(e, 2, starts, from, to, 0, &cast, flights)
          << dsw_environment_sweep_edges(e, 2, starts, from, to, fixed, 0, &sweep, sweeps)
          << dsw_environment_find_nearest(e, from, starts[0], radius, nearest)
          << dsw_environment_find_nearest_to_points(e, points, 2, 0, starts, radius, nearest, volumes, locations)
          << dsw_environment_find_nearest_to_segments(e, 2, starts, from, to, 0, radius, segments, nullptr, locations)
          << dsw_environment_find_inside(e, points, 2, 0, starts, radius, inside, volumes)
          << dsw_scene_cast(scene_, 2, starts, from, to, 0, &cast, flights, partners)
          << dsw_scene_find_nearest(scene_, points, 2, 0, starts, radius, nearest, partners, volumes, locations)
          << dsw_environment_find_signed_distances(e, points, 2, 0, inside, nearest)
          << dsw_sweep_pairs(nullptr, static_cast<uint32_t>(dimension_), 1, &kind, from, to, 0, cast.max_volumes,
                             &touch)
          << dsw_sweep_rigid_pairs(nullptr, static_cast<uint32_t>(dimension_), 1, &kind, from, to, 0, points, 1,
                                   motions, cast.max_volumes, &touch);
  return answers << copy_all<dsw_crossing>([&](dsw_crossing* out, size_t capacity, size_t* count) {
           return dsw_environment_cast_path(e, starts[0], from, to, &cast, out, capacity, count, flights);
         });
}

/** A trace of everything, and cross-checks of contacts. */
dsw_status Calls::draw() {
  double points[6];
  places(points);
  const dsw_volume_id ids[] = {volume(), volume()};
  dsw_trace* trace = nullptr;
  dsw_flight flight;
  dsw_trace_data data;
  data.struct_size = sizeof data;
  require(dsw_trace_create(nullptr, &trace) == DSW_STATUS_OK, "a trace");
  Answers answers;
  answers << dsw_trace_add_volumes(trace, environment_, ids, 2, 1)
          << dsw_trace_add_impassable(trace, environment_, bytes_.below(2) == 0, 2)
          << dsw_trace_add_walk(trace, environment_, {0, 0}, points, points + dimension_, nullptr, bytes_.number(), 3);
  if (dsw_environment_cast(environment_, {0, 0}, points, points + dimension_, nullptr, &flight) == DSW_STATUS_OK) {
    answers << dsw_trace_add_contact(trace, &flight, bytes_.number(), 4);
  }
  require(dsw_trace_get_data(trace, &data) == DSW_STATUS_OK, "a trace can be read");
  for (size_t i = 0; i < 3 * data.triangle_count; ++i) require(data.triangles[i] < data.point_count, "a point");
  for (size_t i = 0; i < 2 * data.segment_count; ++i) require(data.segments[i] < data.point_count, "a point");
  for (size_t i = 0; i < data.vertex_count; ++i) require(data.vertices[i] < data.point_count, "a point");
  answers << dsw_trace_clear(trace) << dsw_trace_destroy(trace);
  const dsw_body_contact* contacts = nullptr;
  size_t count = 0;
  dsw_body_get_contacts(scene_, body(), &contacts, &count);
  dsw_cross_check check;
  for (size_t i = 0; i < count && i < 4; ++i)
    answers << dsw_environment_cross_check(environment_, contacts + i, &check);
  return answers;
}

/** Coarser, and saved and loaded into a context of its own; another scene beside it, recorded for nobody. */
dsw_status Calls::make_copies() {
  dsw_coarsen_options options;
  dsw_coarsen_options_init(&options, sizeof options);
  options.max_faces = bytes_.below(32);
  options.max_trials = bytes_.byte();
  dsw_environment *coarse = nullptr, *copy = nullptr;
  Answers answers;
  answers << dsw_environment_coarsen(environment_, &options, &coarse, nullptr, 0, nullptr)
          << dsw_environment_destroy(coarse);
  dsw_context_desc desc;
  dsw_context_desc_init(&desc, sizeof desc);
  desc.thread_count = 1 + bytes_.below(3);
  dsw_context* context = nullptr;
  require(dsw_context_create(&desc, &context) == DSW_STATUS_OK, "a context");
  const std::vector<uint8_t> block = save(environment_);
  const size_t size = bytes_.below(4) == 0 ? bytes_.byte() : block.size();
  if (dsw_environment_load(context, block.data(), size, &copy) == DSW_STATUS_OK) {
    dsw_scene* scene = nullptr;
    dsw_recording_desc to;
    dsw_recording_desc_init(&to, sizeof to);
    to.write = forget;
    if (dsw_scene_create(copy, nullptr, &scene) == DSW_STATUS_OK) {
      answers << dsw_scene_start_recording(scene, &to) << dsw_scene_destroy(scene);
    }
  }
  require(dsw_environment_destroy(copy) == DSW_STATUS_OK, "a copy goes");
  require(dsw_context_destroy(context) == DSW_STATUS_OK, "and then its context");
  require(dsw_status_string(answers) != nullptr && dsw_version() != 0, "names");
  return answers;
}

}  // namespace dsw_fuzz
