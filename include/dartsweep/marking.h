/** @file marking.h
 * Marks: which cells are passable. A mark belongs to one cell, and what follows from the mark is
 * never stored: the faces of an impassable volume are impassable, and so are the edges and vertices
 * of an impassable face. Removing a mark removes nothing else. The outer boundary, all faces with
 * one volume, is always impassable. A marked edge or vertex stops no particle: only edges and faces
 * of bodies can meet it (dsw_level).
 *
 * Marking needs an environment with at most one scene (else DSW_STATUS_SHARED). If a particle or
 * body occupies a cell that would become impassable, the call answers DSW_STATUS_OCCUPIED, and
 * dsw_scene_get_occupants and dsw_scene_get_occupant_bodies tell who. Occupied are:
 *  - a volume, by particles and vertices of bodies in it, by edges that cross it, by faces that it
 *    pierces;
 *  - a face, by edges that cross it, by faces that its rim pierces;
 *  - an edge, by faces that it pierces.
 *
 * Edges count from DSW_LEVEL_EDGES on, and faces at DSW_LEVEL_FACES. Nothing occupies a vertex: by
 * the shift nothing lies exactly on it. A cell that keeps its mark is not checked.
 *
 * Cost of the check, "the bodies" below: O(vertices, edges and faces of all bodies), and a cast or
 * sweep for each of their edges and faces in the box of the cells that change.
 * DSW_FEATURE_LIVE_CHANGES restricts it to what is near.
 */
#ifndef DARTSWEEP_MARKING_H
#define DARTSWEEP_MARKING_H

#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The mark of a cell. */
typedef enum dsw_mark {
  DSW_MARK_PASSABLE = 0,            /**< Things go through. */
  DSW_MARK_IMPASSABLE = 1,          /**< Nothing does. */
  DSW_MARK_FORCE_INT32 = 0x7fffffff /**< Makes the type 32 bits wide. */
} dsw_mark;

/** Flags of the marking calls. */
enum {
  /** Occupied volumes keep their mark, and the call marks the rest. Without this flag one occupied
   * volume makes the call fail. */
  DSW_MARK_SKIP_OCCUPIED = 0x1
};

/** Sets the mark of volumes; an id may stand twice.
 * @param environment [in,out] @param volumes, count, mark [in]
 * @param flags [in] DSW_MARK_...
 * @param skipped [out] may be null; number of occupied volumes left out.
 * @return DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED.
 * @note Cost: O(count + particles), and the bodies; O(count) to make passable. Thread: writer of
 * the environment and its scene. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_volumes(dsw_environment *environment,
                                                const dsw_volume_id *volumes, size_t count,
                                                dsw_mark mark, uint32_t flags, size_t *skipped);

/** Sets the mark of faces.
 * @param environment [in,out] @param faces, count, mark [in]
 * @return DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED.
 * @note Cost: O(count), and the bodies. Thread: writer of the environment and its scene. @since
 * 1.0 */
DSW_API dsw_status dsw_environment_mark_faces(dsw_environment *environment,
                                              const dsw_face_id *faces, size_t count,
                                              dsw_mark mark);

/** Sets the mark of edges. A marked edge takes about 16 bytes.
 * @param environment [in,out] @param edges, count, mark [in]
 * @return DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED.
 * @note Cost: O(count) expected, and the bodies. Thread: writer of the environment and its scene.
 * @since 1.0 */
DSW_API dsw_status dsw_environment_mark_edges(dsw_environment *environment,
                                              const dsw_edge_id *edges, size_t count,
                                              dsw_mark mark);

/** Sets the mark of vertices. The first mark takes a bit for every vertex.
 * @param environment [in,out] @param vertices, count, mark [in]
 * @return DSW_STATUS_SHARED.
 * @note Cost: O(count). Thread: writer of the environment and its scene. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_vertices(dsw_environment *environment,
                                                 const dsw_vertex_id *vertices, size_t count,
                                                 dsw_mark mark);

/** Sets the mark of every volume with a region label.
 * @param environment [in,out] @param region, mark [in] @param flags [in] DSW_MARK_...
 * @param marked [out] may be null; volumes with the label that now have the mark.
 * @param skipped [out] may be null; number of occupied volumes left out.
 * @return DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED.
 * @note Cost: O(volumes + particles), and the bodies. Thread: writer of the environment and its
 * scene. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_region(dsw_environment *environment, int32_t region,
                                               dsw_mark mark, uint32_t flags, size_t *marked,
                                               size_t *skipped);

/** Sets the mark of every face between region `a` and region `b`.
 * @param environment [in,out] @param a, b, mark [in] @param marked [out] may be null; number of
 * faces.
 * @return DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED.
 * @note Cost: O(volumes), and the bodies. Thread: writer of the environment and its scene. @since
 * 1.0 */
DSW_API dsw_status dsw_environment_mark_between(dsw_environment *environment, int32_t a, int32_t b,
                                                dsw_mark mark, size_t *marked);

/** Tells whether a cell itself carries a mark.
 * @param environment, cell [in] @param marked [out] 0 or 1.
 * @return common statuses.
 * @note Cost: O(1) expected. Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_is_marked(const dsw_environment *environment, dsw_cell cell,
                                             int *marked);

/** Tells whether a cell is impassable for any reason.
 * @param environment, cell [in] @param impassable [out] 0 or 1.
 * @return common statuses.
 * @note Cost: O(volumes round the cell), for a vertex O(volumes). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_is_impassable(const dsw_environment *environment, dsw_cell cell,
                                                 int *impassable);

/** Counts the cells of a kind that carry a mark.
 * @param environment, kind [in] @param count [out]
 * @return common statuses.
 * @note Cost: O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_mark_count(const dsw_environment *environment,
                                                  dsw_cell_kind kind, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
