/* Steps of a scene, and what there is to see. */
#include "scene.h"

#include <stdio.h>
#include <string.h>

#include "state.h"

/* The hand feeds a link in, or takes one out. It waits where the wire is squeezed or stretched. */
static int feed(scene *s, double *push) {
  wire *w = &s->wire;
  const dsw_volume_id none = {0, 0};
  const double stretch = wire_stretch(w), most = 0.35 * w->link;
  *push = *push > most ? most : (*push < -most ? -most : *push);
  if ((*push > 0 && (stretch < -0.02 || (w->count == s->most_vertices && w->in + *push >= w->link))) ||
      (*push < 0 && (stretch > 0.02 || (w->count == 3 && w->in + *push < 0)))) {
    *push = 0;
  }
  w->in += *push;
  if (w->in >= w->link) {
    dsw_body_vertex_id added, last;
    dsw_body_edge_id edge;
    if (!good(dsw_body_get_vertex_id(s->scene, s->body, (uint32_t)w->count - 1, &last), "feeding the wire") ||
        !good(dsw_body_add_vertex(s->scene, s->body, w->entry, none, &added), "feeding the wire")) {
      return 0;
    }
    if (dsw_body_add_edge(s->scene, s->body, last, added, &edge) != DSW_STATUS_OK) { /* later, when there is room */
      w->in -= *push;
      *push = 0;
      return good(dsw_body_remove_vertex(s->scene, s->body, added), "feeding the wire");
    }
    if (added.index != w->count) return fail("the wire's vertices are not in order");
    memcpy(w->at + 3 * w->count, w->entry, sizeof w->entry);
    ++w->count;
    s->slots = w->count > s->slots ? w->count : s->slots;
    w->in -= w->link;
  } else if (w->in < 0) {
    dsw_body_vertex_id last;
    if (!good(dsw_body_get_vertex_id(s->scene, s->body, (uint32_t)w->count - 1, &last), "taking the wire out") ||
        !good(dsw_body_remove_vertex(s->scene, s->body, last), "taking the wire out")) {
      return 0;
    }
    --w->count;
    w->in += w->link;
  }
  return 1;
}

static void keep_contact(scene *s, const double *point, const double *normal, double impulse, double kind,
                         double time) {
  scene_contact *c = s->contacts + s->contact_count;
  if (s->contact_count == kMostContacts) return;
  memcpy(c->point, point, sizeof c->point);
  memcpy(c->normal, normal, sizeof c->normal);
  c->impulse = impulse;
  c->kind = kind;
  c->time = time;
  ++s->contact_count;
}

/* Rows that press, and what the move has met nevertheless. */
static int keep_contacts(scene *s, const wire_rows *rows) {
  static const double kKinds[] = {0, 3, 2, 1, 0}; /* by dsw_cell_kind */
  const dsw_body_contact *contacts = NULL;
  size_t count = 0, i;
  s->contact_count = 0;
  for (i = 0; i < rows->count; ++i) {
    const dsw_near_row *row = rows->rows + i;
    if (s->wire.impulse[i] > 0) {
      keep_contact(s, row->obstacle_point, row->normal, s->wire.impulse[i], kKinds[row->obstacle.kind], -1);
    }
  }
  if (!good(dsw_body_get_contacts(s->scene, s->body, &contacts, &count), "reading contacts")) return 0;
  for (i = 0; i < count; ++i) {
    keep_contact(s, contacts[i].point, contacts[i].contact.normal, 0, contacts[i].contact.kind, contacts[i].time);
  }
  return 1;
}

int read_wire(scene *s) {
  size_t count = 0;
  return good(dsw_body_get_positions(s->scene, s->body, s->wire.at, kMostVertices, 0, NULL, &count),
              "reading the wire");
}

int scene_step(scene *s, double push, double turn, int on) {
  wire *w = &s->wire;
  wire_rows rows;
  size_t entries = 0;
  const int moves = on || s->strength > 0 || s->opening_steps > 0;
  s->wall_moves = moves && !s->wall_moves; /* in every other step: half of the time, and one cannot see it */
  if (s->wall_moves && (!bend(s, on) || !read_wire(s))) return 0;
  wire_turn(w, turn > 0.2 ? 0.2 : (turn < -0.2 ? -0.2 : turn));
  if (!feed(s, &push) || !good(dsw_body_find_near_rows(s->scene, s->body, &s->near_options, NULL), "finding rows") ||
      !good(dsw_body_get_near_offsets(s->scene, s->body, &rows.offsets, &entries), "reading rows") ||
      !good(dsw_body_get_near_columns(s->scene, s->body, &rows.columns, &entries), "reading rows") ||
      !good(dsw_body_get_near_values(s->scene, s->body, &rows.values, &entries), "reading rows") ||
      !good(dsw_body_get_near_rows(s->scene, s->body, &rows.rows, &rows.count), "reading rows")) {
    return 0;
  }
  rows.count = rows.count < kMostRows ? rows.count : kMostRows;
  wire_find_targets(w, push, &rows);
  return good(dsw_body_move(s->scene, s->body, w->target, s->slots, 0, &s->move_options, NULL), "moving the wire") &&
         keep_contacts(s, &rows) && read_wire(s);
}

const double *scene_get_wire(const scene *s, size_t *count) {
  *count = s->wire.count;
  return s->wire.at;
}

const scene_contact *scene_get_contacts(const scene *s, size_t *count) {
  *count = s->contact_count;
  return s->contacts;
}

static int trace_wall(scene *s, dsw_trace_data *data) {
  data->struct_size = sizeof *data;
  if (!s->traced &&
      (!good(dsw_trace_clear(s->trace), "drawing the wall") ||
       !good(dsw_trace_add_impassable(s->trace, s->environment, s->with_boundary, 0), "drawing the wall"))) {
    return 0;
  }
  s->traced = 1;
  return good(dsw_trace_get_data(s->trace, data), "drawing the wall");
}

const double *scene_get_wall_points(scene *s, size_t *count) {
  dsw_trace_data data;
  *count = 0;
  if (!trace_wall(s, &data)) return NULL;
  *count = data.point_count;
  return data.points;
}

const uint32_t *scene_get_wall_triangles(scene *s, size_t *count) {
  dsw_trace_data data;
  *count = 0;
  if (!trace_wall(s, &data)) return NULL;
  *count = data.triangle_count;
  return data.triangles;
}

uint32_t scene_get_wall_version(const scene *s) { return s->wall_version; }

const scene_size *scene_get_size(const scene *s) { return &s->size; }

void wall_has_changed(scene *s) {
  s->traced = 0;
  ++s->wall_version;
}
