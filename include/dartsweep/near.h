/** @file near.h
 * Near rows: where a body is close to the environment, to other bodies or to itself. A row is ready
 * for a solver: it has the body's vertices with weights, both nearest points, a unit normal and the
 * gap.
 *
 * A *part* is a vertex, an edge or a face that the body's level covers. An *obstacle* is an
 * impassable face, an edge or a vertex of one, or a marked edge or vertex. Faces count as the
 * triangles into which they are cut. A part and an obstacle make a row if
 * - their nearest points are unique and lie in the inside of both (a vertex is its own inside),
 * - the point on the obstacle is a local minimum: if it is moved a little on any obstacle there, it
 *   does not come closer to the point on the part,
 * - an edge does not run parallel to both faces at an edge that it passes,
 * - the segment between the two points passes nothing impassable,
 * - the gap is at most the margin.
 *
 * The search passes from the part through passable volumes within the limit. An obstacle that is
 * not reached in this way makes no row. So nothing behind a wall has a row.
 *
 * A vertex near a flat wall has one row. A vertex in a corner of a room has one for each wall. An
 * edge that passes a corner that sticks out has one row at this corner. If an edge is parallel to a
 * wall, its ends have the rows.
 *
 * The first four conditions are decided exactly, also where the nearest points are not doubles. With
 * respect to the environment a body is shifted (base.h). So a vertex that touches a wall sees the
 * other walls there, and a segment that touches a wall without passing it is free or not as the
 * shift says. Two walls in one place, as at a closed slit, hide each other. Points, distances and
 * normals are rounded.
 *
 * With DSW_FEATURE_BODY_CONTACTS the same holds for obstacles that are parts of other bodies, if
 * the filters match, and of the same body with DSW_BODY_SELF_CONTACTS. Nothing but the environment
 * hides these. Of the same body, parts with a common vertex make no row, and each pair makes one.
 *
 * More: bindings/docs/near_rows.md.
 */
#ifndef DARTSWEEP_NEAR_H
#define DARTSWEEP_NEAR_H

#include "dartsweep/body.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Flags of dsw_near_options. */
enum {
  /** Also makes the Jacobian, see dsw_body_get_near_offsets. */
  DSW_NEAR_JACOBIAN = 0x1
};

/** What counts as near. */
typedef struct dsw_near_options {
  uint32_t struct_size; /**< sizeof(dsw_near_options). */
  uint32_t flags;       /**< DSW_NEAR_... */
  double margin;        /**< Largest gap of a row; finite, at least 0. Default 0. */
  double radius;        /**< Added to the radius of the body; finite, at least 0. Default 0. */
} dsw_near_options;

/** A part of a body and what it is near to. */
typedef struct dsw_near_row {
  double point[3];          /**< Nearest point of the part. */
  double obstacle_point[3]; /**< Nearest point of the obstacle. */
  double normal[3];         /**< Unit, from the obstacle towards the part. */
  double distance;          /**< Between the two points. */
  double gap;        /**< Distance less the radius; at a body, also less that body's radius. */
  double weights[3]; /**< Of `vertices`: sum to 1; `point` is the weighted sum. 0 unused. */
  double obstacle_weights[3]; /**< Of `obstacle_vertices`, likewise. */
  uint32_t vertices[3];       /**< The part's vertices: 1 to 3, then UINT32_MAX. */
  /** The obstacle's: indices of vertices of the environment, or of the other body. */
  uint32_t obstacle_vertices[3];
  /** The face, edge or vertex, canonical. A diagonal of a face has the face. At a body: none. */
  dsw_cell obstacle;
  /** An impassable face at the obstacle, canonical: the nearest one in angle; of equals, the lowest
   * that looks towards the part.
   * Null for a marked edge or vertex, and at a body. */
  dsw_face_id wall;
  uint32_t tag;     /**< As in dsw_contact, of `wall`. */
  dsw_body_id body; /**< The other body; null for the environment. */
  /** Names the row among those of its body. The same part and obstacle have the same key in later
   * calls, as long as neither is cut or renumbered. Rows are sorted by their keys. */
  uint32_t key[4];
  /** For a warm start: number of the row in the call before that this row continues. That is the
   * row with the same key. Otherwise it is the nearest row of the same part whose key is gone and
   * whose normal is at most 60 degrees away. UINT32_MAX if there is none. */
  uint32_t previous;
  uint32_t reserved; /**< 0. */
} dsw_near_row;

/** Writes the defaults. @since 2.1 */
DSW_API void dsw_near_options_init(dsw_near_options *options, size_t size);

/** Finds the near rows of a body, and keeps them with the body until the next call for it.
 *
 * All rows are given, apart from rounding: a row may be present or absent if its distance differs
 * from its limit by at most 2^-40 of the largest coordinate of the points that are involved.
 * @param options null means the defaults.
 * @param row_count may be null.
 * @return DSW_STATUS_OUT_OF_RANGE: margin or radius. DSW_STATUS_OUT_OF_MEMORY: there are no rows
 * then. Any other failure keeps the rows of before.
 * @note Cost: O(volumes within the limit of the body), independent of the size of the environment.
 * The call remembers the obstacles near each edge, with some room to move. While the ends of an edge
 * stay in this room, the edge costs its obstacles alone, or one comparison if there are none. A
 * change of the environment empties this memory. Threads: writes the scene. @since 2.1 */
DSW_API dsw_status dsw_body_find_near_rows(dsw_scene *scene, dsw_body_id body,
                                           const dsw_near_options *options, size_t *row_count);

/** Gives the rows of the last dsw_body_find_near_rows.
 * @param rows belong to the scene, until the next call that writes this body.
 * @note Cost: O(1). @since 2.1 */
DSW_API dsw_status dsw_body_get_near_rows(const dsw_scene *scene, dsw_body_id body,
                                          const dsw_near_row **rows, size_t *count);

/** Gives where the rows of the Jacobian begin. The Jacobian has the derivatives of the gaps by the
 * coordinates of the body's vertices. It is stored as compressed sparse rows: the entries of row i
 * have the numbers offsets[i] .. offsets[i+1]-1. If the row is of a body with itself, the vertices
 * of the obstacle have entries, too. Vertices of another body have none: its own rows have them.
 * @param offsets belong to the scene, as the rows.
 * @param count one more than there are rows; 0 without DSW_NEAR_JACOBIAN.
 * @note Cost: O(1). @since 2.1 */
DSW_API dsw_status dsw_body_get_near_offsets(const dsw_scene *scene, dsw_body_id body,
                                             const uint32_t **offsets, size_t *count);

/** Gives the columns of the Jacobian's entries: dimension * vertex + axis, ascending in each row.
 * @param columns belong to the scene, as the rows. @param count entries.
 * @note Cost: O(1). @since 2.1 */
DSW_API dsw_status dsw_body_get_near_columns(const dsw_scene *scene, dsw_body_id body,
                                             const uint32_t **columns, size_t *count);

/** Gives the values of the Jacobian's entries: weight times normal; for vertices of the obstacle
 * the negative of that.
 * @param values belong to the scene, as the rows. @param count entries.
 * @note Cost: O(1). @since 2.1 */
DSW_API dsw_status dsw_body_get_near_values(const dsw_scene *scene, dsw_body_id body,
                                            const double **values, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
