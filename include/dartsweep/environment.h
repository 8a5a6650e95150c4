/** @file environment.h
 * An environment: a partition of a bounded part of space into volumes, made from the arrays every mesh library
 * has. Every volume is exactly a union of tetrahedra: a tetrahedron is itself, any other volume is the star
 * of its centre (the mean of its vertices, rounded) over its boundary triangles, so faces may be warped and
 * volumes need not be convex. A face with more than three vertices is cut into triangles once, at creation, the
 * same way for both of its volumes.
 *
 * An environment in the plane (dimension 2) is a partition into polygons: triangles, or stars of their centre over their sides. ids.h
 * says how ids are read there. All positions that a function takes or writes have as many doubles as the dimension, so strides are
 * 8 * dimension bytes by default; of three doubles in a struct the third is 0 in the plane. What serves environments and scenes in space
 * only answers DSW_STATUS_UNSUPPORTED: coarsen.h, remesh.h, detach.h, contact_check.h, wires, and what names edges but for topology.h.
 */
#ifndef DARTSWEEP_ENVIRONMENT_H
#define DARTSWEEP_ENVIRONMENT_H

#include "dartsweep/context.h"
#include "dartsweep/ids.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Opaque. Owned by the caller from creation to dsw_environment_destroy. One environment may be used, unchanged,
 * by many scenes. */
typedef struct dsw_environment dsw_environment;

/** Cell types, numbered as in VTK. Points are ordered as in VTK's manual:
 *  - tetra 0 1 2 3: seen from 3, 0 1 2 turn counter-clockwise;
 *  - hexahedron: 0 1 2 3 counter-clockwise seen from 4 5 6 7, each of these above its counterpart;
 *  - wedge: 0 1 2 counter-clockwise seen from outside, 3 4 5 opposite them;
 *  - pyramid: base 0 1 2 3 counter-clockwise seen from the apex 4;
 *  - polyhedron: a face stream (count of faces, then for each face count of points and the points,
 *    counter-clockwise seen from outside).
 * In the plane triangle, quad and polygon, their points counter-clockwise. */
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
  DSW_CELL_TYPE_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_cell_type;

/** Flags of dsw_environment_desc. */
enum {
  /** points is retained instead of copied: it must stay, unchanged, until the environment is destroyed or deformed (deform.h);
   * point_stride_bytes must be 0 or 8 * dimension. */
  DSW_ENVIRONMENT_BORROW_POINTS = 0x1,
  /** Volumes that are turned inside out are mirrored instead of refused (meshes differ in their wedges). */
  DSW_ENVIRONMENT_REORIENT = 0x2,
  /** Builds the search structure for locating points without a hint at creation. By default the
   * structure is built when such calls have taken about as long as building it. The structure costs
   * 18 bytes a volume, in the plane 14 bytes a polygon. */
  DSW_ENVIRONMENT_LOCATE_GRID = 0x4,
  /** Also proves that the outer boundary does not pass through itself, so that the cells are a partition:
   * about ten times the cost of the rest. Also available later as dsw_environment_check. */
  DSW_ENVIRONMENT_CHECK_BOUNDARY = 0x8,
  /** Never builds the search structure for locating points without a hint. Each such call then
   * looks at all cells. The flag wins over DSW_ENVIRONMENT_LOCATE_GRID. A snapshot does not keep
   * the flag. @since 2.0 */
  DSW_ENVIRONMENT_NO_LOCATE_GRID = 0x10
};

/** Describes an environment. All arrays are read in place, once; nothing is retained unless flags say so. */
typedef struct dsw_environment_desc {
  uint32_t struct_size; /**< sizeof(dsw_environment_desc). */
  uint32_t dimension;   /**< 3, or 0 which means 3; 2: in the plane. */
  uint32_t flags;       /**< DSW_ENVIRONMENT_... */
  uint32_t index_bytes; /**< Size of the signed integers in offsets, connectivity, faces and face_locations: 4 or 8;
                             0 means 8, as in VTK. */
  const double *points; /**< As many doubles a point as there are dimensions, finite. */
  size_t point_count;   /**< 1 .. 2^28-1. Unused points are allowed. */
  size_t point_stride_bytes; /**< Distance of two points; 0 means 8 * dimension. */
  const uint8_t *cell_types; /**< dsw_cell_type of each cell; null: all are uniform_cell_type. */
  size_t cell_count;         /**< At least 1. */
  const void *offsets; /**< cell_count + 1 integers: cell i's points are connectivity[offsets[i] .. offsets[i+1]-1].
                            Null is allowed with uniform_cell_type: cells follow each other. */
  const void *connectivity;   /**< Point indices; for a polyhedron its face stream, unless faces is set. */
  size_t connectivity_count;  /**< Number of integers in connectivity. */
  const void *faces;          /**< Null, or the face streams of the polyhedra. */
  size_t faces_count;         /**< Number of integers in faces. */
  const void *face_locations; /**< With faces: cell_count integers, where each polyhedron's stream starts (its
                                   count of faces); ignored for other cells. */
  const int32_t *regions;     /**< Null, or a label for each cell (lumen, tissue, ...), copied. */
  const uint32_t *tags;       /**< Null, or a host tag for each cell (friction, material, ...), copied. */
  uint32_t uniform_cell_type; /**< dsw_cell_type of all cells when cell_types is null; not polyhedron. */
  uint32_t reserved;          /**< 0. */
} dsw_environment_desc;

/** What creation found. Filled on success and on failure. */
typedef struct dsw_build_report {
  uint32_t struct_size;         /**< Set by the caller: sizeof(dsw_build_report). */
  dsw_status status;            /**< As returned. */
  uint32_t offender_count;      /**< How many of offenders are set. */
  uint32_t offenders[8];        /**< First offending cells, by index, ascending (points, for a non-finite point). */
  uint32_t reoriented_count;    /**< Cells that DSW_ENVIRONMENT_REORIENT mirrored. */
  uint32_t part_count;          /**< Parts connected through faces. */
  uint32_t unused_point_count;  /**< Points that no cell names. */
  uint32_t boundary_face_count; /**< Faces with one volume. */
  uint32_t convex_cell_count;   /**< Volumes that are exactly convex with exactly flat faces: these walk fastest. */
} dsw_build_report;

/** Numbers about an environment. */
typedef struct dsw_environment_info {
  uint32_t struct_size;         /**< Set by the caller: sizeof(dsw_environment_info). */
  uint32_t dimension;           /**< 3, or 2 in the plane. */
  uint32_t vertex_count;        /**< Unused points included. */
  uint32_t volume_count;        /**< Volumes that there are. */
  uint32_t face_count;          /**< A face between two volumes counts once. */
  uint32_t boundary_face_count; /**< Faces with one volume. */
  uint32_t part_count;          /**< Parts connected through faces. */
  uint32_t scene_count;         /**< Scenes that use it now. */
  uint64_t memory_bytes;        /**< All memory it holds; borrowed points included. */
  /** Box around the points that volumes use, or have used; as they were before they moved (deform.h). */
  double lower[3];
  double upper[3];             /**< Its other corner. */
  uint32_t volume_index_count; /**< Indices of volumes are below: more than volume_count where some were removed. */
  uint32_t vertex_index_count; /**< Likewise of vertices. */
} dsw_environment_info;

/** Writes the defaults (3-dimensional, hexahedra, 8-byte indices) into at most `size` bytes and sets struct_size.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_environment_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_environment_desc_init(dsw_environment_desc *desc, size_t size);

/** Creates an environment and proves that every cell is valid: all tetrahedra of its star have positive volume
 * and a generic direction from its centre meets its boundary once. Everything is passable but the outer boundary.
 * @param context [in] null: defaults. Must outlive the environment.
 * @param desc [in] see dsw_environment_desc.
 * @param environment [out] owned by the caller.
 * @param report [in,out] may be null; filled on success and on every failure after the arguments were found sound.
 * @return DSW_STATUS_NULL_ARGUMENT, BAD_STRUCT_SIZE, UNSUPPORTED, WRONG_SIZE, OUT_OF_RANGE, NON_FINITE, TOO_LARGE,
 * INDEX_OUT_OF_RANGE, BAD_CELL_TYPE, BAD_CELL, INVERTED_CELL, INVALID_CELL, DUPLICATE_CELL, SHARED_FACE,
 * BOUNDARY_CROSSES (on request), OUT_OF_MEMORY. The message and the report name the first offending cells.
 * @note Expected time linear in cells and points. Thread: any. Certain: signs are exact for every finite double.
 * Source: [JCD10] 3.1, 3.2. @since 1.0 */
DSW_API dsw_status dsw_environment_create(dsw_context *context, const dsw_environment_desc *desc,
                                          dsw_environment **environment, dsw_build_report *report);

/** Destroys an environment.
 * @param environment [in] null is allowed.
 * @return DSW_STATUS_IN_USE, and nothing happens, while scenes use it. @note Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_environment_destroy(dsw_environment *environment);

/** Fills `info`.
 * @param environment [in] @param info [in,out] its struct_size set.
 * @return DSW_STATUS_BAD_STRUCT_SIZE.
 * @note O(1); once the topology has changed (topology.h) O(n), to count parts. Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_info(const dsw_environment *environment, dsw_environment_info *info);

/** Proves everything again: links, every cell's validity, and that the outer boundary does not pass through
 * itself (touching itself is allowed), so that the cells are a partition of space.
 * @param environment [in] @param report [in,out] may be null; as for creation.
 * @return DSW_STATUS_INVALID_CELL, DSW_STATUS_BOUNDARY_CROSSES, DSW_STATUS_INTERNAL (links), DSW_STATUS_OUT_OF_MEMORY.
 * @note O(n log n) expected. Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_check(const dsw_environment *environment, dsw_build_report *report);

/** Id of the volume with an index: at first that made from cell `index`.
 * @param environment, index [in] @param volume [out]
 * @return DSW_STATUS_OUT_OF_RANGE from volume_index_count on, DSW_STATUS_NOT_FOUND where the volume has been removed.
 * @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_volume(const dsw_environment *environment, uint32_t index,
                                              dsw_volume_id *volume);

/** Id of the vertex with an index: at first that made from point `index`.
 * @param environment, index [in] @param vertex [out]
 * @return DSW_STATUS_OUT_OF_RANGE from vertex_index_count on, DSW_STATUS_NOT_FOUND where the vertex has been removed.
 * @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_vertex(const dsw_environment *environment, uint32_t index,
                                              dsw_vertex_id *vertex);

/** Position of a vertex.
 * @param environment, vertex [in] @param xyz [out] as many doubles as there are dimensions.
 * @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_position(const dsw_environment *environment, dsw_vertex_id vertex, double *xyz);

/** Type of a volume and how many vertices, edges (in the plane 0) and faces it has; each out-argument may be null.
 * @param environment, volume [in] @param type, vertices, edges, faces [out]
 * @return DSW_STATUS_STALE_ID.
 * @note O(vertices of the volume). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_volume_counts(const dsw_environment *environment, dsw_volume_id volume,
                                                     dsw_cell_type *type, uint32_t *vertices, uint32_t *edges,
                                                     uint32_t *faces);

/** Canonical id of face `local` of a volume.
 * @param environment, volume, local [in] @param face [out]
 * @return DSW_STATUS_STALE_ID, OUT_OF_RANGE (local). @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_volume_face(const dsw_environment *environment, dsw_volume_id volume,
                                                   uint32_t local, dsw_face_id *face);

/** Canonical id of edge `local` of a volume.
 * @param environment, volume, local [in] @param edge [out]
 * @return DSW_STATUS_STALE_ID, OUT_OF_RANGE (local). @note O(volumes round the edge). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_volume_edge(const dsw_environment *environment, dsw_volume_id volume,
                                                   uint32_t local, dsw_edge_id *edge);

/** Vertices of a cell: of a face in order, seen from outside of the volume its id names; of an edge both; of a
 * volume in the order of its type (polyhedra: by first use in the stream).
 * @param environment [in] @param cell [in] any kind. @param vertices [out] null if capacity is 0.
 * @param capacity [in] its entries. @param count [out] how many there are.
 * @return DSW_STATUS_BUFFER_TOO_SMALL if capacity is smaller than *count, unless capacity is 0 (a query).
 * @note O(vertices of the volume). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_copy_vertices(const dsw_environment *environment, dsw_cell cell,
                                                 dsw_vertex_id *vertices, size_t capacity, size_t *count);

/** The two volumes of a face: `near_side` is the one its id names, `far_side` is null at the outer boundary. Each may
 * be null.
 * @param environment, face [in] @param near_side, far_side [out]
 * @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_face_volumes(const dsw_environment *environment, dsw_face_id face,
                                                    dsw_volume_id *near_side, dsw_volume_id *far_side);

/** What lies behind face `local` of a volume.
 * @param environment, volume, local [in]
 * @param neighbour [out] the volume there, null id at the outer boundary; may be null.
 * @param impassable [out] 0 or 1: the face counts as impassable (its own mark, that of a volume on either side, an
 * invalid volume there, or the outer boundary); may be null.
 * @return DSW_STATUS_STALE_ID, OUT_OF_RANGE (local).
 * @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_neighbour(const dsw_environment *environment, dsw_volume_id volume,
                                                 uint32_t local, dsw_volume_id *neighbour, int *impassable);

/** A point strictly inside a volume: the mean of its vertices, rounded, which is the apex of its star. (That of a
 * tetrahedron thinner than the rounding of its coordinates can come to lie outside.)
 * @param environment, volume [in] @param xyz [out] as many doubles as there are dimensions.
 * @return DSW_STATUS_STALE_ID. @note O(vertices of the volume). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_centre(const dsw_environment *environment, dsw_volume_id volume, double *xyz);

/** Finds faces by their vertices, in bulk: face i has the points indices[offsets[i] .. offsets[i+1]-1], in any
 * order. This is how boundary groups of a mesh file become face ids.
 * @param environment, count [in] @param offsets [in] count + 1 ascending values.
 * @param indices [in] of vertices, offsets[count] of them.
 * @param faces [out] count canonical ids; null ids where no face has these vertices.
 * @param missing [out] may be null: how many were not found.
 * @return DSW_STATUS_WRONG_SIZE for offsets that descend, DSW_STATUS_OUT_OF_MEMORY.
 * @note O(faces of the environment + vertices given), expected. Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_find_faces(const dsw_environment *environment, size_t count, const size_t *offsets,
                                              const uint32_t *indices, dsw_face_id *faces, size_t *missing);

/** Finds edges by their two vertices, in bulk: edge i joins points indices[2 i] and indices[2 i + 1]. Not in the
 * plane, where faces are found by two vertices.
 * @param environment, count [in] @param indices [in] 2 * `count` indices of vertices.
 * @param edges [out] count canonical ids; null ids where there is no such edge. @param missing [out] may be null.
 * @return DSW_STATUS_OUT_OF_MEMORY.
 * @note O(edges of the environment + count), expected. Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_find_edges(const dsw_environment *environment, size_t count, const uint32_t *indices,
                                              dsw_edge_id *edges, size_t *missing);

/** Region label of a volume (0 if none were given).
 * @param environment, volume [in] @param region [out]
 * @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_region(const dsw_environment *environment, dsw_volume_id volume,
                                              int32_t *region);

/** Host tag of a volume (0 if none were given).
 * @param environment, volume [in] @param tag [out]
 * @return DSW_STATUS_STALE_ID. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_tag(const dsw_environment *environment, dsw_volume_id volume, uint32_t *tag);

/** Sets the host tag of a volume; the first tag costs 4 bytes a volume. Tags change no result, so this is allowed
 * while scenes use the environment.
 * @param environment [in,out] @param volume, tag [in]
 * @return DSW_STATUS_STALE_ID, OUT_OF_MEMORY. @note O(1) amortised. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_environment_set_tag(dsw_environment *environment, dsw_volume_id volume, uint32_t tag);

#ifdef __cplusplus
}
#endif

#endif
