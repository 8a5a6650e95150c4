/** @file ids.h
 * Ids: an index and a generation, which counts the uses of that index from 1 on. The null id is all
 * zeros. An id becomes stale when its object is removed, or when a change of the topology rebuilds
 * its volume (topology.h). Ids do not name their environment or scene: pass the one that gave the
 * id. This header includes nothing of Dartsweep.
 */
#ifndef DARTSWEEP_IDS_H
#define DARTSWEEP_IDS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A vertex of an environment. At creation its index is that of its point. */
typedef struct dsw_vertex_id {
  uint32_t index;      /**< Slot. */
  uint32_t generation; /**< Generation. */
} dsw_vertex_id;

/** A volume of an environment. At creation its index is that of its cell. */
typedef struct dsw_volume_id {
  uint32_t index;      /**< Slot. */
  uint32_t generation; /**< Generation. */
} dsw_volume_id;

/** A face: face number `local` of a volume. A face between two volumes has two ids, one from each
 * volume. Functions accept both; reports give the canonical id, from the volume with the lower
 * index. Faces are numbered in the VTK order of the cell type, and in a polyhedron in the order of
 * its face stream. */
typedef struct dsw_face_id {
  uint32_t volume;     /**< Index of the volume. */
  uint32_t generation; /**< Generation of the volume. */
  uint32_t local;      /**< Number in the volume. */
} dsw_face_id;

/** An edge: edge number `local` of a volume. Each volume round the edge gives it an id; the
 * canonical id is from the one with the lowest index. Edges are numbered as they are first met, by
 * a walk over the faces in order, and round each face as seen from outside. */
typedef struct dsw_edge_id {
  uint32_t volume;     /**< Index of the volume. */
  uint32_t generation; /**< Generation of the volume. */
  uint32_t local;      /**< Number in the volume. */
} dsw_edge_id;

/** A particle of a scene. */
typedef struct dsw_particle_id {
  uint32_t index;      /**< Slot. */
  uint32_t generation; /**< Generation. */
} dsw_particle_id;

/** A body of a scene. */
typedef struct dsw_body_id {
  uint32_t index;      /**< Slot. */
  uint32_t generation; /**< Generation. */
} dsw_body_id;

/** A vertex of a body. Its index is its place in arrays of targets and positions. */
typedef struct dsw_body_vertex_id {
  uint32_t index;      /**< Slot. */
  uint32_t generation; /**< Generation. */
} dsw_body_vertex_id;

/** An edge of a body. */
typedef struct dsw_body_edge_id {
  uint32_t index;      /**< Slot. */
  uint32_t generation; /**< Generation. */
} dsw_body_edge_id;

/** A triangle of a body. */
typedef struct dsw_body_face_id {
  uint32_t index;      /**< Slot. */
  uint32_t generation; /**< Generation. */
} dsw_body_face_id;

/** Kind of a cell. */
typedef enum dsw_cell_kind {
  DSW_CELL_NONE = 0,                     /**< No cell. */
  DSW_CELL_VERTEX = 1,                   /**< A dsw_vertex_id. */
  DSW_CELL_EDGE = 2,                     /**< A dsw_edge_id. */
  DSW_CELL_FACE = 3,                     /**< A dsw_face_id. */
  DSW_CELL_VOLUME = 4,                   /**< A dsw_volume_id. */
  DSW_CELL_KIND_FORCE_INT32 = 0x7fffffff /**< No value. */
} dsw_cell_kind;

/** A cell of any kind. The members after `kind` are those of its id; `local` is 0 for vertices and
 * volumes. */
typedef struct dsw_cell {
  dsw_cell_kind kind;  /**< Which id the rest is. */
  uint32_t index;      /**< Of the vertex or volume. */
  uint32_t generation; /**< Of the vertex or volume. */
  uint32_t local;      /**< Number in the volume, or 0. */
} dsw_cell;

#ifdef __cplusplus
}
#endif

#endif
