/** @file ids.h
 * Ids: an `index`, and a `generation` that counts the uses of the index from 1 on. `volume` is the
 * index of a volume. The null id is all zeros. An id becomes stale when its object is removed, or
 * its volume rebuilt by a change of the topology (topology.h). Pass an id with the environment or
 * scene that gave it.
 */
#ifndef DARTSWEEP_IDS_H
#define DARTSWEEP_IDS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A vertex of an environment, at first with its point's index. */
typedef struct dsw_vertex_id {
  uint32_t index;
  uint32_t generation;
} dsw_vertex_id;

/** A volume of an environment, at first with its cell's index. */
typedef struct dsw_volume_id {
  uint32_t index;
  uint32_t generation;
} dsw_volume_id;

/** A face: face number `local` of a volume, in VTK's order of the cell type, or that of the face
 * stream. A face between two volumes has two ids: functions accept both, and reports give the
 * canonical one, of the volume with the lower index. */
typedef struct dsw_face_id {
  uint32_t volume;
  uint32_t generation;
  uint32_t local; /**< Its number there. */
} dsw_face_id;

/** An edge: edge number `local` of a volume, counted where it first occurs on the faces in their
 * order, each run round as seen from outside. Canonical is that of the volume with the lowest
 * index. */
typedef struct dsw_edge_id {
  uint32_t volume;
  uint32_t generation;
  uint32_t local; /**< Its number there. */
} dsw_edge_id;

/** A particle of a scene. */
typedef struct dsw_particle_id {
  uint32_t index;
  uint32_t generation;
} dsw_particle_id;

/** A body of a scene. */
typedef struct dsw_body_id {
  uint32_t index;
  uint32_t generation;
} dsw_body_id;

/** A vertex of a body; its index is its place in arrays. */
typedef struct dsw_body_vertex_id {
  uint32_t index;
  uint32_t generation;
} dsw_body_vertex_id;

/** An edge of a body. */
typedef struct dsw_body_edge_id {
  uint32_t index;
  uint32_t generation;
} dsw_body_edge_id;

/** A triangle of a body. */
typedef struct dsw_body_face_id {
  uint32_t index;
  uint32_t generation;
} dsw_body_face_id;

/** Kind of a cell. */
typedef enum dsw_cell_kind {
  DSW_CELL_NONE = 0,   /**< No cell. */
  DSW_CELL_VERTEX = 1, /**< A dsw_vertex_id. */
  DSW_CELL_EDGE = 2,   /**< A dsw_edge_id. */
  DSW_CELL_FACE = 3,   /**< A dsw_face_id. */
  DSW_CELL_VOLUME = 4, /**< A dsw_volume_id. */
  DSW_CELL_KIND_FORCE_INT32 = 0x7fffffff
} dsw_cell_kind;

/** A cell of any kind, with the numbers of its id. */
typedef struct dsw_cell {
  dsw_cell_kind kind; /**< Kind of the id. */
  uint32_t index;
  uint32_t generation;
  uint32_t local; /**< Face or edge number, or 0. */
} dsw_cell;

#ifdef __cplusplus
}
#endif

#endif
