/** @file environment.h
 * An environment: volumes that partition a bounded part of space.
 *
 * A volume that is no tetrahedron is the star of its centre, the rounded mean of its vertices:
 * tetrahedra from the centre to the triangles of the boundary. So faces may be warped, and volumes
 * need not be convex. A face with more than three vertices has the same triangles for both volumes.
 */
#ifndef DARTSWEEP_ENVIRONMENT_H
#define DARTSWEEP_ENVIRONMENT_H

#include "dartsweep/context.h"
#include "dartsweep/ids.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Opaque. Scenes may share it while it does not change. */
typedef struct dsw_environment dsw_environment;

/** Cell types, with the numbers of VTK. Order of points:
 *  - tetra: 0 1 2 turn counter-clockwise seen from 3;
 *  - hexahedron: 0 1 2 3 counter-clockwise seen from 4 5 6 7, each of these above its counterpart;
 *  - wedge: 0 1 2 clockwise seen from 3 4 5, each of these above its counterpart. That is the order
 *    of VTK up to 9.6. VTK from 9.7 on and Gmsh have 0 2 1 3 5 4;
 *  - pyramid: base 0 1 2 3 counter-clockwise seen from the apex 4;
 *  - polyhedron: a face stream: the number of faces, then for each face the number of its points
 *    and the points, counter-clockwise seen from outside. */
typedef enum dsw_cell_type {
  DSW_CELL_TYPE_NONE = 0,                /**< No type. */
  DSW_CELL_TYPE_TRIANGLE = 5,            /**< 3 vertices, in the plane. */
  DSW_CELL_TYPE_POLYGON = 7,             /**< Any other cell of the plane. */
  DSW_CELL_TYPE_QUAD = 9,                /**< 4 vertices, in the plane. */
  DSW_CELL_TYPE_TETRA = 10,              /**< 4 vertices. */
  DSW_CELL_TYPE_HEXAHEDRON = 12,         /**< 8 vertices. */
  DSW_CELL_TYPE_WEDGE = 13,              /**< 6 vertices. */
  DSW_CELL_TYPE_PYRAMID = 14,            /**< 5 vertices. */
  DSW_CELL_TYPE_POLYHEDRON = 42,         /**< Any other volume. */
  DSW_CELL_TYPE_FORCE_INT32 = 0x7fffffff /**< Unused. */
} dsw_cell_type;

/** Flags of dsw_environment_desc. */
enum {
  /** Retains `points`, without gaps, instead of a copy. The host leaves them unchanged until the
   * environment is destroyed or deformed (deform.h). */
  DSW_ENVIRONMENT_BORROW_POINTS = 0x1,
  /** Mirrors cells that are inside out, such as wedges in the order of VTK 9.7 or of Gmsh, and turns
   * faces of a polyhedron that are turned against most of its other faces. */
  DSW_ENVIRONMENT_REORIENT = 0x2,
  /** Builds the search structure of dsw_environment_locate at creation: 18 bytes a volume, in the
   * plane 14. By default a later locate builds it, after a few that scan all cells. */
  DSW_ENVIRONMENT_LOCATE_TREE = 0x4,
  /** Also proves that the outer boundary does not pass through itself, at ten times the cost. */
  DSW_ENVIRONMENT_CHECK_BOUNDARY = 0x8,
  /** Never builds the search structure, whatever DSW_ENVIRONMENT_LOCATE_TREE says. Snapshots do not
   * keep this flag. */
  DSW_ENVIRONMENT_NO_LOCATE_TREE = 0x10,
  /** Points at exactly one place count as one, and so do points within `merge_distance` of each
   * other, with all that a chain of such points joins. The lowest index stands for all of them; the
   * others count as unused. A cell that loses a corner so is DSW_STATUS_BAD_CELL. @since 2.1 */
  DSW_ENVIRONMENT_MERGE_POINTS = 0x20,
  /** Sews parts that lie on each other: merges points as DSW_ENVIRONMENT_MERGE_POINTS, and splits
   * faces of the boundary where faces of other cells cover them, at points that exist. Cells whose
   * faces are split become polyhedra, in the plane polygons; they keep their indices. Points within
   * `merge_distance` of an edge or face lie on it. Cost: that of a second creation, and O(f log f)
   * expected for f faces of the boundary. @since 2.1 */
  DSW_ENVIRONMENT_CONFORM = 0x40,
  /** Counts faces of the boundary that lie on, or overlap, faces of other cells, in the report: casts
   * stop there. Cost: O(f log f) expected for f faces of the boundary. @since 2.1 */
  DSW_ENVIRONMENT_FIND_TOUCHING = 0x80
};

/** Describes an environment. */
typedef struct dsw_environment_desc {
  uint32_t struct_size; /**< sizeof(dsw_environment_desc). */
  uint32_t dimension;   /**< 3, also given as 0; 2 in the plane. */
  uint32_t flags;       /**< DSW_ENVIRONMENT_... */
  /** Size of the integers in arrays of void, signed: 4 or 8; 0 means 8. */
  uint32_t index_bytes;
  const double *points;      /**< The points. */
  size_t point_count;        /**< 1 .. 2^28-1. Unused points are allowed. */
  size_t point_stride_bytes; /**< As every stride. */
  const uint8_t *cell_types; /**< dsw_cell_type of each; null: uniform_cell_type. */
  size_t volume_count;       /**< At least 1. */
  /** volume_count + 1 integers: cell i has connectivity[offsets[i] .. offsets[i+1]-1]. Null if
   * cells of uniform_cell_type follow each other. */
  const void *offsets;
  /** Indices of points; face streams of polyhedra, unless in `faces`. */
  const void *connectivity;
  size_t connectivity_count; /**< Its integers. */
  const void *faces;         /**< Null, or face streams of polyhedra. */
  size_t faces_count;        /**< Its integers. */
  /** Where the stream of each cell starts in `faces`; read for polyhedra. */
  const void *face_locations;
  /** Null, or region labels (lumen, tissue, ...). */
  const int32_t *regions;
  /** Null, or host tags (friction, material, ...). */
  const uint32_t *tags;
  /** Type of all cells if cell_types is null; hexahedra by default, never polyhedra. */
  uint32_t uniform_cell_type;
  uint32_t reserved; /**< 0. */
  /** Not negative: how far points may be apart that DSW_ENVIRONMENT_MERGE_POINTS or
   * DSW_ENVIRONMENT_CONFORM takes for one; 0: at exactly one place. @since 2.1 */
  double merge_distance;
} dsw_environment_desc;

/** What creation or dsw_environment_check found, also on failure. */
typedef struct dsw_build_report {
  uint32_t struct_size;    /**< sizeof(dsw_build_report). */
  dsw_status status;       /**< As returned. */
  uint32_t offender_count; /**< Entries of offenders. */
  /** The first wrong cells, by index; for NON_FINITE points. */
  uint32_t offenders[8];
  uint32_t reoriented_count;    /**< Cells that were mirrored, or of which faces were turned. */
  uint32_t part_count;          /**< Parts connected through faces. */
  uint32_t unused_point_count;  /**< Points that no cell names. */
  uint32_t boundary_face_count; /**< Faces with one volume. */
  /** Convex volumes with flat faces, which casts cross fastest. */
  uint32_t convex_volume_count;
  /** Faces of polyhedra that were turned against the others of their cell. @since 2.1 */
  uint32_t reoriented_face_count;
  uint32_t merged_point_count; /**< Points that count as another one. @since 2.1 */
  uint32_t changed_count;      /**< Cells that DSW_ENVIRONMENT_CONFORM changed. @since 2.1 */
  uint32_t changed[8];         /**< The first of them, by index; then zeros. @since 2.1 */
  /** Faces of the boundary that lie on, or overlap, faces of other cells
   * (DSW_ENVIRONMENT_FIND_TOUCHING, dsw_environment_check). @since 2.1 */
  uint32_t touching_face_count;
  dsw_face_id touching_face; /**< The first of them, or null. @since 2.1 */
  dsw_face_id touched_face;  /**< A face that it lies on, or null. @since 2.1 */
} dsw_build_report;

/** Numbers about an environment. */
typedef struct dsw_environment_info {
  uint32_t struct_size;         /**< sizeof(dsw_environment_info). */
  uint32_t dimension;           /**< 3, or 2 in the plane. */
  uint32_t vertex_count;        /**< Vertices, also unused points. */
  uint32_t volume_count;        /**< Volumes. */
  uint32_t face_count;          /**< Faces; those between two volumes count once. */
  uint32_t boundary_face_count; /**< Faces with one volume. */
  uint32_t part_count;          /**< Parts connected through faces. */
  uint32_t scene_count;         /**< Scenes that use the environment. */
  uint64_t memory_bytes;        /**< Its memory, with borrowed points. */
  /** Lowest corner of the box of all points that volumes have used, before deformations. */
  double lower[3];
  double upper[3]; /**< Highest corner. */
  /** All volume indices are below it, also those of removed volumes. */
  uint32_t volume_index_count;
  uint32_t vertex_index_count; /**< Likewise for vertices. */
} dsw_environment_info;

/** Writes the defaults: 3 dimensions, hexahedra, 8-byte indices. @since 2.0 */
DSW_API void dsw_environment_desc_init(dsw_environment_desc *desc, size_t size);

/** Creates an environment and proves every cell valid (bindings/docs/exactness.md). All but the
 * outer boundary is passable.
 * @param report may be null; filled unless an argument is wrong.
 * @return DSW_STATUS_TOO_LARGE, INDEX_OUT_OF_RANGE, BAD_CELL_TYPE, BAD_CELL, INVERTED_CELL,
 * INVALID_CELL, DUPLICATE_CELL, SHARED_FACE, BOUNDARY_CROSSES; NOT_CONFORMING: `offenders` are two
 * cells whose faces overlap where DSW_ENVIRONMENT_CONFORM finds no points to split both at.
 * @note Cost: O(n) expected. Thread: any. Source: [JCD10] 3.1, 3.2. @since 2.0 */
DSW_API dsw_status dsw_environment_create(dsw_context *context, const dsw_environment_desc *desc,
                                          dsw_environment **environment, dsw_build_report *report);

/** Destroys an environment.
 * @return DSW_STATUS_IN_USE: scenes use it.
 * @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_destroy(dsw_environment *environment);

/** Gives numbers about an environment.
 * @note Cost: O(1), or O(n) once the topology has changed. @since 2.0 */
DSW_API dsw_status dsw_environment_get_info(const dsw_environment *environment,
                                            dsw_environment_info *info);

/** Proves that the cells are a partition: they are linked and valid, and the outer boundary does
 * not pass through itself. It may touch itself: the report counts the faces that do.
 * @param report may be null.
 * @return DSW_STATUS_INVALID_CELL, DSW_STATUS_BOUNDARY_CROSSES; DSW_STATUS_INTERNAL: wrong links.
 * @note Cost: O(n log n) expected. @since 2.0 */
DSW_API dsw_status dsw_environment_check(const dsw_environment *environment,
                                         dsw_build_report *report);

/** Gives the id of volume `index`.
 * @return DSW_STATUS_NOT_FOUND: removed.
 * @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_volume_id(const dsw_environment *environment, uint32_t index,
                                                 dsw_volume_id *volume);

/** Gives the id of vertex `index`.
 * @return DSW_STATUS_NOT_FOUND: removed.
 * @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_vertex_id(const dsw_environment *environment, uint32_t index,
                                                 dsw_vertex_id *vertex);

/** Gives the position of a vertex. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_vertex_position(const dsw_environment *environment,
                                                       dsw_vertex_id vertex, double *xyz);

/** Gives type, `vertices`, `edges` and `faces` of a volume; each may be null.
 * @note Cost: O(vertices of the volume). @since 2.0 */
DSW_API dsw_status dsw_environment_get_volume_counts(const dsw_environment *environment,
                                                     dsw_volume_id volume, dsw_cell_type *type,
                                                     uint32_t *vertices, uint32_t *edges,
                                                     uint32_t *faces);

/** Gives the canonical id of face `local` of a volume. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_face_id(const dsw_environment *environment,
                                               dsw_volume_id volume, uint32_t local,
                                               dsw_face_id *face);

/** Gives the canonical id of edge `local` of a volume.
 * @note Cost: O(volumes round the edge). @since 2.0 */
DSW_API dsw_status dsw_environment_get_edge_id(const dsw_environment *environment,
                                               dsw_volume_id volume, uint32_t local,
                                               dsw_edge_id *edge);

/** Copies the vertices of a cell: of a face as seen from outside of the volume in its id, of a
 * volume in the order of its type, of a polyhedron in order of first use.
 * @note Cost: O(vertices of the volume). @since 2.0 */
DSW_API dsw_status dsw_environment_copy_vertices(const dsw_environment *environment, dsw_cell cell,
                                                 dsw_vertex_id *vertices, size_t capacity,
                                                 size_t *count);

/** Gives the two volumes of a face.
 * @param near_side the volume in the id; may be null.
 * @param far_side null at the outer boundary; may be null.
 * @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_face_volumes(const dsw_environment *environment,
                                                    dsw_face_id face, dsw_volume_id *near_side,
                                                    dsw_volume_id *far_side);

/** Gives what lies behind face `local` of a volume.
 * @param neighbour null at the outer boundary; may be null.
 * @param impassable 0 or 1: whether the face is; may be null.
 * @return DSW_STATUS_OUT_OF_RANGE.
 * @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_neighbour(const dsw_environment *environment,
                                                 dsw_volume_id volume, uint32_t local,
                                                 dsw_volume_id *neighbour, int *impassable);

/** Gives the centre of a volume, the rounded mean of its vertices. It lies strictly inside, unless
 * a tetrahedron is thinner than rounding.
 * @note Cost: O(vertices of the volume). @since 2.0 */
DSW_API dsw_status dsw_environment_get_centre(const dsw_environment *environment,
                                              dsw_volume_id volume, double *xyz);

/** Finds faces by vertices in any order, for example boundary groups of a mesh file. Face i has the
 * vertices `indices`[offsets[i] .. offsets[i+1]-1].
 * @param offsets count + 1 ascending values. @param faces canonical ids, null where there is
 * none.
 * @param missing how many are null; may be null. @return DSW_STATUS_WRONG_SIZE: offsets descend.
 * @note Cost: O(n + indices) expected. @since 2.0 */
DSW_API dsw_status dsw_environment_find_faces(const dsw_environment *environment, size_t count,
                                              const size_t *offsets, const uint32_t *indices,
                                              dsw_face_id *faces, size_t *missing);

/** Finds edges by their vertices. Edge i joins vertices `indices`[2 i] and [2 i + 1].
 * @param edges canonical ids, null where there is none.
 * @param missing how many are null; may be null.
 * @note Cost: O(n + count) expected. @since 2.0 */
DSW_API dsw_status dsw_environment_find_edges(const dsw_environment *environment, size_t count,
                                              const uint32_t *indices, dsw_edge_id *edges,
                                              size_t *missing);

/** Gives the `region` label of a volume, 0 by default. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_region(const dsw_environment *environment,
                                              dsw_volume_id volume, int32_t *region);

/** Gives the host `tag` of a volume, 0 by default. @note Cost: O(1). @since 2.0 */
DSW_API dsw_status dsw_environment_get_tag(const dsw_environment *environment, dsw_volume_id volume,
                                           uint32_t *tag);

/** Sets the host `tag` of a volume, also while scenes use it. No result depends on tags.
 * @note Cost: O(1) amortised; the first tag takes 4 bytes a volume. @since 2.0 */
DSW_API dsw_status dsw_environment_set_tag(dsw_environment *environment, dsw_volume_id volume,
                                           uint32_t tag);

#ifdef __cplusplus
}
#endif

#endif
