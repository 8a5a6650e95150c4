#include "body.h"

#include <stdlib.h>
#include <string.h>

#include "mesh.h"
#include "output.h"
#include "run.h"

enum { kMostTouches = 1 << 14 };

void figures_create(body_figures *figures, const char *name) {
  memset(figures, 0, sizeof *figures);
  figures->name = name;
  figures->touch_capacity = kMostTouches;
  figures->touch = (double *)demo_allocate(6 * figures->touch_capacity, sizeof(double));
  figures->normal = figures->touch + 3 * figures->touch_capacity;
}

void figures_destroy(body_figures *figures) { free(figures->touch); }

void figures_touch(body_figures *figures, const double *point, const double *normal) {
  if (figures->touch_count < figures->touch_capacity) {
    memcpy(figures->touch + 3 * figures->touch_count, point, 3 * sizeof(double));
    memcpy(figures->normal + 3 * figures->touch_count++, normal, 3 * sizeof(double));
  }
}

void figures_add(body_figures *figures, const dsw_scene *scene, dsw_body_id body, const dsw_move_report *report,
                 double seconds, int keep, FILE *csv) {
  const dsw_body_contact *contacts = NULL;
  const dsw_body_edit *edits = NULL;
  size_t contact_count = 0, edit_count = 0, lasting = 0, inserted = 0;
  require(dsw_body_get_contacts(scene, body, &contacts, &contact_count), "reading contacts", kFailed);
  require(dsw_body_get_edits(scene, body, &edits, &edit_count), "reading edits", kFailed);
  for (size_t i = 0; i < contact_count; ++i) {
    lasting += contacts[i].history == DSW_HISTORY_LASTING;
    if (keep) {
      figures_touch(figures, contacts[i].point, contacts[i].contact.normal);
    }
  }
  for (size_t i = 0; i < edit_count; ++i) {
    inserted += edits[i].inserted;
  }
  figures->moved += report->vertices_moved;
  figures->stopped += report->vertices_stopped;
  figures->contacts += contact_count;
  figures->lasting += lasting;
  figures->inserted += inserted;
  figures->removed += edit_count - inserted;
  figures->seconds += seconds;
  figures->slowest = seconds > figures->slowest ? seconds : figures->slowest;
  if (csv != NULL) {
    fprintf(csv, "%s,%lu,%u,%u,%lu,%lu,%lu,%lu,%.3f\n", figures->name, (unsigned long)figures->steps,
            (unsigned)report->vertices_moved, (unsigned)report->vertices_stopped, (unsigned long)contact_count,
            (unsigned long)lasting, (unsigned long)inserted, (unsigned long)(edit_count - inserted), 1e3 * seconds);
  }
  ++figures->steps;
}

void prove_edges(body_figures *figures, const dsw_scene *scene, dsw_body_id body) {
  dsw_body_counts counts;
  size_t n = 0, slots = 0;
  counts.struct_size = sizeof counts;
  require(dsw_body_get_counts(scene, body, &counts), "reading a body", kFailed);
  slots = counts.vertex_slots;
  n = counts.edge_count;
  double *positions = (double *)demo_allocate(3 * slots + 6 * n, sizeof(double));
  double *from = positions + 3 * slots, *to = from + 3 * n;
  dsw_volume_id *volumes = (dsw_volume_id *)demo_allocate(slots + 2 * n, sizeof(dsw_volume_id));
  dsw_volume_id *start = volumes + slots, *end = start + n;
  dsw_body_edge_id *edges = (dsw_body_edge_id *)demo_allocate(n, sizeof(dsw_body_edge_id));
  dsw_flight *flights = (dsw_flight *)demo_allocate(n, sizeof(dsw_flight));
  require(dsw_body_get_positions(scene, body, positions, slots, 0, volumes, &slots), "reading a body", kFailed);
  require(dsw_body_get_edge_ids(scene, body, edges, n, &n), "reading a body", kFailed);
  for (size_t i = 0; i < n; ++i) {
    dsw_body_vertex_id ends[2];
    require(dsw_body_get_edge_ends(scene, body, edges[i], ends), "reading an edge", kFailed);
    memcpy(from + 3 * i, positions + 3 * (size_t)ends[0].index, 3 * sizeof(double));
    memcpy(to + 3 * i, positions + 3 * (size_t)ends[1].index, 3 * sizeof(double));
    start[i] = volumes[ends[0].index];
    end[i] = volumes[ends[1].index];
  }
  require(dsw_environment_cast_segments(dsw_scene_get_environment(scene), n, start, from, to, 0, NULL, flights),
          "proving the edges", kFailed);
  for (size_t i = 0; i < n; ++i) {
    figures->wrong += flights[i].outcome != DSW_OUTCOME_REACHED || flights[i].volume.index != end[i].index;
  }
  free(positions);
  free(volumes);
  free(edges);
  free(flights);
}

FILE *open_steps(const char *folder) {
  FILE *csv = folder != NULL ? output_open(folder, "steps.csv") : NULL;
  if (csv != NULL) {
    fputs("run,step,vertices_moved,vertices_stopped,contacts,lasting,inserted,removed,ms\n", csv);
  }
  return csv;
}
