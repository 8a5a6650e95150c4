/* What the _init functions write: every member, and not a byte beyond the size that is named; and names of statuses. */
#include <string.h>

#include "calls.h"

/* Memory that is not 0 lies behind each struct. */
#define BEGIN(type, init)                                \
  struct {                                               \
    type d;                                              \
    unsigned char guard[64];                             \
  } s;                                                   \
  memset(&s, 0x5a, sizeof s);                            \
  init(&s.d, 4);                                         \
  say(#type ": %s", is_guard((unsigned char *)&s + 4, sizeof s - 4) ? "no more than it may" : "MORE than it may"); \
  init(&s.d, sizeof s.d);                                \
  say("  behind it: %s", is_guard(s.guard, sizeof s.guard) ? "nothing" : "SOMETHING"); \
  say("  its size: %s", s.d.struct_size == sizeof s.d ? "right" : "WRONG")
#define N(member) number(#member, (double)s.d.member)
#define P(member) say("  " #member " %s", s.d.member == NULL ? "null" : "SET")
#define V(member) say("  " #member " %u %u", s.d.member.index, s.d.member.generation)

static int is_guard(const unsigned char *bytes, size_t count) {
  while (count > 0 && bytes[count - 1] == 0x5a) --count;
  return count == 0;
}

static void number(const char *name, double value) { say("  %s %.9g", name, value); }

static void of_dsw_context_desc(void) {
  BEGIN(dsw_context_desc, dsw_context_desc_init);
  N(thread_count), P(user), P(allocate), P(release), P(log), P(parallel_for);
}

static void of_dsw_scene_desc(void) {
  BEGIN(dsw_scene_desc, dsw_scene_desc_init);
  N(features);
}

static void of_dsw_environment_desc(void) {
  BEGIN(dsw_environment_desc, dsw_environment_desc_init);
  N(dimension), N(flags), N(index_bytes), P(points), N(point_count), N(point_stride_bytes), P(cell_types);
  N(volume_count), P(offsets), P(connectivity), N(connectivity_count), P(faces), N(faces_count), P(face_locations);
  P(regions), P(tags), N(uniform_cell_type), N(reserved);
}

static void of_dsw_body_desc(void) {
  BEGIN(dsw_body_desc, dsw_body_desc_init);
  N(flags), N(level), N(reserved), P(positions), N(vertex_count), N(stride_bytes), P(hints), P(edges), N(edge_count);
  P(face_offsets), P(face_corners), N(face_count), N(face_corner_count), N(motion_share), N(category), N(mask);
}

static void of_dsw_move_options(void) {
  BEGIN(dsw_move_options, dsw_move_options_init);
  N(flags), N(vertex_response), N(edge_response), N(search), N(bisection_depth), N(max_volumes), N(reserved);
  N(min_part), N(min_length), N(stand_off), N(noise_share), P(order), N(order_count);
}

static void of_dsw_cast_options(void) {
  BEGIN(dsw_cast_options, dsw_cast_options_init);
  N(flags), N(max_volumes), N(reserved);
}

static void of_dsw_sweep_options(void) {
  BEGIN(dsw_sweep_options, dsw_sweep_options_init);
  N(flags), N(level), N(max_volumes);
}

static void of_dsw_deform_options(void) {
  BEGIN(dsw_deform_options, dsw_deform_options_init);
  N(flags), N(method), N(response), N(invalid), N(most_halvings), N(min_part), N(point_room), N(remesh_radius);
  N(remesh_max_faces);
}

static void of_dsw_cut_desc(void) {
  BEGIN(dsw_cut_desc, dsw_cut_desc_init);
  N(flags), P(points), N(point_stride_bytes), N(rows), N(columns), V(start), N(snap);
}

static void of_dsw_open_crack_desc(void) {
  BEGIN(dsw_open_crack_desc, dsw_open_crack_desc_init);
  N(flags), P(faces), N(face_count), N(region), N(tag);
}

static void of_dsw_carve_desc(void) {
  BEGIN(dsw_carve_desc, dsw_carve_desc_init);
  N(flags), P(points), N(point_count), N(point_stride_bytes), P(triangles), N(triangle_count), V(start), N(snap);
}

static void of_dsw_tie_desc(void) {
  BEGIN(dsw_tie_desc, dsw_tie_desc_init);
  N(flags), P(points), N(point_count), N(point_stride_bytes), V(start), N(snap);
}

static void of_dsw_detach_desc(void) {
  BEGIN(dsw_detach_desc, dsw_detach_desc_init);
  N(flags), N(level), N(category), N(mask), N(halvings), N(motion_share), N(gap), V(volume), N(max_volumes);
}

static void of_dsw_remesh_desc(void) {
  BEGIN(dsw_remesh_desc, dsw_remesh_desc_init);
  N(flags), P(volumes), N(volume_count), P(next), N(point_count), N(radius), N(max_faces);
}

static void of_dsw_coarsen_options(void) {
  BEGIN(dsw_coarsen_options, dsw_coarsen_options_init);
  N(max_faces), N(max_trials);
}

static void of_dsw_volumes_desc(void) {
  BEGIN(dsw_volumes_desc, dsw_volumes_desc_init);
  N(index_bytes), P(vertices), N(vertex_count), P(points), N(point_count), N(point_stride_bytes), P(cell_types);
  N(volume_count), P(offsets), P(connectivity), N(connectivity_count), P(regions), P(tags), P(sew_to), N(sew_count);
  N(uniform_cell_type), N(reserved);
}

static void of_dsw_recording_desc(void) {
  BEGIN(dsw_recording_desc, dsw_recording_desc_init);
  N(flags), P(path), P(write), P(user);
}

static void of_dsw_bug_report_desc(void) {
  BEGIN(dsw_bug_report_desc, dsw_bug_report_desc_init);
  N(flags), P(path), P(write), P(user), P(note);
}

void call_defaults(void) {
  int status;
  say("version: %s", dsw_version() / 1000000 == DSW_VERSION_MAJOR &&
                             dsw_version() >= DSW_VERSION_MAJOR * 1000000 + DSW_VERSION_MINOR * 1000 + DSW_VERSION_PATCH
                         ? "fits"
                         : "DOES NOT FIT");
  for (status = 0; status <= DSW_STATUS_NOT_ORIENTED; ++status) say("%d %s", status, dsw_status_string((dsw_status)status));
  of_dsw_context_desc();
  of_dsw_scene_desc();
  of_dsw_environment_desc();
  of_dsw_body_desc();
  of_dsw_move_options();
  of_dsw_cast_options();
  of_dsw_sweep_options();
  of_dsw_deform_options();
  of_dsw_cut_desc();
  of_dsw_open_crack_desc();
  of_dsw_carve_desc();
  of_dsw_tie_desc();
  of_dsw_detach_desc();
  of_dsw_remesh_desc();
  of_dsw_coarsen_options();
  of_dsw_volumes_desc();
  of_dsw_recording_desc();
  of_dsw_bug_report_desc();
}
