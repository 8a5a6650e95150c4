# Sources, one block per module, in the order in which modules may include each other. A new .cpp is one line here.
set(dsw_sources)

# base: assert, error, memory, parallel-for
list(APPEND dsw_sources
  base/error.cpp
  base/fp_mode.cpp
  base/memory.cpp
  base/parallel.cpp
  base/points.cpp
  base/pool.cpp
  base/processor.cpp
)

# predicates: signs
list(APPEND dsw_sources
  predicates/cell_signs.cpp
  predicates/cell_signs_avx2.cpp
  predicates/certified_hit.cpp
  predicates/certified_hit_fma.cpp
  predicates/certified_hits_fma.cpp
  predicates/exact.cpp
  predicates/hull_directions.cpp
  predicates/hull_gap.cpp
  predicates/moving_pair.cpp
  predicates/moving_pair_exact.cpp
  predicates/moving_pair_filter.cpp
  predicates/moving_pair_small.cpp
  predicates/near_signs.cpp
  predicates/sightline.cpp
  predicates/plane_hit.cpp
  predicates/polynomial.cpp
  predicates/polynomial_curve.cpp
  predicates/polynomial_halving.cpp
  predicates/polynomial_parts.cpp
  predicates/sweep_events.cpp
  predicates/touch.cpp
  predicates/turning_pair.cpp
  predicates/turning_pair_exact.cpp
  predicates/turning_pair_filter.cpp
  predicates/wide_int.cpp
)

# map: topology without coordinates
list(APPEND dsw_sources
  map/integrity.cpp
  map/map.cpp
  map/records.cpp
  map/shape.cpp
)

# environment: positions, marks, builder, grid, validity
list(APPEND dsw_sources
  environment/boundary_check.cpp
  environment/boundary_surface.cpp
  environment/builder.cpp
  environment/edge_marks.cpp
  environment/environment.cpp
  environment/exits.cpp
  environment/facet_matcher.cpp
  environment/find_facets.cpp
  environment/general_records.cpp
  environment/cell_tree.cpp
  environment/cell_index.cpp
  environment/curve.cpp
  environment/collapsed_loops.cpp
  environment/obstacle_index.cpp
  environment/local_points.cpp
  environment/marking.cpp
  environment/merged_points.cpp
  environment/mesh_reader.cpp
  environment/moving.cpp
  environment/recut.cpp
  environment/replaced_cells.cpp
  environment/touching.cpp
  environment/turned_loops.cpp
  environment/validity.cpp
)

# conform: parts that lie on each other, made to hang together
list(APPEND dsw_sources
  conform/conform.cpp
  conform/facet_pairs.cpp
  conform/facet_split.cpp
  conform/hanging_points.cpp
)

# split: cells whose mean does not see them whole, split into parts
list(APPEND dsw_sources
  split/cell_parts.cpp
  split/crossing.cpp
  split/facet_cuts.cpp
  split/inner_point.cpp
  split/parts.cpp
  split/peeling.cpp
  split/split.cpp
)

# walk: casts, particles' moves
list(APPEND dsw_sources
  walk/cast.cpp
  walk/fastest.cpp
  walk/move.cpp
  walk/shear.cpp
  walk/shear_avx2.cpp
  walk/shear_avx512.cpp
  walk/short_way.cpp
  walk/walk_avx2.cpp
  walk/walk_avx512.cpp
  walk/walk_counted.cpp
  walk/walk_portable.cpp
)

# locate: which cell holds a point, what it lies on, what is next to it
list(APPEND dsw_sources
  locate/bounded_flood.cpp
  locate/boundary_tree.cpp
  locate/classify.cpp
  locate/inside.cpp
  locate/locate.cpp
  locate/distances.cpp
  locate/nearest.cpp
  locate/nearest_search.cpp
  locate/open_segment.cpp
  locate/signed_distance.cpp
  locate/segment_distances.cpp
  locate/facet_bounds.cpp
  locate/facet_bounds_avx2.cpp
)

# flood: swept edges and faces
list(APPEND dsw_sources
  corridor/box_probe.cpp
  corridor/box_probe_avx2.cpp
  corridor/edge_turn.cpp
  corridor/first_ridge.cpp
  corridor/facet_pass.cpp
  corridor/facet_pass_avx2.cpp
  corridor/ask.cpp
  corridor/hop.cpp
  corridor/moving_corridors.cpp
  corridor/corridors.cpp
  corridor/ridge_rings.cpp
  corridor/corridor.cpp
  corridor/corridor_writer.cpp
  corridor/solid_sweep.cpp
  corridor/fan.cpp
  corridor/sweep.cpp
  corridor/sweep_contact.cpp
)

# body: vertices, edges, faces
list(APPEND dsw_sources
  body/body.cpp
  body/body_boxes.cpp
  body/integrity.cpp
  body/manifold.cpp
  body/box.cpp
  body/box_grid.cpp
  body/near.cpp
  body/rigid_shape.cpp
)

# pairs: body against body
list(APPEND dsw_sources
  proximity/near_edges.cpp
  proximity/pair_sweep.cpp
  proximity/partners.cpp
  proximity/segment_touch.cpp
)

# proximity: what is near a body
list(APPEND dsw_sources
  proximity/near_list.cpp
  proximity/near_lists.cpp
  proximity/near_selection.cpp
  proximity/near_pair.cpp
  proximity/near_points.cpp
  proximity/near_search.cpp
  proximity/sight.cpp
  proximity/obstacles_near.cpp
)

# thickness: distances that thick bodies keep
list(APPEND dsw_sources
  proximity/joined.cpp
  proximity/thick_sweep.cpp
)

# sweep: what a body sweeps
list(APPEND dsw_sources
  sweep/body_probe.cpp
  sweep/clearance.cpp
  sweep/simplex_sweep.cpp
  sweep/touched_line.cpp
  sweep/star.cpp
)

# contact: where and how something is touched
list(APPEND dsw_sources
  contact/describe.cpp
  contact/describe_pair.cpp
  contact/describe_thick.cpp
  contact/geometry.cpp
  contact/names.cpp
  contact/vertex_normal.cpp
)

# query: what a host asks of an environment alone, or of points alone
list(APPEND dsw_sources
  query/locations.cpp
  query/moving_pairs.cpp
  query/nearest.cpp
  query/report.cpp
  query/segments.cpp
  query/sweeps.cpp
)

# response: what is done about it
list(APPEND dsw_sources
  response/allowed_motion.cpp
  response/body_move.cpp
  response/clear_parts.cpp
  response/course.cpp
  response/course_casts.cpp
  response/edge_pass.cpp
  response/edge_sieve.cpp
  response/insertion.cpp
  response/inwards.cpp
  response/inwards_avx2.cpp
  response/rigid_move.cpp
  response/rigid_touches.cpp
  response/rigid_way.cpp
  response/short_edges.cpp
  response/short_edges_avx2.cpp
  response/touch_record.cpp
  response/touched_planes.cpp
  response/touched_walls.cpp
  response/turn_words.cpp
  response/turn_words_avx2.cpp
  response/turning_move.cpp
  response/turns.cpp
  response/vertex_move.cpp
)

# together: bodies of which all vertices move at once
list(APPEND dsw_sources
  together/body_ways.cpp
  together/describe.cpp
  together/far_edges.cpp
  together/held_points.cpp
  together/hull_ways.cpp
  together/kept_sides.cpp
  together/moving_walls.cpp
  together/near_walls.cpp
  together/rigid_pairs.cpp
  together/room_steps.cpp
  together/shortened_ways.cpp
  together/start_corridors.cpp
  together/step_pairs.cpp
  together/step_search.cpp
  together/thick_ways.cpp
  together/together_move.cpp
  together/touch_rows.cpp
  together/turning_together.cpp
  together/wall_ways.cpp
  together/whole_ways.cpp
)

# walls: what a deformation does to what lies there
list(APPEND dsw_sources
  walls/describe.cpp
  walls/end_repair.cpp
  walls/end_state.cpp
  walls/moving_points.cpp
  walls/neighbourhood.cpp
  walls/occupants.cpp
  walls/rigid_push.cpp
  walls/wall_motion.cpp
  walls/wall_move.cpp
  walls/wall_sweep.cpp
)

# topology: cells replaced by others
list(APPEND dsw_sources
  topology/addition.cpp
  topology/draft.cpp
  topology/edges.cpp
  topology/edit.cpp
  topology/edit_apply.cpp
  topology/faces.cpp
  topology/layout.cpp
  topology/standard_form.cpp
  topology/volumes.cpp
)

# cutting: what a surgeon asks for, built from the basic operations
list(APPEND dsw_sources
  cutting/blade.cpp
  cutting/blade_tree.cpp
  cutting/crack.cpp
  cutting/crossings.cpp
  cutting/cut.cpp
  cutting/fold.cpp
  cutting/inside.cpp
  cutting/opening.cpp
  cutting/refine.cpp
  cutting/section.cpp
  cutting/start.cpp
)

# pieces: what hangs together, and its surface
list(APPEND dsw_sources
  cutting/inset.cpp
  cutting/piece.cpp
  cutting/surface.cpp
)

# coarsen: few large cells out of tetrahedra
list(APPEND dsw_sources
  topology/coarsen.cpp
  topology/merging.cpp
  topology/polyhedron.cpp
  topology/rebuild.cpp
)

# remesh: invalid cells repaired
list(APPEND dsw_sources
  topology/repair.cpp
  topology/patch.cpp
)

# cross_check: what libccd says of a normal, or nothing
list(APPEND dsw_sources
  cross_check/features.cpp
  cross_check/report.cpp
  cross_check/second_normal.cpp
)
if(DSW_WITH_LIBCCD)
  list(APPEND dsw_sources cross_check/penetration_ccd.cpp)
else()
  list(APPEND dsw_sources cross_check/penetration_none.cpp)
endif()

# scene: owns everything
list(APPEND dsw_sources
  scene/bodies.cpp
  scene/body_places.cpp
  scene/body_cuts.cpp
  scene/body_edits.cpp
  scene/body_moves.cpp
  scene/cell_particles.cpp
  scene/change.cpp
  scene/deform_call.cpp
  scene/deformation.cpp
  scene/depenetration.cpp
  scene/detachment.cpp
  scene/distances.cpp
  scene/edits.cpp
  scene/free_fractions.cpp
  scene/gone_facets.cpp
  scene/meeting.cpp
  scene/particle_moves.cpp
  scene/near_bodies.cpp
  scene/near_rows.cpp
  scene/occupation.cpp
  scene/particles.cpp
  scene/penetrations.cpp
  scene/scene.cpp
  scene/rigid_moves.cpp
  scene/rays.cpp
  scene/right_side.cpp
  scene/motions_left.cpp
  scene/rigid_deform.cpp
  scene/rigid_together.cpp
  scene/step_fraction.cpp
  scene/surgery.cpp
  scene/together_deform.cpp
  scene/together_moves.cpp
  scene/touch_history.cpp
  scene/untested.cpp
)

# snapshot, record, trace, validation
list(APPEND dsw_sources
  snapshot/record.cpp
  snapshot/block.cpp
  snapshot/body_image.cpp
  snapshot/body_reader.cpp
  snapshot/scene_snapshot.cpp
  snapshot/snapshot.cpp
  snapshot/wide_records.cpp
  snapshot/trace.cpp
  cross_check/validation.cpp
)

# capi: one .cpp per public header
list(APPEND dsw_sources
  capi/base.cpp
  capi/body.cpp
  capi/body_access.cpp
  capi/body_edit.cpp
  capi/bug_report.cpp
  capi/coarsen.cpp
  capi/cross_check.cpp
  capi/cut_bodies.cpp
  capi/context.cpp
  capi/convert.cpp
  capi/defaults.cpp
  capi/deform.cpp
  capi/detach.cpp
  capi/environment.cpp
  capi/free_fractions.cpp
  capi/guard.cpp
  capi/handle.cpp
  capi/load.cpp
  capi/validate.cpp
  capi/marking.cpp
  capi/move.cpp
  capi/near.cpp
  capi/pairs.cpp
  capi/particle.cpp
  capi/penetration.cpp
  capi/query.cpp
  capi/rays.cpp
  capi/record.cpp
  capi/remesh.cpp
  capi/replay.cpp
  capi/scene.cpp
  capi/snapshot.cpp
  capi/sweep.cpp
  capi/surgery.cpp
  capi/carve.cpp
  capi/together.cpp
  capi/topology.cpp
  capi/trace.cpp
)
