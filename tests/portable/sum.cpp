#include "sum.h"

#include "defaults.h"

#include <vector>

namespace dsw::portable {

// Each binding names all members of its struct: a new one does not compile until it is looked at here.

Sum& operator<<(Sum& sum, const dsw_face_id& id) { return sum.all(id.volume, id.generation, id.local); }
Sum& operator<<(Sum& sum, const dsw_edge_id& id) { return sum.all(id.volume, id.generation, id.local); }

Sum& operator<<(Sum& sum, const dsw_cell& cell) {
  const auto& [kind, index, generation, local] = cell;
  return sum.all(kind, index, generation, local);
}

Sum& operator<<(Sum& sum, const dsw_contact& contact) {
  const auto& [normal, obstacle, wall, front, behind, kind, marked_kind, tag] = contact;
  return sum.all(normal, obstacle, wall, front, behind, kind, marked_kind, tag);
}

Sum& operator<<(Sum& sum, const dsw_flight& flight) {
  const auto& [position, time, contact, volume, outcome, volumes_visited] = flight;
  return sum.all(position, time, contact, volume, outcome, volumes_visited);
}

Sum& operator<<(Sum& sum, const dsw_crossing& crossing) {
  const auto& [volume, face, time] = crossing;
  return sum.all(volume, face, time);
}

Sum& operator<<(Sum& sum, const dsw_sweep& sweep) {
  const auto& [position, time, point, edge_parameter, contact, volume, outcome, volumes_visited] = sweep;
  return sum.all(position, time, point, edge_parameter, contact, volume, outcome, volumes_visited);
}

Sum& operator<<(Sum& sum, const dsw_nearest& nearest) {
  const auto& [distance, point, normal, cell, tag, volumes_visited] = nearest;
  return sum.all(distance, point, normal, cell, tag, volumes_visited);
}

Sum& operator<<(Sum& sum, const dsw_segment_nearest& nearest) {
  const auto& [of_point, segment_parameter, segment_point] = nearest;
  return sum.all(of_point, segment_parameter, segment_point);
}

Sum& operator<<(Sum& sum, const dsw_body_contact& each) {
  const auto& [from, to, fixed, position, time, point, edge_parameter, distance_left, contact, vertex, edge, face,
               history, reserved] = each;
  return sum.all(from, to, fixed, position, time, point, edge_parameter, distance_left, contact, vertex, edge, face,
                 history, reserved);
}

Sum& operator<<(Sum& sum, const dsw_previous_contact& contact) {
  const auto& [point, normal, obstacle, body, since, moves, touching, reserved] = contact;
  return sum.all(point, normal, obstacle, body, since, moves, touching, reserved);
}

Sum& operator<<(Sum& sum, const dsw_contact_partner& partner) {
  const auto& [body, vertex, edge, face] = partner;
  return sum.all(body, vertex, edge, face);
}

Sum& operator<<(Sum& sum, const dsw_body_edit& edit) {
  const auto& [vertex, ends, edge, rest, edge_parameter, inserted, reserved] = edit;
  return sum.all(vertex, ends, edge, rest, edge_parameter, inserted, reserved);
}

Sum& operator<<(Sum& sum, const dsw_move_report& report) {
  const auto& [fraction, vertices_moved, vertices_stopped, contact_count, edit_count, edges_swept, edges_skipped,
               vertices_limited, reserved] = report;
  return sum.all(fraction, vertices_moved, vertices_stopped, contact_count, edit_count, edges_swept, edges_skipped,
                 vertices_limited, reserved);
}

Sum& operator<<(Sum& sum, const dsw_deform_report& report) {
  const auto& [fraction, outcome, steps, near_count, held_count, contact_count, invalid_count, pushed_count,
               remeshed_count] = report;
  return sum.all(fraction, outcome, steps, near_count, held_count, contact_count, invalid_count, pushed_count,
                 remeshed_count);
}

Sum& operator<<(Sum& sum, const dsw_wall_contact& each) {
  const auto& [from, to, time, point, edge_parameter, contact, moving, others, particle, body, vertex, edge, face,
               response, reserved] = each;
  return sum.all(from, to, time, point, edge_parameter, contact, moving, others, particle, body, vertex, edge, face,
                 response, reserved);
}

Sum& operator<<(Sum& sum, const dsw_near_row& row) {
  const auto& [point, obstacle_point, normal, distance, gap, weights, obstacle_weights, vertices, obstacle_vertices,
               obstacle, wall, tag, body, key, previous, reserved] = row;
  return sum.all(point, obstacle_point, normal, distance, gap, weights, obstacle_weights, vertices, obstacle_vertices,
                 obstacle, wall, tag, body, key, previous, reserved);
}

Sum& operator<<(Sum& sum, const dsw_pair_touch& touch) {
  const auto& [time, touches, rank] = touch;
  return sum.all(time, touches, rank);
}

Sum& operator<<(Sum& sum, const dsw_statistics& statistics) {
  const auto& [struct_size, reserved, casts, volumes_visited, orientation_tests, exact_fallbacks, ties, forecast_hits,
               contacts, candidates, occupants_tested] = statistics;
  return sum.all(struct_size, reserved, casts, volumes_visited, orientation_tests, exact_fallbacks, ties, forecast_hits,
                 contacts, candidates, occupants_tested);
}

Sum& operator<<(Sum& sum, const dsw_build_report& report) {
  const auto& [struct_size, status, offender_count, offenders, reoriented_count, part_count, unused_point_count,
               boundary_face_count, convex_volume_count, reoriented_face_count, merged_point_count, changed_count,
               changed, touching_face_count, touching_face, touched_face, split_count, added_point_count] =
      report;  // those since 2.1 are 0 in what is summed
  return sum.all(struct_size, status, offender_count, offenders, reoriented_count, part_count, unused_point_count,
                 boundary_face_count, convex_volume_count);
}

Sum& operator<<(Sum& sum, const dsw_volume_change& change) {
  const auto& [before, after] = change;
  return sum.all(before, after);
}

Sum& operator<<(Sum& sum, const dsw_cut_face& face) {
  const auto& [front, back] = face;
  return sum.all(front, back);
}

Sum& operator<<(Sum& sum, const dsw_face_origin& origin) {
  const auto& [face, volume] = origin;
  return sum.all(face, volume);
}

Sum& operator<<(Sum& sum, const dsw_vertex_origin& origin) {
  const auto& [vertex, from, weights] = origin;
  return sum.all(vertex, from, weights);
}

Sum& operator<<(Sum& sum, const dsw_change& change) {
  const auto& [struct_size, is_closed, distance, smallest_width, largest_width, volumes_visited, volumes_crossed,
               volumes_split, volumes_changed, vertices_parted, vertices_shortened, faces_sewn, faces_unsewn,
               volumes_invalid, volumes_removed, volumes_added, patch_count, most_faces, reserved, volumes,
               volume_count, vertices, vertex_count, faces, face_count, whole, whole_count, carved, carved_count,
               unrepaired, unrepaired_count, detached, detached_count, body_vertices, body_vertex_count, body_faces,
               body_face_count] = change;
  static_cast<void>(struct_size);
  sum.all(is_closed, distance, smallest_width, largest_width, volumes_visited, volumes_crossed, volumes_split,
          volumes_changed, vertices_parted, vertices_shortened, faces_sewn, faces_unsewn, volumes_invalid,
          volumes_removed, volumes_added, patch_count, most_faces, reserved);
  sum.list(volumes, volume_count).list(vertices, vertex_count).list(faces, face_count).list(whole, whole_count);
  sum.list(carved, carved_count).list(unrepaired, unrepaired_count).list(detached, detached_count);
  return sum.list(body_vertices, body_vertex_count).list(body_faces, body_face_count);
}

namespace {

/// What get(&items, &count) gives.
template <class T, class Get>
void add_list(Sum& sum, Get get) {
  const T* items = nullptr;
  size_t count = 0;
  if (get(&items, &count) == DSW_STATUS_OK) sum.list(items, count);
}

/// What get(items, capacity, &count) copies.
template <class T, class Get>
std::vector<T> copied(Get get) {
  size_t count = 0;
  get(nullptr, 0, &count);
  std::vector<T> items(count);
  if (count != 0) get(items.data(), count, &count);
  return items;
}

void add_body(Sum& sum, dsw_scene* scene, dsw_body_id body, size_t dimension) {
  dsw_body_counts counts;
  counts.struct_size = sizeof counts;
  dsw_level level;
  double radius = 0;
  if (dsw_body_get_counts(scene, body, &counts) != DSW_STATUS_OK) return;
  dsw_body_get_level(scene, body, &level);
  dsw_body_get_radius(scene, body, &radius);
  sum.all(body, level, radius, counts.vertex_count, counts.edge_count, counts.face_count, counts.vertex_slots);
  std::vector<double> positions(dimension * counts.vertex_slots);
  std::vector<dsw_volume_id> volumes(counts.vertex_slots);
  size_t count = 0;
  dsw_body_get_positions(scene, body, positions.data(), counts.vertex_slots, 0, volumes.data(), &count);
  sum.list(positions.data(), positions.size()).list(volumes.data(), volumes.size());
  const auto of_body = [&](auto get) {
    return [=](auto items, size_t* size) { return get(scene, body, items, size); };
  };
  add_list<dsw_body_contact>(sum, of_body(dsw_body_get_contacts));
  add_list<dsw_contact_partner>(sum, of_body(dsw_body_get_contact_partners));
  add_list<dsw_previous_contact>(sum, of_body(dsw_body_get_previous_contacts));
  add_list<dsw_body_edit>(sum, of_body(dsw_body_get_edits));
  dsw_near_options near = oracle::defaults(dsw_near_options_init);
  near.flags = DSW_NEAR_JACOBIAN;
  near.margin = 0.25;
  sum << dsw_body_find_near_rows(scene, body, &near, nullptr);
  add_list<dsw_near_row>(sum, of_body(dsw_body_get_near_rows));
  add_list<uint32_t>(sum, of_body(dsw_body_get_near_offsets));
  add_list<uint32_t>(sum, of_body(dsw_body_get_near_columns));
  add_list<double>(sum, of_body(dsw_body_get_near_values));
}

}  // namespace

void add_state(Sum& sum, dsw_scene* scene) {
  const dsw_environment* const environment = dsw_scene_get_environment(scene);
  dsw_environment_info info;
  info.struct_size = sizeof info;
  dsw_environment_get_info(environment, &info);
  sum.all(info.dimension, info.vertex_count, info.volume_count, info.face_count, info.boundary_face_count,
          info.part_count, info.lower, info.upper, info.volume_index_count, info.vertex_index_count);
  const auto particles = copied<dsw_particle_id>([&](dsw_particle_id* to, size_t room, size_t* count) {
    return dsw_scene_get_particle_ids(scene, to, room, count);
  });
  for (const dsw_particle_id id : particles) {
    double position[3] = {};
    dsw_volume_id volume;
    dsw_particle_get_position(scene, id, position, &volume);
    sum.all(id, position, volume);
  }
  const auto bodies = copied<dsw_body_id>(
      [&](dsw_body_id* to, size_t room, size_t* count) { return dsw_scene_get_body_ids(scene, to, room, count); });
  for (const dsw_body_id body : bodies) add_body(sum, scene, body, info.dimension);
  const auto of = [](auto* handle, auto get) {
    return [=](auto items, size_t* count) { return get(handle, items, count); };
  };
  add_list<dsw_particle_id>(sum, of(scene, dsw_scene_get_occupants));
  add_list<dsw_body_id>(sum, of(scene, dsw_scene_get_occupant_bodies));
  add_list<dsw_wall_contact>(sum, of(environment, dsw_environment_get_wall_contacts));
  add_list<dsw_vertex_id>(sum, of(environment, dsw_environment_get_held_vertices));
  add_list<dsw_volume_id>(sum, of(environment, dsw_environment_get_invalid_volumes));
  dsw_statistics statistics = {};
  statistics.struct_size = sizeof statistics;
  if (dsw_scene_get_statistics(scene, &statistics) == DSW_STATUS_OK) sum << statistics;
  dsw_change change = {};
  change.struct_size = sizeof change;
  if (dsw_environment_get_change(environment, &change) == DSW_STATUS_OK) sum << change;
}

void add_snapshots(Sum& sum, const dsw_scene* scene) {
  const dsw_environment* const environment = dsw_scene_get_environment(scene);
  const auto of_environment = copied<uint8_t>(
      [&](uint8_t* to, size_t room, size_t* size) { return dsw_environment_save(environment, to, room, size); });
  const auto of_scene =
      copied<uint8_t>([&](uint8_t* to, size_t room, size_t* size) { return dsw_scene_save(scene, to, room, size); });
  sum.bytes(of_environment.data(), of_environment.size()).bytes(of_scene.data(), of_scene.size());
}

}  // namespace dsw::portable
