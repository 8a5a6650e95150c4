/* Bodies in the plane: creation, edits, marks around them, edges swept without one. Moves are in
   plane_move_test.c, refusals of creation in body_test.c. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "stage.h"

static void a_body_has_what_was_given(void) {
  /* Third numbers are not read, nor written. */
  const double triangle[9] = {0.5, 0.5, NAN, 2.5, 0.5, NAN, 1.5, 2.5, NAN};
  const dsw_volume_id hints[3] = {{5, 1}, {0, 0}, {0, 1}};
  dsw_body_desc d = line_desc(triangle, 3, 1, DSW_LEVEL_EDGES_SWEPT);
  dsw_volume_id volumes[3];
  dsw_body_vertex_id ends[2];
  dsw_body_face_id faces[1];
  dsw_body_id body;
  uint32_t edges[6], corners[3];
  double p[9];
  size_t count = 9;
  dsw_level level;
  d.stride_bytes = 24;
  d.hints = hints;
  CHECK_OK(dsw_body_create(g_scene, &d, &body));
  CHECK(has(body, 3, 3, 0) && counts_of(body).face_slots == 0);
  CHECK_OK(dsw_body_get_level(g_scene, body, &level));
  CHECK(level == DSW_LEVEL_EDGES_SWEPT);
  memset(p, 0x55, sizeof p);
  CHECK_OK(dsw_body_get_positions(g_scene, body, p, 3, 24, volumes, &count));
  CHECK(count == 3 && p[0] == 0.5 && p[4] == 0.5 && p[7] == 2.5 && p[2] == p[8] && p[2] > 0);
  CHECK(volumes[0].index == 0 && volumes[1].index == 2 && volumes[2].index == 9);
  CHECK_OK(dsw_body_get_positions(g_scene, body, p, 3, 0, NULL, &count)); /* 16 bytes apart */
  CHECK(p[2] == 2.5 && p[5] == 2.5);
  CHECK_OK(dsw_body_get_edge_indices(g_scene, body, edges, 3, &count));
  CHECK(count == 3 && edges[4] == 2 && edges[5] == 0);
  CHECK_OK(dsw_body_get_edge_ends(g_scene, body, edge_id(1), ends));
  CHECK(ends[0].index == 1 && ends[1].index == 2);
  CHECK_OK(dsw_body_get_face_ids(g_scene, body, faces, 1, &count));
  CHECK(count == 0);
  CHECK_OK(dsw_body_get_face_indices(g_scene, body, corners, 1, &count));
  CHECK(count == 0);
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

static void edits_are_checked(void) {
  const double points[6] = {0.5, 1.5, 0, 1.5, 1.5, 0}, behind[2] = {3.5, 1.5}, bad[2] = {NAN, 0};
  const dsw_body_id body = make_line(points, 2, DSW_LEVEL_EDGES_SWEPT);
  const dsw_body_vertex_id stale = {0, 9};
  const dsw_body_face_id no_face = {0, 1};
  dsw_body_vertex_id far, corners[3];
  dsw_body_edge_id e = {55, 66};
  dsw_body_face_id f;
  dsw_body_edit edit;
  double p[12];
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_body_add_vertex(g_scene, body, bad, no_volume, &far));
  CHECK_OK(dsw_body_add_vertex(g_scene, body, behind, no_volume, &far));
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_body_add_face(g_scene, body, vertex_id(0), vertex_id(1), far, &f));
  CHECK_MESSAGE("bodies in the plane have no faces");
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_remove_face(g_scene, body, no_face));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_get_face_corners(g_scene, body, no_face, corners));
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_add_edge(g_scene, body, stale, far, &e));
  CHECK_OK(mark_cell(g_pillar, DSW_MARK_IMPASSABLE));
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_add_edge(g_scene, body, vertex_id(1), far, &e));
  CHECK(e.index == 55 && e.generation == 66 && has(body, 3, 1, 0));
  CHECK_OK(mark_cell(g_pillar, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_add_edge(g_scene, body, vertex_id(1), far, &e));
  CHECK(e.index == 1 && e.generation == 1 && has(body, 3, 2, 0));
  CHECK_FAILS(DSW_STATUS_OUT_OF_RANGE, dsw_body_split_edge(g_scene, body, e, 1, &edit));
  CHECK_OK(dsw_body_split_edge(g_scene, body, e, 0.25, &edit));
  CHECK(has(body, 4, 3, 0) && edit.inserted == 1 && edit.vertex.index == 3 && edit.edge_parameter == 0.25);
  CHECK(edit.ends[0].index == 1 && edit.ends[1].index == 2 && edit.edge.index == 1 && edit.rest.index == 2);
  CHECK(positions_of(body, p, 4) == 4 && p[9] == 2 && p[10] == 1.5);
  /* Merging 1 into the new vertex turns the edge 0 1, on which nothing lies. */
  CHECK_OK(dsw_body_collapse_edge(g_scene, body, e, vertex_id(1), &edit));
  CHECK(has(body, 3, 2, 0) && edit.inserted == 0 && edit.vertex.index == 1 && edit.ends[0].index == 3);
  CHECK_FAILS(DSW_STATUS_STALE_ID, dsw_body_collapse_edge(g_scene, body, e, vertex_id(1), &edit));
  CHECK_OK(dsw_body_remove_edge(g_scene, body, edge_id(0)));
  CHECK_OK(dsw_body_remove_vertex(g_scene, body, far));
  CHECK(has(body, 2, 0, 0));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* A triangle folded flat onto a point obstacle can't be merged across it. */
static void a_merge_is_swept(void) {
  const double points[9] = {0.5, 0.5, 0, 1.25, 2.5, 0, 3.5, 0.5, 0};
  dsw_body_id body = make_line(points, 3, DSW_LEVEL_EDGES_SWEPT);
  dsw_body_edit edit;
  CHECK_OK(mark_point(1, 1, DSW_MARK_IMPASSABLE)); /* under the edge 0 1 */
  CHECK_FAILS(DSW_STATUS_OCCUPIED, dsw_body_collapse_edge(g_scene, body, edge_id(1), vertex_id(1), &edit));
  CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES)); /* does not see a point */
  CHECK_OK(dsw_body_collapse_edge(g_scene, body, edge_id(1), vertex_id(1), &edit));
  CHECK(has(body, 2, 1, 0));
  CHECK_OK(mark_point(1, 1, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_body_destroy(g_scene, body));
}

/* A closed curve round (2, 2) and its square. */
static void marks_leave_bodies_free(void) {
  const double points[6] = {1.5, 1.25, 3.5, 1.75, 1.75, 3.5};
  dsw_body_desc d = line_desc(points, 3, 1, DSW_LEVEL_EDGES);
  const dsw_volume_id all[4] = {{6, 1}, {5, 1}, {3, 1}, {15, 1}};
  const dsw_body_id *bodies = NULL;
  dsw_body_id body;
  size_t count = 99;
  int level, flag = 9;
  for (level = DSW_LEVEL_POINTS; level <= DSW_LEVEL_EDGES_SWEPT; ++level) {
    d.level = (dsw_level)level;
    CHECK_OK(dsw_body_create(g_scene, &d, &body));
    CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cell(g_pillar - 1, DSW_MARK_IMPASSABLE)); /* a vertex */
    CHECK_OK(dsw_scene_get_occupant_bodies(g_scene, &bodies, &count));
    CHECK(count == 1 && bodies[0].index == body.index && bodies[0].generation == body.generation);
    if (level > DSW_LEVEL_POINTS) {
      CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_cell(g_pillar, DSW_MARK_IMPASSABLE)); /* an edge */
      CHECK_FAILS(DSW_STATUS_OCCUPIED, mark_face(g_pillar, SIDE_LEFT, DSW_MARK_IMPASSABLE));
      CHECK_OK(mark_face(g_pillar, SIDE_UP, DSW_MARK_IMPASSABLE)); /* along it */
      CHECK_OK(mark_face(g_pillar, SIDE_UP, DSW_MARK_PASSABLE));
      CHECK_OK(dsw_environment_mark_volumes(g_env, all, 4, DSW_MARK_IMPASSABLE, DSW_MARK_SKIP_OCCUPIED, &count));
      CHECK(count == 2);
      CHECK_OK(dsw_environment_is_marked(g_env, cell_at(DSW_CELL_VOLUME, 15, 0), &flag));
      CHECK(flag == 1);
      CHECK_OK(dsw_environment_mark_volumes(g_env, all, 4, DSW_MARK_PASSABLE, 0, NULL));
    } else {
      CHECK_OK(mark_cell(g_pillar, DSW_MARK_IMPASSABLE));
      CHECK_OK(mark_cell(g_pillar, DSW_MARK_PASSABLE));
    }
    CHECK_OK(mark_point(2, 2, DSW_MARK_IMPASSABLE)); /* inside of the curve */
    CHECK_OK(mark_point(2, 2, DSW_MARK_PASSABLE));
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
  {
    /* An edge that lies on a vertex does not under the shift, before and after. */
    const double over[6] = {0.5, 0.5, 0, 1.5, 1.5, 0};
    body = make_line(over, 2, DSW_LEVEL_EDGES_SWEPT);
    CHECK_OK(mark_point(1, 1, DSW_MARK_IMPASSABLE));
    CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_POINTS));
    CHECK_OK(dsw_body_set_level(g_scene, body, DSW_LEVEL_EDGES_SWEPT));
    CHECK_OK(mark_point(1, 1, DSW_MARK_PASSABLE));
    CHECK_OK(dsw_body_destroy(g_scene, body));
  }
}

static void edges_are_swept_without_a_body(void) {
  const double from[6] = {0.5, 0.25, NAN, 1.5, 1.25, NAN}, to[6] = {0.5, 3.75, NAN, 2.5, 1.5, NAN};
  const double fixed[6] = {3.75, 0.5, NAN, 1.25, 3.5, NAN};
  dsw_sweep_options o;
  dsw_sweep s[2];
  dsw_sweep_options_init(&o, sizeof o);
  CHECK_OK(dsw_environment_sweep_edges(g_env, 2, NULL, from, to, fixed, 24, NULL, s));
  CHECK(s[0].outcome == DSW_OUTCOME_REACHED && s[0].time == 1 && s[0].position[1] == 3.75 && s[0].position[2] == 0);
  CHECK(s[1].outcome == DSW_OUTCOME_REACHED && s[1].volume.index == g_pillar);
  CHECK_OK(mark_point(2, 2, DSW_MARK_IMPASSABLE));
  CHECK_OK(mark_cell(g_pillar, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_sweep_edges(g_env, 2, NULL, from, to, fixed, 24, NULL, s));
  CHECK(s[0].outcome == DSW_OUTCOME_CONTACT && s[0].contact.kind == DSW_CONTACT_VERTEX &&
        s[0].contact.marked_kind == DSW_CELL_VOLUME);
  CHECK(s[0].contact.obstacle.index == point_at(2, 1) && s[0].contact.obstacle.generation == 1 &&
        s[0].contact.tag == 100 + g_pillar);
  CHECK(s[0].contact.wall.generation == 1 && s[0].contact.normal[1] < 0 && s[0].contact.normal[2] == 0 &&
        fabs(s[0].point[1] - 1) < 1e-14);
  CHECK(s[1].outcome == DSW_OUTCOME_CONTACT && s[1].contact.kind == DSW_CONTACT_PLANE && s[1].time == 0.5);
  CHECK(s[1].contact.obstacle.kind == DSW_CELL_FACE && s[1].contact.wall.volume == g_pillar - 1 &&
        s[1].contact.normal[0] == -1);
  CHECK_OK(mark_cell(g_pillar, DSW_MARK_PASSABLE));
  CHECK_OK(dsw_environment_sweep_edges(g_env, 2, NULL, from, to, fixed, 24, NULL, s));
  CHECK(s[0].outcome == DSW_OUTCOME_CONTACT && s[0].contact.kind == DSW_CONTACT_VERTEX &&
        s[0].contact.marked_kind == DSW_CELL_VERTEX);
  CHECK(s[0].contact.obstacle.index == point_at(2, 2) && s[0].contact.wall.generation == 0 && s[0].contact.tag == 0 &&
        s[0].contact.front.generation == 1);
  o.level = DSW_LEVEL_EDGES; /* a lone vertex is met by what is swept alone */
  CHECK_OK(dsw_environment_sweep_edges(g_env, 1, NULL, from, to, fixed, 0, &o, s));
  CHECK(s[0].outcome == DSW_OUTCOME_REACHED);
  o.level = DSW_LEVEL_FACES;
  CHECK_FAILS(DSW_STATUS_UNSUPPORTED, dsw_environment_sweep_edges(g_env, 1, NULL, from, to, fixed, 0, &o, s));
  CHECK_FAILS(DSW_STATUS_WRONG_SIZE, dsw_environment_sweep_edges(g_env, 1, NULL, from, to, fixed, 8, NULL, s));
  CHECK_FAILS(DSW_STATUS_NON_FINITE, dsw_environment_sweep_edges(g_env, 2, NULL, from, to, fixed, 16, NULL, s));
  CHECK_MESSAGE("from[1][0] is nan");
  CHECK_OK(mark_point(2, 2, DSW_MARK_PASSABLE));
}

/* The corner (1, 2) of two walls round square 4, seen from square 5: behind the first wall is square 4. */
static void a_tag_is_that_of_what_is_behind_the_wall(void) {
  const double from[2] = {1.25, 2.5}, to[2] = {0.25, 2.25}, fixed[2] = {1.25, 1.5};
  dsw_sweep s;
  CHECK_OK(mark_face(N, SIDE_RIGHT, DSW_MARK_IMPASSABLE));
  CHECK_OK(mark_face(N, SIDE_UP, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_sweep_edges(g_env, 1, NULL, from, to, fixed, 0, NULL, &s));
  CHECK(s.outcome == DSW_OUTCOME_CONTACT && s.contact.kind == DSW_CONTACT_VERTEX &&
        s.contact.obstacle.index == point_at(1, 2));
  CHECK(s.contact.front.index == N + 1 && s.contact.wall.volume == N && s.contact.wall.local == SIDE_RIGHT &&
        s.contact.tag == 100 + N);
  CHECK_OK(mark_face(N, SIDE_RIGHT, DSW_MARK_PASSABLE));
  CHECK_OK(mark_face(N, SIDE_UP, DSW_MARK_PASSABLE));
}

/* The lower end (2, 1) of a thin wall, met from below, where neither square is at the wall, from both sides. */
static void a_tag_at_the_end_of_a_wall_is_that_of_its_other_side(void) {
  static const double from[4] = {3.5, 0.5, 0.5, 0.5}, to[4] = {0.5, 0.5, 3.5, 0.5}, fixed[4] = {2.2, 2.9, 1.8, 2.9};
  dsw_sweep s[2];
  CHECK_OK(mark_face(g_pillar - 1, SIDE_RIGHT, DSW_MARK_IMPASSABLE));
  CHECK_OK(dsw_environment_sweep_edges(g_env, 2, NULL, from, to, fixed, 0, NULL, s));
  CHECK(s[0].contact.kind == DSW_CONTACT_VERTEX && s[0].contact.obstacle.index == point_at(2, 1) &&
        s[0].contact.normal[0] > 0.9);
  CHECK(s[1].contact.kind == DSW_CONTACT_VERTEX && s[1].contact.obstacle.index == point_at(2, 1) &&
        s[1].contact.normal[0] < -0.9);
  CHECK(s[0].contact.tag == 100 + g_pillar - 1 && s[1].contact.tag == 100 + g_pillar);
  CHECK_OK(mark_face(g_pillar - 1, SIDE_RIGHT, DSW_MARK_PASSABLE));
}

static void what_sweeps_nothing_needs_no_work_left(void) {
  const double from[2] = {0.5, 0.25}, fixed[2] = {3.75, 0.5};
  dsw_sweep_options o;
  dsw_sweep s;
  dsw_sweep_options_init(&o, sizeof o);
  CHECK_OK(dsw_environment_sweep_edges(g_env, 1, NULL, from, fixed, fixed, 0, &o, &s));
  o.max_volumes = s.volumes_visited;
  CHECK_OK(dsw_environment_sweep_edges(g_env, 1, NULL, from, fixed, fixed, 0, &o, &s));
  CHECK(s.outcome == DSW_OUTCOME_REACHED && s.volumes_visited == o.max_volumes);
  --o.max_volumes;
  CHECK_OK(dsw_environment_sweep_edges(g_env, 1, NULL, from, fixed, fixed, 0, &o, &s));
  CHECK(s.outcome == DSW_OUTCOME_WORK_LIMIT);
}

static void what_a_scene_holds_is_told(void) {
  dsw_scene *const scene = make_scene(g_env, DSW_FEATURE_STATISTICS);
  const double left[4] = {1.25, 0.25, 1.25, 3.75}, out[4] = {-1, 0.25, -1, 3.75};
  const dsw_body_desc d = line_desc(left, 2, 0, DSW_LEVEL_EDGES_SWEPT);
  dsw_statistics statistics = {0};
  dsw_body_id body, bodies[2];
  uint64_t before = 0, with = 0;
  size_t count = 0;
  statistics.struct_size = sizeof statistics;
  CHECK_OK(dsw_scene_get_memory_bytes(scene, &before));
  CHECK_OK(dsw_body_create(scene, &d, &body));
  CHECK_OK(dsw_scene_get_memory_bytes(scene, &with));
  CHECK(with >= before + 2 * 24 + 24);
  CHECK_OK(dsw_scene_get_body_ids(scene, bodies, 2, &count));
  CHECK(count == 1 && bodies[0].index == body.index);
  CHECK_OK(dsw_body_move(scene, body, out, 2, 0, NULL, NULL));
  CHECK_OK(dsw_scene_get_statistics(scene, &statistics));
  CHECK(statistics.contacts == 2 && statistics.casts >= 2 && statistics.orientation_tests > 0);
  CHECK_OK(dsw_scene_destroy(scene));
}

int main(void) {
  begin_stage(2);
  a_body_has_what_was_given();
  edits_are_checked();
  a_merge_is_swept();
  marks_leave_bodies_free();
  edges_are_swept_without_a_body();
  a_tag_is_that_of_what_is_behind_the_wall();
  a_tag_at_the_end_of_a_wall_is_that_of_its_other_side();
  what_sweeps_nothing_needs_no_work_left();
  what_a_scene_holds_is_told();
  end_stage();
  return check_result();
}
