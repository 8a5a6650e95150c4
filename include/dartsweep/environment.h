/** @file environment.h An environment: volumes that partition a bounded part of space. A volume
 * that is no tetrahedron is the star of its centre, the rounded mean of its vertices: tetrahedra
 * from there to the triangles of the boundary. So faces may be warped, and volumes need not be
 * convex. Both volumes of a face have the same triangles. */
#ifndef DARTSWEEP_ENVIRONMENT_H
#define DARTSWEEP_ENVIRONMENT_H

#include "dartsweep/context.h"
#include "dartsweep/ids.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Opaque. Scenes may share it unchanged. */
typedef struct dsw_environment dsw_environment;

/** Cell types, with the numbers of VTK and its order of points up to 9.6; later wedges, and those
 * of Gmsh, are others (bindings/docs/meshes.md). A polyhedron is a face stream: the number of
 * faces, then for each face the number of its points and the points, counter-clockwise seen from
 * outside. */
typedef enum dsw_cell_type {
  DSW_CELL_TYPE_NONE = 0,        /**< No type. */
  DSW_CELL_TYPE_TRIANGLE = 5,    /**< 3 vertices, in the plane. */
  DSW_CELL_TYPE_POLYGON = 7,     /**< Any other cell of the plane. */
  DSW_CELL_TYPE_QUAD = 9,        /**< 4 vertices, in the plane. */
  DSW_CELL_TYPE_TETRA = 10,      /**< 4 vertices. */
  DSW_CELL_TYPE_HEXAHEDRON = 12, /**< 8 vertices. */
  DSW_CELL_TYPE_WEDGE = 13,      /**< 6 vertices. */
  DSW_CELL_TYPE_PYRAMID = 14,    /**< 5 vertices. */
  DSW_CELL_TYPE_POLYHEDRON = 42, /**< Any other volume. */
  DSW_CELL_TYPE_FORCE_INT32 = 0x7fffffff
} dsw_cell_type;

/** Flags of dsw_environment_desc. */
enum {
  /** Retains `points`, without gaps, instead of a copy. The host leaves them unchanged until the
   * environment is destroyed or deformed (deform.h). */
  DSW_ENVIRONMENT_BORROW_POINTS = 0x1,
  /** Mirrors cells that are inside out, and turns faces of a polyhedron that are turned against
   * most of its others. */
  DSW_ENVIRONMENT_REORIENT = 0x2,
  /** Builds the search structure of dsw_environment_locate at creation, else a later locate does:
   * 18 bytes a volume, in the plane 14. */
  DSW_ENVIRONMENT_LOCATE_TREE = 0x4,
  /** Also proves that the boundary does not pass through itself, at ten times the cost. */
  DSW_ENVIRONMENT_CHECK_BOUNDARY = 0x8,
  /** Never builds the search structure. Snapshots do not keep this flag. */
  DSW_ENVIRONMENT_NO_LOCATE_TREE = 0x10,
  /** Points at exactly one place, or within `merge_distance` of each other, also through a chain of
   * such points, count as the one with the lowest index; the others count as unused. A cell that
   * loses a corner is DSW_STATUS_BAD_CELL. @since 2.1 */
  DSW_ENVIRONMENT_MERGE_POINTS = 0x20,
  /** Sews parts that lie on each other: merges points as DSW_ENVIRONMENT_MERGE_POINTS, and splits
   * faces of the boundary where faces of other cells cover them, at points that exist. Cells whose
   * faces are split become polyhedra, in the plane polygons; they keep their indices. Points within
   * `merge_distance` of an edge or face lie on it. Cost: that of a second creation, and O(f log f)
   * expected for f faces of the boundary. @since 2.1 */
  DSW_ENVIRONMENT_CONFORM = 0x40,
  /** Counts in the report faces of the boundary that lie on, or overlap, faces of other cells:
   * casts stop there. Cost: O(f log f) expected for f boundary faces. @since 2.1 */
  DSW_ENVIRONMENT_FIND_TOUCHING = 0x80,
  /** Splits cells whose mean does not see all of their faces into valid parts: between points, or
   * round new points inside (bindings/docs/exactness.md). The first part keeps the index of its
   * cell; other parts and new points come last. Cells with repeated points lose faces that
   * collapse. INVALID_CELL names a cell that can't be split, and why. @since 2.1 */
  DSW_ENVIRONMENT_SPLIT = 0x100
};

/** Describes an environment. */
typedef struct dsw_environment_desc {
  uint32_t struct_size;
  uint32_t dimension; /**< 3, also given as 0; 2 in the plane. */
  uint32_t flags;
  /** Size of integers in arrays of void, signed: 4 or 8; 0 means 8. */
  uint32_t index_bytes;
  const double *points; /**< The points. */
  size_t point_count;   /**< 1 .. 2^28-1. Unused points are allowed. */
  size_t point_stride_bytes;
  const uint8_t *cell_types; /**< dsw_cell_type of each; null: uniform_cell_type. */
  size_t volume_count;       /**< At least 1. */
  /** volume_count + 1 integers: cell i has connectivity[offsets[i] .. offsets[i+1]-1]. Null if
   * cells of uniform_cell_type follow each other. */
  const void *offsets;
  /** Points; face streams of polyhedra, unless in `faces`. */
  const void *connectivity;
  size_t connectivity_count;
  const void *faces; /**< Null, or face streams of polyhedra. */
  size_t faces_count;
  /** Where the stream of each cell starts in `faces`; read for polyhedra. */
  const void *face_locations;
  /** Null, or region labels (lumen, tissue, ...). */
  const int32_t *regions;
  /** Null, or host tags (friction, material, ...). */
  const uint32_t *tags;
  /** Type of all cells if cell_types is null; default hexahedra, never polyhedra. */
  uint32_t uniform_cell_type;
  uint32_t reserved;
  /** At least 0: how far points may be apart that DSW_ENVIRONMENT_MERGE_POINTS or
   * DSW_ENVIRONMENT_CONFORM takes for one. @since 2.1 */
  double merge_distance;
} dsw_environment_desc;

/** What creation or dsw_environment_check found, also on failure. */
typedef struct dsw_build_report {
  uint32_t struct_size;
  dsw_status status;       /**< What the call returned. */
  uint32_t offender_count; /**< Entries of offenders. */
  /** The first wrong cells (NON_FINITE: points), by index. */
  uint32_t offenders[8];
  uint32_t reoriented_count;    /**< Cells that were mirrored or got faces turned. */
  uint32_t part_count;          /**< Parts connected through faces. */
  uint32_t unused_point_count;  /**< Points that no cell names. */
  uint32_t boundary_face_count; /**< Faces with one volume. */
  /** Convex volumes with flat faces, the fastest. */
  uint32_t convex_volume_count;
  /** Faces of polyhedra that were turned. @since 2.1 */
  uint32_t reoriented_face_count;
  uint32_t merged_point_count; /**< Points that count as another one. @since 2.1 */
  uint32_t changed_count;      /**< Cells that DSW_ENVIRONMENT_CONFORM changed. @since 2.1 */
  uint32_t changed[8];         /**< The first of them, by index; then zeros. @since 2.1 */
  /** Boundary faces that lie on, or overlap, faces of other cells. @since 2.1 */
  uint32_t touching_face_count;
  dsw_face_id touching_face;  /**< The first of them, or null. @since 2.1 */
  dsw_face_id touched_face;   /**< A face that it lies on, or null. @since 2.1 */
  uint32_t split_count;       /**< Cells that DSW_ENVIRONMENT_SPLIT has split. @since 2.1 */
  uint32_t added_point_count; /**< New points in them. @since 2.1 */
} dsw_build_report;

/** Numbers about an environment. `lower` and `upper` bound all points of volumes, before
 * deformations; all indices are below `volume_index_count` and `vertex_index_count`. */
typedef struct dsw_environment_info {
  uint32_t struct_size;
  uint32_t dimension;    /**< 3, or 2 in the plane. */
  uint32_t vertex_count; /**< Vertices, also unused points. */
  uint32_t volume_count;
  uint32_t face_count; /**< Faces, each once. */
  uint32_t boundary_face_count;
  uint32_t part_count;
  uint32_t scene_count;
  uint64_t memory_bytes; /**< With borrowed points. */
  double lower[3];
  double upper[3];
  uint32_t volume_index_count;
  uint32_t vertex_index_count;
} dsw_environment_info;

/** Writes the defaults: 3 dimensions, hexahedra, 8-byte indices. */
DSW_API void dsw_environment_desc_init(dsw_environment_desc *desc, size_t size);

/** Creates an environment and proves every cell valid (bindings/docs/exactness.md). Only the outer
 * boundary is impassable.
 * @param report filled unless an argument is wrong.
 * @return DSW_STATUS_TOO_LARGE, INDEX_OUT_OF_RANGE, BAD_CELL_TYPE, BAD_CELL, INVERTED_CELL,
 * INVALID_CELL, DUPLICATE_CELL, SHARED_FACE, BOUNDARY_CROSSES; NOT_CONFORMING: `offenders` are two
 * cells whose faces overlap where DSW_ENVIRONMENT_CONFORM finds no points.
 * @note Cost: O(n) expected. Batch. Thread: any. Source: [JCD10] 3.1, 3.2. */
DSW_API dsw_status dsw_environment_create(dsw_context *context, const dsw_environment_desc *desc,
                                          dsw_environment **environment, dsw_build_report *report);

/** Destroys an environment.
 * @return DSW_STATUS_IN_USE: scenes use it. */
DSW_API dsw_status dsw_environment_destroy(dsw_environment *environment);

/** Gives numbers about an environment. @note Cost: O(1), or O(n) once the topology has changed. */
DSW_API dsw_status dsw_environment_get_info(const dsw_environment *environment,
                                            dsw_environment_info *info);

/** Proves that the cells are a partition: linked and valid, with an outer boundary that does not
 * pass through itself. The report counts its faces that touch.
 * @return DSW_STATUS_INVALID_CELL, BOUNDARY_CROSSES; INTERNAL: wrong links.
 * @note Cost: O(n log n) expected. */
DSW_API dsw_status dsw_environment_check(const dsw_environment *environment,
                                         dsw_build_report *report);

/** Gives the id of volume `index`.
 * @return DSW_STATUS_NOT_FOUND: removed. */
DSW_API dsw_status dsw_environment_get_volume_id(const dsw_environment *environment, uint32_t index,
                                                 dsw_volume_id *volume);

/** Gives the id of vertex `index`.
 * @return DSW_STATUS_NOT_FOUND: removed. */
DSW_API dsw_status dsw_environment_get_vertex_id(const dsw_environment *environment, uint32_t index,
                                                 dsw_vertex_id *vertex);

/** Gives the position of a vertex. */
DSW_API dsw_status dsw_environment_get_vertex_position(const dsw_environment *environment,
                                                       dsw_vertex_id vertex, double *xyz);

/** Gives type, `vertices`, `edges` and `faces` of a volume; each may be null.
 * @note Cost: O(vertices). */
DSW_API dsw_status dsw_environment_get_volume_counts(const dsw_environment *environment,
                                                     dsw_volume_id volume, dsw_cell_type *type,
                                                     uint32_t *vertices, uint32_t *edges,
                                                     uint32_t *faces);

/** Gives the canonical id of face `local` of a volume. */
DSW_API dsw_status dsw_environment_get_face_id(const dsw_environment *environment,
                                               dsw_volume_id volume, uint32_t local,
                                               dsw_face_id *face);

/** Gives the canonical id of edge `local` of a volume.
 * @note Cost: O(volumes round the edge). */
DSW_API dsw_status dsw_environment_get_edge_id(const dsw_environment *environment,
                                               dsw_volume_id volume, uint32_t local,
                                               dsw_edge_id *edge);

/** Copies the vertices of a cell: of a face seen from outside of its id's volume, of a volume in
 * the order of its type, of a polyhedron in order of first use.
 * @note Cost: O(vertices of the volume). */
DSW_API dsw_status dsw_environment_copy_vertices(const dsw_environment *environment, dsw_cell cell,
                                                 dsw_vertex_id *vertices, size_t capacity,
                                                 size_t *count);

/** Gives the two volumes of a face; each may be null.
 * @param near_side that in the id.
 * @param far_side null at the outer boundary. */
DSW_API dsw_status dsw_environment_get_face_volumes(const dsw_environment *environment,
                                                    dsw_face_id face, dsw_volume_id *near_side,
                                                    dsw_volume_id *far_side);

/** Gives what lies behind face `local` of a volume; each may be null.
 * @param neighbour null at the outer boundary.
 * @param impassable 0 or 1: whether the face is. */
DSW_API dsw_status dsw_environment_get_neighbour(const dsw_environment *environment,
                                                 dsw_volume_id volume, uint32_t local,
                                                 dsw_volume_id *neighbour, int *impassable);

/** Gives the centre of a volume: strictly inside, unless a tetrahedron is thinner than rounding.
 * @note Cost: O(vertices). */
DSW_API dsw_status dsw_environment_get_centre(const dsw_environment *environment,
                                              dsw_volume_id volume, double *xyz);

/** Finds faces by vertices in any order. Face i has `indices`[offsets[i] .. offsets[i+1]-1].
 * @param offsets count + 1 ascending values.
 * @param faces canonical, or null.
 * @param missing how many are null.
 * @return DSW_STATUS_WRONG_SIZE: offsets descend.
 * @note Cost: O(n + indices) expected. */
DSW_API dsw_status dsw_environment_find_faces(const dsw_environment *environment, size_t count,
                                              const size_t *offsets, const uint32_t *indices,
                                              dsw_face_id *faces, size_t *missing);

/** Finds edges by their vertices `indices`[2 i] and [2 i + 1].
 * @param edges canonical, or null.
 * @param missing how many are null.
 * @note Cost: O(n + count) expected. */
DSW_API dsw_status dsw_environment_find_edges(const dsw_environment *environment, size_t count,
                                              const uint32_t *indices, dsw_edge_id *edges,
                                              size_t *missing);

/** Gives the `region` label of a volume, 0 by default. */
DSW_API dsw_status dsw_environment_get_region(const dsw_environment *environment,
                                              dsw_volume_id volume, int32_t *region);

/** Gives the host `tag` of a volume, 0 by default. */
DSW_API dsw_status dsw_environment_get_tag(const dsw_environment *environment, dsw_volume_id volume,
                                           uint32_t *tag);

/** Gives the `index` of the cell that a volume is, or is a part of. Changes keep it with labels.
 * @return DSW_STATUS_NOT_FOUND: cells were split, and the volume was added later. @since 2.1 */
DSW_API dsw_status dsw_environment_get_parent(const dsw_environment *environment,
                                              dsw_volume_id volume, uint32_t *index);

/** Sets the host `tag` of a volume, also while scenes use it; no result depends on it.
 * @note The first tag takes 4 bytes a volume. */
DSW_API dsw_status dsw_environment_set_tag(dsw_environment *environment, dsw_volume_id volume,
                                           uint32_t tag);

#ifdef __cplusplus
}
#endif

#endif
