/** @file ids.h
 * Ids are small values: an index and a generation. {0,0} is null, since generations start at 1. An id stays
 * valid until the thing it names is removed; from then on it answers DSW_STATUS_STALE_ID. Ids do not name
 * their environment or scene: pass the one that gave them. Stands alone.
 *
 * In the plane ids are read by codimension. A volume id names a cell of full dimension, a polygon; a face id what lies between two of
 * them, a side, face number i running from the polygon's vertex i to the next; a vertex id a vertex. There are no edges: what takes an edge
 * id, or DSW_CELL_EDGE, answers DSW_STATUS_UNSUPPORTED, but for topology.h, where sides are split, merged and collapsed as edges are. Words
 * in these headers are to be read alike.
 */
#ifndef DARTSWEEP_IDS_H
#define DARTSWEEP_IDS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A vertex of an environment; index is the point's index at creation. */
typedef struct dsw_vertex_id {
  uint32_t index;      /**< Its slot. */
  uint32_t generation; /**< How many things have had that slot, this one included. */
} dsw_vertex_id;

/** A volume of an environment; index is the cell's index at creation. */
typedef struct dsw_volume_id {
  uint32_t index;      /**< Its slot. */
  uint32_t generation; /**< How many things have had that slot, this one included. */
} dsw_volume_id;

/** A face: face number `local` of a volume. A face between two volumes has two such names; every report
 * gives the canonical one, that of the volume with the lower index. Either is accepted. Face numbers follow
 * the VTK order of the cell type; for polyhedra the order of the face stream. */
typedef struct dsw_face_id {
  uint32_t volume;     /**< Index of the volume. */
  uint32_t generation; /**< Generation of the volume. */
  uint32_t local;      /**< Number in the volume. */
} dsw_face_id;

/** An edge: edge number `local` of a volume, named as faces are. Edge numbers run over the faces in order, each
 * face's boundary in its order seen from outside, counting an edge when it is first met. */
typedef struct dsw_edge_id {
  uint32_t volume;     /**< Index of the volume. */
  uint32_t generation; /**< Generation of the volume. */
  uint32_t local;      /**< Number in the volume. */
} dsw_edge_id;

/** A particle of a scene. */
typedef struct dsw_particle_id {
  uint32_t index;      /**< Its slot. */
  uint32_t generation; /**< How many things have had that slot, this one included. */
} dsw_particle_id;

/** A body of a scene. */
typedef struct dsw_body_id {
  uint32_t index;      /**< Its slot. */
  uint32_t generation; /**< How many things have had that slot, this one included. */
} dsw_body_id;

/** A vertex of a body; index is its place in arrays of targets and positions. */
typedef struct dsw_body_vertex_id {
  uint32_t index;      /**< Its slot. */
  uint32_t generation; /**< How many things have had that slot, this one included. */
} dsw_body_vertex_id;

/** An edge of a body. */
typedef struct dsw_body_edge_id {
  uint32_t index;      /**< Its slot. */
  uint32_t generation; /**< How many things have had that slot, this one included. */
} dsw_body_edge_id;

/** A triangle of a body. */
typedef struct dsw_body_face_id {
  uint32_t index;      /**< Its slot. */
  uint32_t generation; /**< How many things have had that slot, this one included. */
} dsw_body_face_id;

/** Dimension of a cell. */
typedef enum dsw_cell_kind {
  DSW_CELL_NONE = 0,                     /**< No cell. */
  DSW_CELL_VERTEX = 1,                   /**< A dsw_vertex_id. */
  DSW_CELL_EDGE = 2,                     /**< A dsw_edge_id. */
  DSW_CELL_FACE = 3,                     /**< A dsw_face_id. */
  DSW_CELL_VOLUME = 4,                   /**< A dsw_volume_id. */
  DSW_CELL_KIND_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_cell_kind;

/** A cell of any dimension. For vertices and volumes `index` is theirs and `local` is 0; for faces and edges
 * `index` is the volume's. */
typedef struct dsw_cell {
  dsw_cell_kind kind;  /**< Its dimension. */
  uint32_t index;      /**< Of the cell, or of the volume. */
  uint32_t generation; /**< Likewise. */
  uint32_t local;      /**< Number in the volume, or 0. */
} dsw_cell;

#ifdef __cplusplus
}
#endif

#endif
