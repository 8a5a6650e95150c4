#include "changes.h"

#include <string.h>

#include "run.h"

void changes_add(change_figures *figures, double seconds) {
  figures->seconds += seconds;
  figures->slowest = seconds > figures->slowest ? seconds : figures->slowest;
  ++figures->steps;
}

void changes_deform(change_figures *figures, dsw_scene *scene, double *next, size_t point_count,
                    body_figures *touched) {
  dsw_deform_report report;
  const dsw_wall_contact *contacts = NULL;
  size_t count = 0;
  double start = seconds_now();
  require(dsw_environment_deform(dsw_scene_get_environment(scene), next, point_count, NULL, &report),
          "bending the environment", kFailed);
  changes_add(figures, seconds_now() - start);
  figures->contacts += report.contact_count;
  figures->pushed += report.pushed_count;
  figures->held += report.held_count;
  require(dsw_environment_get_wall_contacts(dsw_scene_get_environment(scene), &contacts, &count),
          "reading contacts of walls", kFailed);
  for (size_t i = 0; touched != NULL && i < count; ++i) {
    figures_touch(touched, contacts[i].point, contacts[i].contact.normal);
  }
}

void changes_prove(change_figures *figures, body_figures *moves, dsw_scene *scene, dsw_body_id body) {
  dsw_level level = DSW_LEVEL_POINTS;
  require(dsw_body_get_level(scene, body, &level), "reading a level", kFailed);
  require(dsw_body_set_level(scene, body, DSW_LEVEL_POINTS), "lowering a level", kFailed);
  ++figures->proofs;
  dsw_status status = dsw_body_set_level(scene, body, level);
  if (status == DSW_STATUS_OCCUPIED) {
    ++figures->wrong;
  } else {
    require(status, "raising a level", kFailed);
  }
  size_t wrong = moves->wrong;
  prove_edges(moves, scene, body);
  figures->wrong += moves->wrong - wrong;
}

void changes_add_body(change_figures *figures, const body_figures *moves, size_t vertices) {
  figures->body_vertices += vertices;
  figures->moves += moves->steps;
  figures->body_contacts += moves->contacts;
  figures->move_seconds += moves->seconds;
}

void changes_end(change_figures *figures, const dsw_environment *environment) {
  dsw_environment_info info;
  info.struct_size = sizeof info;
  require(dsw_environment_get_info(environment, &info), "reading the environment", kFailed);
  figures->volumes = info.volume_count;
  figures->sound = dsw_environment_check(environment, NULL) == DSW_STATUS_OK;
}
