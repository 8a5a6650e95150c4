#include "lumen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base.h"

size_t mark_wall(dsw_environment *environment, const demo_mesh *mesh) {
  size_t marked = 0;
  if (mesh->lumen != 0) {
    int32_t least = 0x7fffffff, most = -0x7fffffff;
    for (size_t i = 0; i < mesh->cell_count; ++i) {
      least = mesh->regions[i] < least ? mesh->regions[i] : least;
      most = mesh->regions[i] > most ? mesh->regions[i] : most;
    }
    for (int32_t other = least; other <= most; ++other) {
      size_t faces = 0;
      if (other != mesh->lumen) {
        require(dsw_environment_mark_between(environment, mesh->lumen, other, DSW_MARK_IMPASSABLE, &faces),
                "marking the wall", kFailed);
      }
      marked += faces;
    }
  } else if (mesh->wall_count > 0) {
    size_t missing = 0;
    dsw_face_id *faces = (dsw_face_id *)demo_allocate(mesh->wall_count, sizeof(dsw_face_id));
    require(dsw_environment_find_faces(environment, mesh->wall_count, mesh->wall_offsets, mesh->wall_points, faces,
                                       &missing),
            "finding the faces of the wall", kBadInput);
    for (size_t i = 0; i < mesh->wall_count; ++i) {
      if (faces[i].generation != 0) {
        faces[marked++] = faces[i];
      }
    }
    require(dsw_environment_mark_faces(environment, faces, marked, DSW_MARK_IMPASSABLE), "marking the wall", kFailed);
    free(faces);
    if (missing > 0) {
      fprintf(stderr, "demo: %lu faces of the wall belong to no cell and were left out\n", (unsigned long)missing);
    }
  }
  return marked;
}

dsw_environment *create_environment(dsw_context *context, const demo_mesh *mesh) {
  dsw_environment_desc desc;
  dsw_environment *environment = NULL;
  dsw_build_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = mesh->points;
  desc.point_count = mesh->point_count;
  desc.cell_types = mesh->types;
  desc.volume_count = mesh->cell_count;
  desc.offsets = mesh->offsets;
  desc.connectivity = mesh->connectivity;
  desc.connectivity_count = mesh->connectivity_count;
  desc.regions = mesh->regions;
  desc.flags = DSW_ENVIRONMENT_REORIENT | DSW_ENVIRONMENT_LOCATE_TREE | DSW_ENVIRONMENT_FIND_TOUCHING;
  require(dsw_environment_create(context, &desc, &environment, &report), "the mesh cannot be used", kBadInput);
  if (report.touching_face_count != 0) {
    fprintf(stderr,
            "demo: %u faces of the mesh lie on faces of other cells and are walls; the first is a face of cell %u\n",
            report.touching_face_count, report.touching_face.volume);
  }
  return environment;
}
