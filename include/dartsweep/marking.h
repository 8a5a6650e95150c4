/** @file marking.h
 * Passable and impassable cells. A mark is set on one cell; what follows from it is derived, never stored: a face
 * of an impassable volume and an edge or vertex of an impassable face count as impassable, and unmarking removes only
 * what was set. Faces with one volume (the outer boundary) are always impassable. A marked edge is a wire, a
 * marked vertex a point obstacle; a particle meets neither (only sweeps of edges and faces do).
 *
 * While exactly one scene uses the environment, marking is allowed and checked against what that scene holds;
 * with several scenes it answers DSW_STATUS_SHARED. Nothing becomes impassable that a particle or a body occupies. A volume
 * is occupied by every particle and every vertex of a body in it, by every edge that crosses it (bodies from DSW_LEVEL_EDGES
 * on) and by every face that it pierces (DSW_LEVEL_FACES). A face is occupied by edges that cross it (from DSW_LEVEL_EDGES on) and
 * by faces that its rim pierces (DSW_LEVEL_FACES); an edge by faces that it pierces (DSW_LEVEL_FACES); a vertex never: under the
 * shift it lies on nothing, nor, in the plane, any edge on it. Passable cells can be marked passable, and impassable ones impassable,
 * whatever is there.
 *
 * Where something is in the way, dsw_scene_get_occupants and dsw_scene_get_occupant_bodies tell what. Without bodies in the
 * scene their part costs nothing. With bodies, making cells impassable also costs O(vertices, edges and faces of all bodies of
 * the scene), and a cast or sweep for each of their edges and faces in the box of the cells that change. In a scene with
 * DSW_FEATURE_LIVE_CHANGES only particles in these cells, and what of bodies is near them, is looked at.
 */
#ifndef DARTSWEEP_MARKING_H
#define DARTSWEEP_MARKING_H

#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The mark of one cell. */
typedef enum dsw_mark {
  DSW_MARK_PASSABLE = 0,            /**< Things go through. */
  DSW_MARK_IMPASSABLE = 1,          /**< Nothing does. */
  DSW_MARK_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_mark;

/** Flags of the marking calls. */
enum {
  /** Volumes that a particle or a body occupies keep their mark and the rest is marked; without this flag one
   * occupied volume makes the call return DSW_STATUS_OCCUPIED with nothing changed. */
  DSW_MARK_SKIP_OCCUPIED = 0x1
};

/** Sets the mark of volumes. An id may stand twice.
 * @param environment [in,out] @param volumes [in] `count` live ids. @param count [in]
 * @param mark [in] the mark they get. @param flags [in] DSW_MARK_...
 * @param skipped [out] may be null: how many occupied volumes were left out.
 * @return DSW_STATUS_STALE_ID (the message names the position), DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED,
 * DSW_STATUS_OUT_OF_MEMORY: nothing has changed.
 * @note O(count), plus one pass over the scene's particles and bodies when volumes become impassable; see above. Thread:
 * writer of the environment and of its scene. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_volumes(dsw_environment *environment, const dsw_volume_id *volumes,
                                                size_t count, dsw_mark mark, uint32_t flags, size_t *skipped);

/** Sets the mark of faces.
 * @param environment [in,out] @param faces [in] `count` live ids. @param count, mark [in]
 * @return as dsw_environment_mark_volumes.
 * @note O(count), and the scene's bodies. Errors and thread as dsw_environment_mark_volumes. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_faces(dsw_environment *environment, const dsw_face_id *faces, size_t count,
                                              dsw_mark mark);

/** Sets the mark of edges; in the plane there are none.
 * @param environment [in,out] @param edges [in] `count` live ids. @param count, mark [in]
 * @return as dsw_environment_mark_volumes.
 * @note O(count), expected, and the scene's bodies; a marked edge costs about 16 bytes. Errors and thread as
 * dsw_environment_mark_volumes. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_edges(dsw_environment *environment, const dsw_edge_id *edges, size_t count,
                                              dsw_mark mark);

/** Sets the mark of vertices.
 * @param environment [in,out] @param vertices [in] `count` live ids. @param count, mark [in]
 * @return as dsw_environment_mark_volumes.
 * @note O(count); the first marked vertex costs one bit for every vertex. Errors, but for DSW_STATUS_OCCUPIED, and
 * thread as dsw_environment_mark_volumes. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_vertices(dsw_environment *environment, const dsw_vertex_id *vertices,
                                                 size_t count, dsw_mark mark);

/** Sets the mark of every volume whose region label is `region`.
 * @param environment [in,out] @param region, mark [in] @param flags, skipped [in,out] as dsw_environment_mark_volumes.
 * @param marked [out] may be null: volumes that have that label and now that mark.
 * @return as dsw_environment_mark_volumes.
 * @note O(volumes), and the scene's particles and bodies. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_region(dsw_environment *environment, int32_t region, dsw_mark mark,
                                               uint32_t flags, size_t *marked, size_t *skipped);

/** Sets the mark of every face between a volume of region `a` and one of region `b`; the order does not matter.
 * @param environment [in,out] @param a, b, mark [in] @param marked [out] may be null: how many faces there are.
 * @return as dsw_environment_mark_volumes. @note O(volumes), and the scene's bodies. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_between(dsw_environment *environment, int32_t a, int32_t b, dsw_mark mark,
                                                size_t *marked);

/** Whether this very cell carries a mark (what was set, without what follows from it).
 * @param environment [in] @param cell [in] of any kind. @param marked [out] 0 or 1.
 * @return DSW_STATUS_STALE_ID, UNSUPPORTED (kind). @note O(1), expected. Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_is_marked(const dsw_environment *environment, dsw_cell cell, int *marked);

/** Whether a cell is impassable, by its own mark or by what follows from others or from the outer boundary.
 * @param environment [in] @param cell [in] of any kind. @param impassable [out] 0 or 1.
 * @return DSW_STATUS_STALE_ID, UNSUPPORTED (kind).
 * @note O(volumes round the cell); a vertex: O(volumes). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_is_impassable(const dsw_environment *environment, dsw_cell cell, int *impassable);

/** How many cells of one kind carry a mark.
 * @param environment [in] @param kind [in] any but DSW_CELL_NONE. @param count [out]
 * @return DSW_STATUS_UNSUPPORTED (kind). @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_mark_count(const dsw_environment *environment, dsw_cell_kind kind,
                                                  size_t *count);

#ifdef __cplusplus
}
#endif

#endif
