/* Layout of every public struct on LP64 (Linux, x86-64 and arm64), frozen. A struct that begins with struct_size may
 * grow at its end: then its size changes here and old offsets stay. Any other change breaks compiled callers. Compiled
 * as C11 by the ctest abi.layout; check_abi.py fails when a public struct or member is missing here. */
#include <stddef.h>

#include "dartsweep/dartsweep.h"

#define SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), "size of " #type)
#define AT(type, member, bytes) _Static_assert(offsetof(type, member) == (bytes), "offset of " #type "." #member)

/* No padding behind the last member: callers leave there what they like, and a new one would be read out of it. */
#define GROWS(type, last) \
  _Static_assert(sizeof(type) == offsetof(type, last) + sizeof(((type *)0)->last), "end of " #type)

_Static_assert(sizeof(void *) == 8 && sizeof(size_t) == 8 && sizeof(int) == 4, "numbers below are for LP64");

#include "layout_changes.h"

SIZE(dsw_flight, 128);
AT(dsw_flight, position, 0);
AT(dsw_flight, time, 24);
AT(dsw_flight, contact, 32);
AT(dsw_flight, volume, 112);
AT(dsw_flight, outcome, 120);
AT(dsw_flight, volumes_visited, 124);

SIZE(dsw_body_contact, 280);
AT(dsw_body_contact, from, 0);
AT(dsw_body_contact, to, 24);
AT(dsw_body_contact, fixed, 48);
AT(dsw_body_contact, position, 96);
AT(dsw_body_contact, time, 120);
AT(dsw_body_contact, point, 128);
AT(dsw_body_contact, edge_parameter, 152);
AT(dsw_body_contact, distance_left, 160);
AT(dsw_body_contact, contact, 168);
AT(dsw_body_contact, vertex, 248);
AT(dsw_body_contact, edge, 256);
AT(dsw_body_contact, face, 264);
AT(dsw_body_contact, history, 272);
AT(dsw_body_contact, reserved, 276);

SIZE(dsw_crossing, 32);
AT(dsw_crossing, volume, 0);
AT(dsw_crossing, face, 8);
AT(dsw_crossing, time, 24);

SIZE(dsw_context_desc, 56);
AT(dsw_context_desc, struct_size, 0);
AT(dsw_context_desc, thread_count, 4);
AT(dsw_context_desc, user, 8);
AT(dsw_context_desc, allocate, 16);
AT(dsw_context_desc, release, 24);
AT(dsw_context_desc, log, 32);
AT(dsw_context_desc, parallel_for, 40);
AT(dsw_context_desc, kernel, 48);
AT(dsw_context_desc, reserved, 52);
GROWS(dsw_context_desc, reserved);

SIZE(dsw_environment_desc, 136);
AT(dsw_environment_desc, struct_size, 0);
AT(dsw_environment_desc, dimension, 4);
AT(dsw_environment_desc, flags, 8);
AT(dsw_environment_desc, index_bytes, 12);
AT(dsw_environment_desc, points, 16);
AT(dsw_environment_desc, point_count, 24);
AT(dsw_environment_desc, point_stride_bytes, 32);
AT(dsw_environment_desc, cell_types, 40);
AT(dsw_environment_desc, volume_count, 48);
AT(dsw_environment_desc, offsets, 56);
AT(dsw_environment_desc, connectivity, 64);
AT(dsw_environment_desc, connectivity_count, 72);
AT(dsw_environment_desc, faces, 80);
AT(dsw_environment_desc, faces_count, 88);
AT(dsw_environment_desc, face_locations, 96);
AT(dsw_environment_desc, regions, 104);
AT(dsw_environment_desc, tags, 112);
AT(dsw_environment_desc, uniform_cell_type, 120);
AT(dsw_environment_desc, reserved, 124);
AT(dsw_environment_desc, merge_distance, 128);
GROWS(dsw_environment_desc, merge_distance);

SIZE(dsw_build_report, 144);
AT(dsw_build_report, struct_size, 0);
AT(dsw_build_report, status, 4);
AT(dsw_build_report, offender_count, 8);
AT(dsw_build_report, offenders, 12);
AT(dsw_build_report, reoriented_count, 44);
AT(dsw_build_report, part_count, 48);
AT(dsw_build_report, unused_point_count, 52);
AT(dsw_build_report, boundary_face_count, 56);
AT(dsw_build_report, convex_volume_count, 60);
AT(dsw_build_report, reoriented_face_count, 64);
AT(dsw_build_report, merged_point_count, 68);
AT(dsw_build_report, changed_count, 72);
AT(dsw_build_report, changed, 76);
AT(dsw_build_report, touching_face_count, 108);
AT(dsw_build_report, touching_face, 112);
AT(dsw_build_report, touched_face, 124);
AT(dsw_build_report, split_count, 136);
AT(dsw_build_report, added_point_count, 140);
GROWS(dsw_build_report, added_point_count);

SIZE(dsw_environment_info, 96);
AT(dsw_environment_info, struct_size, 0);
AT(dsw_environment_info, dimension, 4);
AT(dsw_environment_info, vertex_count, 8);
AT(dsw_environment_info, volume_count, 12);
AT(dsw_environment_info, face_count, 16);
AT(dsw_environment_info, boundary_face_count, 20);
AT(dsw_environment_info, part_count, 24);
AT(dsw_environment_info, scene_count, 28);
AT(dsw_environment_info, memory_bytes, 32);
AT(dsw_environment_info, lower, 40);
AT(dsw_environment_info, upper, 64);
AT(dsw_environment_info, volume_index_count, 88);
AT(dsw_environment_info, vertex_index_count, 92);
GROWS(dsw_environment_info, vertex_index_count);

SIZE(dsw_vertex_id, 8);
AT(dsw_vertex_id, index, 0);
AT(dsw_vertex_id, generation, 4);

SIZE(dsw_volume_id, 8);
AT(dsw_volume_id, index, 0);
AT(dsw_volume_id, generation, 4);

SIZE(dsw_face_id, 12);
AT(dsw_face_id, volume, 0);
AT(dsw_face_id, generation, 4);
AT(dsw_face_id, local, 8);

SIZE(dsw_edge_id, 12);
AT(dsw_edge_id, volume, 0);
AT(dsw_edge_id, generation, 4);
AT(dsw_edge_id, local, 8);

SIZE(dsw_particle_id, 8);
AT(dsw_particle_id, index, 0);
AT(dsw_particle_id, generation, 4);

SIZE(dsw_cell, 16);
AT(dsw_cell, kind, 0);
AT(dsw_cell, index, 4);
AT(dsw_cell, generation, 8);
AT(dsw_cell, local, 12);

SIZE(dsw_cast_options, 16);
AT(dsw_cast_options, struct_size, 0);
AT(dsw_cast_options, flags, 4);
AT(dsw_cast_options, max_volumes, 8);
AT(dsw_cast_options, reserved, 12);
GROWS(dsw_cast_options, reserved);

SIZE(dsw_nearest, 80);
AT(dsw_nearest, distance, 0);
AT(dsw_nearest, point, 8);
AT(dsw_nearest, normal, 32);
AT(dsw_nearest, cell, 56);
AT(dsw_nearest, tag, 72);
AT(dsw_nearest, volumes_visited, 76);

SIZE(dsw_segment_nearest, 112);
AT(dsw_segment_nearest, nearest, 0);
AT(dsw_segment_nearest, segment_parameter, 80);
AT(dsw_segment_nearest, segment_point, 88);

SIZE(dsw_scene_desc, 8);
AT(dsw_scene_desc, struct_size, 0);
AT(dsw_scene_desc, features, 4);
GROWS(dsw_scene_desc, features);

SIZE(dsw_statistics, 80);
AT(dsw_statistics, struct_size, 0);
AT(dsw_statistics, reserved, 4);
AT(dsw_statistics, casts, 8);
AT(dsw_statistics, volumes_visited, 16);
AT(dsw_statistics, orientation_tests, 24);
AT(dsw_statistics, exact_fallbacks, 32);
AT(dsw_statistics, ties, 40);
AT(dsw_statistics, forecast_hits, 48);
AT(dsw_statistics, contacts, 56);
AT(dsw_statistics, candidates, 64);
AT(dsw_statistics, occupants_tested, 72);
GROWS(dsw_statistics, occupants_tested);

SIZE(dsw_sweep_options, 16);
AT(dsw_sweep_options, struct_size, 0);
AT(dsw_sweep_options, flags, 4);
AT(dsw_sweep_options, level, 8);
AT(dsw_sweep_options, max_volumes, 12);
GROWS(dsw_sweep_options, max_volumes);

SIZE(dsw_sweep, 160);
AT(dsw_sweep, position, 0);
AT(dsw_sweep, time, 24);
AT(dsw_sweep, point, 32);
AT(dsw_sweep, edge_parameter, 56);
AT(dsw_sweep, contact, 64);
AT(dsw_sweep, volume, 144);
AT(dsw_sweep, outcome, 152);
AT(dsw_sweep, volumes_visited, 156);

SIZE(dsw_volume_change, 16);
AT(dsw_volume_change, before, 0);
AT(dsw_volume_change, after, 8);

SIZE(dsw_volumes_desc, 128);
AT(dsw_volumes_desc, struct_size, 0);
AT(dsw_volumes_desc, index_bytes, 4);
AT(dsw_volumes_desc, vertices, 8);
AT(dsw_volumes_desc, vertex_count, 16);
AT(dsw_volumes_desc, points, 24);
AT(dsw_volumes_desc, point_count, 32);
AT(dsw_volumes_desc, point_stride_bytes, 40);
AT(dsw_volumes_desc, cell_types, 48);
AT(dsw_volumes_desc, volume_count, 56);
AT(dsw_volumes_desc, offsets, 64);
AT(dsw_volumes_desc, connectivity, 72);
AT(dsw_volumes_desc, connectivity_count, 80);
AT(dsw_volumes_desc, regions, 88);
AT(dsw_volumes_desc, tags, 96);
AT(dsw_volumes_desc, sew_to, 104);
AT(dsw_volumes_desc, sew_count, 112);
AT(dsw_volumes_desc, uniform_cell_type, 120);
AT(dsw_volumes_desc, reserved, 124);
GROWS(dsw_volumes_desc, reserved);

SIZE(dsw_coarsen_options, 16);
AT(dsw_coarsen_options, struct_size, 0);
AT(dsw_coarsen_options, max_faces, 4);
AT(dsw_coarsen_options, max_trials, 8);
GROWS(dsw_coarsen_options, max_trials);

SIZE(dsw_coarsen_report, 64);
AT(dsw_coarsen_report, struct_size, 0);
AT(dsw_coarsen_report, complete, 4);
AT(dsw_coarsen_report, volume_count, 8);
AT(dsw_coarsen_report, face_count, 16);
AT(dsw_coarsen_report, memory_bytes, 24);
AT(dsw_coarsen_report, passable_area, 40);
AT(dsw_coarsen_report, trials, 56);
GROWS(dsw_coarsen_report, trials);

SIZE(dsw_trace_data, 96);
AT(dsw_trace_data, struct_size, 0);
AT(dsw_trace_data, reserved, 4);
AT(dsw_trace_data, points, 8);
AT(dsw_trace_data, point_count, 16);
AT(dsw_trace_data, vertices, 24);
AT(dsw_trace_data, vertex_labels, 32);
AT(dsw_trace_data, vertex_count, 40);
AT(dsw_trace_data, segments, 48);
AT(dsw_trace_data, segment_labels, 56);
AT(dsw_trace_data, segment_count, 64);
AT(dsw_trace_data, triangles, 72);
AT(dsw_trace_data, triangle_labels, 80);
AT(dsw_trace_data, triangle_count, 88);
GROWS(dsw_trace_data, triangle_count);

SIZE(dsw_body_desc, 120);
AT(dsw_body_desc, struct_size, 0);
AT(dsw_body_desc, flags, 4);
AT(dsw_body_desc, level, 8);
AT(dsw_body_desc, reserved, 12);
AT(dsw_body_desc, positions, 16);
AT(dsw_body_desc, vertex_count, 24);
AT(dsw_body_desc, stride_bytes, 32);
AT(dsw_body_desc, hints, 40);
AT(dsw_body_desc, edges, 48);
AT(dsw_body_desc, edge_count, 56);
AT(dsw_body_desc, face_offsets, 64);
AT(dsw_body_desc, face_corners, 72);
AT(dsw_body_desc, face_count, 80);
AT(dsw_body_desc, face_corner_count, 88);
AT(dsw_body_desc, motion_share, 96);
AT(dsw_body_desc, category, 104);
AT(dsw_body_desc, mask, 108);
AT(dsw_body_desc, radius, 112);
GROWS(dsw_body_desc, radius);

SIZE(dsw_body_counts, 32);
AT(dsw_body_counts, struct_size, 0);
AT(dsw_body_counts, vertex_count, 4);
AT(dsw_body_counts, edge_count, 8);
AT(dsw_body_counts, face_count, 12);
AT(dsw_body_counts, vertex_slots, 16);
AT(dsw_body_counts, edge_slots, 20);
AT(dsw_body_counts, face_slots, 24);
AT(dsw_body_counts, reserved, 28);
GROWS(dsw_body_counts, reserved);

SIZE(dsw_exit, 64);
AT(dsw_exit, point, 0);
AT(dsw_exit, time, 24);
AT(dsw_exit, face, 32);
AT(dsw_exit, patch, 44);
AT(dsw_exit, particle, 48);
AT(dsw_exit, vertex, 56);

SIZE(dsw_penetration, 104);
AT(dsw_penetration, point, 0);
AT(dsw_penetration, part, 24);
AT(dsw_penetration, other, 56);
AT(dsw_penetration, wall, 88);
AT(dsw_penetration, reserved, 100);

SIZE(dsw_body_cut, 96);
AT(dsw_body_cut, point, 0);
AT(dsw_body_cut, edge_parameter, 24);
AT(dsw_body_cut, body, 32);
AT(dsw_body_cut, edge, 40);
AT(dsw_body_cut, ends, 48);
AT(dsw_body_cut, vertices, 64);
AT(dsw_body_cut, parts, 80);

SIZE(dsw_body_edit, 56);
AT(dsw_body_edit, vertex, 0);
AT(dsw_body_edit, ends, 8);
AT(dsw_body_edit, edge, 24);
AT(dsw_body_edit, rest, 32);
AT(dsw_body_edit, edge_parameter, 40);
AT(dsw_body_edit, inserted, 48);
AT(dsw_body_edit, reserved, 52);

SIZE(dsw_contact, 80);
AT(dsw_contact, normal, 0);
AT(dsw_contact, obstacle, 24);
AT(dsw_contact, wall, 40);
AT(dsw_contact, front, 52);
AT(dsw_contact, behind, 60);
AT(dsw_contact, kind, 68);
AT(dsw_contact, marked_kind, 72);
AT(dsw_contact, tag, 76);

SIZE(dsw_contact_partner, 32);
AT(dsw_contact_partner, body, 0);
AT(dsw_contact_partner, vertex, 8);
AT(dsw_contact_partner, edge, 16);
AT(dsw_contact_partner, face, 24);

SIZE(dsw_previous_contact, 88);
AT(dsw_previous_contact, point, 0);
AT(dsw_previous_contact, normal, 24);
AT(dsw_previous_contact, obstacle, 48);
AT(dsw_previous_contact, body, 64);
AT(dsw_previous_contact, since, 72);
AT(dsw_previous_contact, moves, 76);
AT(dsw_previous_contact, touching, 80);
AT(dsw_previous_contact, reserved, 84);

SIZE(dsw_cross_check, 56);
AT(dsw_cross_check, normal, 0);
AT(dsw_cross_check, depth, 24);
AT(dsw_cross_check, pushed_in, 32);
AT(dsw_cross_check, angle_rad, 40);
AT(dsw_cross_check, kind, 48);
AT(dsw_cross_check, reason, 52);

SIZE(dsw_body_id, 8);
AT(dsw_body_id, index, 0);
AT(dsw_body_id, generation, 4);

SIZE(dsw_body_vertex_id, 8);
AT(dsw_body_vertex_id, index, 0);
AT(dsw_body_vertex_id, generation, 4);

SIZE(dsw_body_edge_id, 8);
AT(dsw_body_edge_id, index, 0);
AT(dsw_body_edge_id, generation, 4);

SIZE(dsw_body_face_id, 8);
AT(dsw_body_face_id, index, 0);
AT(dsw_body_face_id, generation, 4);

SIZE(dsw_move_options, 80);
AT(dsw_move_options, struct_size, 0);
AT(dsw_move_options, flags, 4);
AT(dsw_move_options, vertex_response, 8);
AT(dsw_move_options, edge_response, 12);
AT(dsw_move_options, search, 16);
AT(dsw_move_options, bisection_depth, 20);
AT(dsw_move_options, max_volumes, 24);
AT(dsw_move_options, passes, 28);
AT(dsw_move_options, min_part, 32);
AT(dsw_move_options, min_length, 40);
AT(dsw_move_options, stand_off, 48);
AT(dsw_move_options, noise_share, 56);
AT(dsw_move_options, order, 64);
AT(dsw_move_options, order_count, 72);
GROWS(dsw_move_options, order_count);

SIZE(dsw_near_options, 24);
AT(dsw_near_options, struct_size, 0);
AT(dsw_near_options, flags, 4);
AT(dsw_near_options, margin, 8);
AT(dsw_near_options, radius, 16);
GROWS(dsw_near_options, radius);

SIZE(dsw_together_options, 24);
AT(dsw_together_options, struct_size, 0);
AT(dsw_together_options, flags, 4);
AT(dsw_together_options, stop, 8);
AT(dsw_together_options, max_rounds, 12);
AT(dsw_together_options, max_work, 16);
AT(dsw_together_options, response, 20);
GROWS(dsw_together_options, response);

SIZE(dsw_together_response, 4);

SIZE(dsw_scene_deform_options, 32);
AT(dsw_scene_deform_options, struct_size, 0);
AT(dsw_scene_deform_options, flags, 4);
AT(dsw_scene_deform_options, stop, 8);
AT(dsw_scene_deform_options, max_rounds, 12);
AT(dsw_scene_deform_options, max_work, 16);
AT(dsw_scene_deform_options, response, 20);
AT(dsw_scene_deform_options, point_room, 24);
GROWS(dsw_scene_deform_options, point_room);

SIZE(dsw_near_row, 224);
AT(dsw_near_row, point, 0);
AT(dsw_near_row, obstacle_point, 24);
AT(dsw_near_row, normal, 48);
AT(dsw_near_row, distance, 72);
AT(dsw_near_row, gap, 80);
AT(dsw_near_row, weights, 88);
AT(dsw_near_row, obstacle_weights, 112);
AT(dsw_near_row, vertices, 136);
AT(dsw_near_row, obstacle_vertices, 148);
AT(dsw_near_row, obstacle, 160);
AT(dsw_near_row, wall, 176);
AT(dsw_near_row, tag, 188);
AT(dsw_near_row, body, 192);
AT(dsw_near_row, key, 200);
AT(dsw_near_row, previous, 216);
AT(dsw_near_row, reserved, 220);

SIZE(dsw_pair_touch, 16);
AT(dsw_pair_touch, time, 0);
AT(dsw_pair_touch, touches, 8);
AT(dsw_pair_touch, rank, 12);

SIZE(dsw_free_fraction, 24);
AT(dsw_free_fraction, fraction, 0);
AT(dsw_free_fraction, piece_fraction, 8);
AT(dsw_free_fraction, piece, 16);
AT(dsw_free_fraction, starts_free, 20);

SIZE(dsw_move_report, 40);
AT(dsw_move_report, fraction, 0);
AT(dsw_move_report, vertices_moved, 8);
AT(dsw_move_report, vertices_stopped, 12);
AT(dsw_move_report, contact_count, 16);
AT(dsw_move_report, edit_count, 20);
AT(dsw_move_report, edges_swept, 24);
AT(dsw_move_report, edges_skipped, 28);
AT(dsw_move_report, vertices_limited, 32);
AT(dsw_move_report, reserved, 36);

SIZE(dsw_rigid_motion, 80);
AT(dsw_rigid_motion, rotation, 0);
AT(dsw_rigid_motion, centre, 32);
AT(dsw_rigid_motion, translation, 56);

SIZE(dsw_status, 4);
SIZE(dsw_outcome, 4);
SIZE(dsw_contact_kind, 4);
SIZE(dsw_kernel, 4);
SIZE(dsw_log_level, 4);
SIZE(dsw_cell_type, 4);
SIZE(dsw_cell_kind, 4);
SIZE(dsw_mark, 4);
SIZE(dsw_location, 4);
SIZE(dsw_level, 4);
SIZE(dsw_contact_history, 4);
SIZE(dsw_cross_check_kind, 4);
SIZE(dsw_no_cross_check, 4);
SIZE(dsw_search, 4);
SIZE(dsw_response, 4);
SIZE(dsw_together_stop, 4);
SIZE(dsw_pair_kind, 4);
SIZE(dsw_deform_method, 4);
SIZE(dsw_wall_response, 4);
SIZE(dsw_invalid_response, 4);
SIZE(dsw_deform_outcome, 4);
SIZE(dsw_cut_flag, 4);
SIZE(dsw_carve_flag, 4);

SIZE(dsw_recording_desc, 32);
AT(dsw_recording_desc, struct_size, 0);
AT(dsw_recording_desc, flags, 4);
AT(dsw_recording_desc, path, 8);
AT(dsw_recording_desc, write, 16);
AT(dsw_recording_desc, user, 24);
GROWS(dsw_recording_desc, user);

SIZE(dsw_replay_report, 32);
AT(dsw_replay_report, call, 0);
AT(dsw_replay_report, function, 8);
AT(dsw_replay_report, outcome, 16);
AT(dsw_replay_report, status, 20);
AT(dsw_replay_report, has_failed, 24);
AT(dsw_replay_report, differs, 28);

SIZE(dsw_replay_outcome, 4);

SIZE(dsw_replay_info, 48);
AT(dsw_replay_info, struct_size, 0);
AT(dsw_replay_info, flags, 4);
AT(dsw_replay_info, version, 8);
AT(dsw_replay_info, reserved, 12);
AT(dsw_replay_info, calls, 16);
AT(dsw_replay_info, bytes_left, 24);
AT(dsw_replay_info, note, 32);
AT(dsw_replay_info, validation, 40);
GROWS(dsw_replay_info, validation);

SIZE(dsw_validation, 224);
AT(dsw_validation, struct_size, 0);
AT(dsw_validation, is_right, 4);
AT(dsw_validation, places, 8);
AT(dsw_validation, lost, 16);
AT(dsw_validation, edges, 24);
AT(dsw_validation, crossing, 32);
AT(dsw_validation, faces, 40);
AT(dsw_validation, pierced, 48);
AT(dsw_validation, ways, 56);
AT(dsw_validation, missed, 64);
AT(dsw_validation, contacts, 72);
AT(dsw_validation, wrong, 80);
AT(dsw_validation, not_validated, 88);
AT(dsw_validation, text, 96);
GROWS(dsw_validation, text);

SIZE(dsw_bug_report_desc, 40);
AT(dsw_bug_report_desc, struct_size, 0);
AT(dsw_bug_report_desc, flags, 4);
AT(dsw_bug_report_desc, path, 8);
AT(dsw_bug_report_desc, write, 16);
AT(dsw_bug_report_desc, user, 24);
AT(dsw_bug_report_desc, note, 32);
GROWS(dsw_bug_report_desc, note);
