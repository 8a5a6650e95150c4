/* Part of layout.c: what cuts, opens, carves, detaches, bends and mends an environment. */

SIZE(dsw_cut_desc, 48);
AT(dsw_cut_desc, struct_size, 0);
AT(dsw_cut_desc, flags, 4);
AT(dsw_cut_desc, points, 8);
AT(dsw_cut_desc, point_stride_bytes, 16);
AT(dsw_cut_desc, rows, 24);
AT(dsw_cut_desc, columns, 28);
AT(dsw_cut_desc, start, 32);
AT(dsw_cut_desc, snap, 40);
GROWS(dsw_cut_desc, snap);

SIZE(dsw_cut_report, 40);
AT(dsw_cut_report, distance, 0);
AT(dsw_cut_report, volumes_crossed, 8);
AT(dsw_cut_report, volumes_split, 12);
AT(dsw_cut_report, volumes_whole, 16);
AT(dsw_cut_report, volumes_changed, 20);
AT(dsw_cut_report, volumes_visited, 24);
AT(dsw_cut_report, vertex_count, 28);
AT(dsw_cut_report, face_count, 32);
AT(dsw_cut_report, reserved, 36);

SIZE(dsw_cut_vertex, 40);
AT(dsw_cut_vertex, vertex, 0);
AT(dsw_cut_vertex, from, 8);
AT(dsw_cut_vertex, weights, 24);

SIZE(dsw_cut_face, 24);
AT(dsw_cut_face, front, 0);
AT(dsw_cut_face, back, 12);

SIZE(dsw_carve_desc, 64);
AT(dsw_carve_desc, struct_size, 0);
AT(dsw_carve_desc, flags, 4);
AT(dsw_carve_desc, points, 8);
AT(dsw_carve_desc, point_count, 16);
AT(dsw_carve_desc, point_stride_bytes, 24);
AT(dsw_carve_desc, triangles, 32);
AT(dsw_carve_desc, triangle_count, 40);
AT(dsw_carve_desc, start, 48);
AT(dsw_carve_desc, snap, 56);
GROWS(dsw_carve_desc, snap);

SIZE(dsw_carve_report, 48);
AT(dsw_carve_report, cut, 0);
AT(dsw_carve_report, volumes_carved, 40);
AT(dsw_carve_report, reserved, 44);

SIZE(dsw_tie_desc, 48);
AT(dsw_tie_desc, struct_size, 0);
AT(dsw_tie_desc, flags, 4);
AT(dsw_tie_desc, points, 8);
AT(dsw_tie_desc, point_count, 16);
AT(dsw_tie_desc, point_stride_bytes, 24);
AT(dsw_tie_desc, start, 32);
AT(dsw_tie_desc, snap, 40);
GROWS(dsw_tie_desc, snap);

SIZE(dsw_tie_report, 48);
AT(dsw_tie_report, cut, 0);
AT(dsw_tie_report, is_closed, 40);
AT(dsw_tie_report, reserved, 44);

SIZE(dsw_open_crack_desc, 40);
AT(dsw_open_crack_desc, struct_size, 0);
AT(dsw_open_crack_desc, flags, 4);
AT(dsw_open_crack_desc, faces, 8);
AT(dsw_open_crack_desc, face_count, 16);
AT(dsw_open_crack_desc, width, 24);
AT(dsw_open_crack_desc, region, 32);
AT(dsw_open_crack_desc, tag, 36);
GROWS(dsw_open_crack_desc, tag);

SIZE(dsw_open_report, 32);
AT(dsw_open_report, smallest_width, 0);
AT(dsw_open_report, largest_width, 8);
AT(dsw_open_report, vertices_parted, 16);
AT(dsw_open_report, vertices_shortened, 20);
AT(dsw_open_report, faces_opened, 24);
AT(dsw_open_report, volumes_changed, 28);

SIZE(dsw_detach_desc, 56);
AT(dsw_detach_desc, struct_size, 0);
AT(dsw_detach_desc, flags, 4);
AT(dsw_detach_desc, level, 8);
AT(dsw_detach_desc, category, 12);
AT(dsw_detach_desc, mask, 16);
AT(dsw_detach_desc, halvings, 20);
AT(dsw_detach_desc, motion_share, 24);
AT(dsw_detach_desc, gap, 32);
AT(dsw_detach_desc, volume, 40);
AT(dsw_detach_desc, max_volumes, 48);
GROWS(dsw_detach_desc, max_volumes);

SIZE(dsw_detach_report, 32);
AT(dsw_detach_report, distance, 0);
AT(dsw_detach_report, volume_count, 8);
AT(dsw_detach_report, vertex_count, 12);
AT(dsw_detach_report, face_count, 16);
AT(dsw_detach_report, sewn_count, 20);
AT(dsw_detach_report, unsewn_count, 24);
AT(dsw_detach_report, reserved, 28);

SIZE(dsw_detached_vertex, 32);
AT(dsw_detached_vertex, from, 0);
AT(dsw_detached_vertex, weights, 16);

SIZE(dsw_detached_face, 20);
AT(dsw_detached_face, face, 0);
AT(dsw_detached_face, volume, 12);

SIZE(dsw_deform_options, 48);
AT(dsw_deform_options, struct_size, 0);
AT(dsw_deform_options, flags, 4);
AT(dsw_deform_options, method, 8);
AT(dsw_deform_options, response, 12);
AT(dsw_deform_options, invalid, 16);
AT(dsw_deform_options, most_halvings, 20);
AT(dsw_deform_options, min_part, 24);
AT(dsw_deform_options, point_room, 32);
AT(dsw_deform_options, remesh_radius, 40);
AT(dsw_deform_options, remesh_max_faces, 44);
GROWS(dsw_deform_options, remesh_max_faces);

SIZE(dsw_remesh_desc, 48);
AT(dsw_remesh_desc, struct_size, 0);
AT(dsw_remesh_desc, flags, 4);
AT(dsw_remesh_desc, volumes, 8);
AT(dsw_remesh_desc, volume_count, 16);
AT(dsw_remesh_desc, next, 24);
AT(dsw_remesh_desc, point_count, 32);
AT(dsw_remesh_desc, radius, 40);
AT(dsw_remesh_desc, max_faces, 44);
GROWS(dsw_remesh_desc, max_faces);

SIZE(dsw_remesh_report, 32);
AT(dsw_remesh_report, invalid_count, 0);
AT(dsw_remesh_report, mended_count, 4);
AT(dsw_remesh_report, left_count, 8);
AT(dsw_remesh_report, patch_count, 12);
AT(dsw_remesh_report, volumes_removed, 16);
AT(dsw_remesh_report, volumes_added, 20);
AT(dsw_remesh_report, most_faces, 24);
AT(dsw_remesh_report, reserved, 28);

SIZE(dsw_deform_report, 40);
AT(dsw_deform_report, fraction, 0);
AT(dsw_deform_report, outcome, 8);
AT(dsw_deform_report, steps, 12);
AT(dsw_deform_report, near_count, 16);
AT(dsw_deform_report, held_count, 20);
AT(dsw_deform_report, contact_count, 24);
AT(dsw_deform_report, invalid_count, 28);
AT(dsw_deform_report, pushed_count, 32);
AT(dsw_deform_report, remeshed_count, 36);

SIZE(dsw_wall_contact, 200);
AT(dsw_wall_contact, from, 0);
AT(dsw_wall_contact, to, 24);
AT(dsw_wall_contact, time, 48);
AT(dsw_wall_contact, point, 56);
AT(dsw_wall_contact, normal, 80);
AT(dsw_wall_contact, along, 104);
AT(dsw_wall_contact, moving, 112);
AT(dsw_wall_contact, others, 120);
AT(dsw_wall_contact, wall, 136);
AT(dsw_wall_contact, particle, 148);
AT(dsw_wall_contact, body, 156);
AT(dsw_wall_contact, vertex, 164);
AT(dsw_wall_contact, edge, 172);
AT(dsw_wall_contact, face, 180);
AT(dsw_wall_contact, response, 188);
AT(dsw_wall_contact, tag, 192);
AT(dsw_wall_contact, reserved, 196);
