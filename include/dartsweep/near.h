/** @file near.h
 * Near rows: where a body is close to the environment, to other bodies or to itself, ready for a
 * solver: vertices with weights, nearest points, a unit normal and the gap.
 *
 * A *part* is a vertex, an edge or a face that the body's level covers. An *obstacle* is an
 * impassable face, edge or vertex, or a part of a body that the part could touch. Both make a row
 * if their nearest points are unique, lie in the inside of both, are locally nearest on the
 * obstacle, and have nothing impassable between them, and if the gap is at most the margin. All but
 * the gap is decided exactly, under the shift (base.h). More: bindings/docs/near_rows.md.
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
  uint32_t struct_size;
  uint32_t flags;
  double margin; /**< Largest gap of a row; finite, at least 0 (default). */
  double radius; /**< Added to the body's radius; finite, at least 0 (default). */
} dsw_near_options;

/** A part of a body with `vertices` (1 to 3, then UINT32_MAX), and an obstacle with
 * `obstacle_vertices` (of the environment or the other body). `weights` and `obstacle_weights`
 * (unused ones 0) sum to 1, and give the nearest points `point` and `obstacle_point`. */
typedef struct dsw_near_row {
  double point[3];
  double obstacle_point[3];
  double normal[3]; /**< Unit, from the obstacle towards the part. */
  double distance;  /**< Between both points. */
  double gap;       /**< Distance less the radius, and less that of the other body. */
  double weights[3];
  double obstacle_weights[3];
  uint32_t vertices[3];
  uint32_t obstacle_vertices[3];
  /** The face (also for a diagonal), edge or vertex, canonical. At a body: none. */
  dsw_cell obstacle;
  /** An impassable face at the obstacle, canonical: nearest in angle; of equals, the lowest that
   * looks towards the part. Null for a marked edge or vertex, and at a body. */
  dsw_face_id wall;
  uint32_t tag;     /**< The tag at `wall`; see dsw_contact. */
  dsw_body_id body; /**< The other body, or null. */
  /** Names the row of its body in later calls, until the part or the obstacle is cut or renumbered.
   * Rows are sorted by keys. */
  uint32_t key[4];
  /** For a warm start: number of the row before that this row continues
   * (bindings/docs/near_rows.md), or UINT32_MAX. */
  uint32_t previous;
  uint32_t reserved;
} dsw_near_row;

/** Writes the defaults. @since 2.1 */
DSW_API void dsw_near_options_init(dsw_near_options *options, size_t size);

/** Finds the near rows of a body, and keeps them until the next call. At a limit a distance counts
 * up to 2^-40 of the largest coordinate of its points.
 * @return DSW_STATUS_OUT_OF_MEMORY: there are no rows then; other failures keep the old ones.
 * @note Cost: O(volumes within the limit), less where the body has moved little since the last
 * call. Writes the scene. @since 2.1 */
DSW_API dsw_status dsw_body_find_near_rows(dsw_scene *scene, dsw_body_id body,
                                           const dsw_near_options *options, size_t *row_count);

/** Gives the rows of the last dsw_body_find_near_rows.
 * @param rows valid until the next call that writes the body. @since 2.1 */
DSW_API dsw_status dsw_body_get_near_rows(const dsw_scene *scene, dsw_body_id body,
                                          const dsw_near_row **rows, size_t *count);

/** Gives where the rows of the Jacobian begin: the derivatives of the gaps by the coordinates of
 * the body's vertices. Row i has the entries offsets[i] .. offsets[i+1]-1. Vertices of an obstacle
 * of the same body have entries, too.
 * @param offsets valid as the rows.
 * @param count rows + 1; 0 without DSW_NEAR_JACOBIAN. @since 2.1 */
DSW_API dsw_status dsw_body_get_near_offsets(const dsw_scene *scene, dsw_body_id body,
                                             const uint32_t **offsets, size_t *count);

/** Gives the columns of the Jacobian's entries: dimension * vertex + axis, ascending in each row.
 * @param columns, count as many as entries; valid as the rows. @since 2.1 */
DSW_API dsw_status dsw_body_get_near_columns(const dsw_scene *scene, dsw_body_id body,
                                             const uint32_t **columns, size_t *count);

/** Gives the values of the Jacobian's entries: weight times normal, negative for the obstacle's
 * vertices.
 * @param values, count as for the columns. @since 2.1 */
DSW_API dsw_status dsw_body_get_near_values(const dsw_scene *scene, dsw_body_id body,
                                            const double **values, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
