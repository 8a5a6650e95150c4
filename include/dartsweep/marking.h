/** @file marking.h
 * Marks: which cells are passable. A mark belongs to one cell. Faces of an impassable volume, and
 * edges and vertices of an impassable face, are impassable, too. The outer boundary (faces with one
 * volume) is always impassable. A marked edge or vertex stops no particle, only edges and faces of
 * bodies (dsw_level). More: bindings/docs/topology.md.
 *
 * Marking answers DSW_STATUS_SHARED if several scenes use the environment, and OCCUPIED if
 * particles or bodies lie in or cross the cells: dsw_scene_get_occupants and
 * dsw_scene_get_occupant_bodies tell which. Edges of bodies count from DSW_LEVEL_EDGES on, faces at
 * DSW_LEVEL_FACES. `marked` and `skipped` may be null.
 */
#ifndef DARTSWEEP_MARKING_H
#define DARTSWEEP_MARKING_H

#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The mark of a cell. */
typedef enum dsw_mark {
  DSW_MARK_PASSABLE = 0,   /**< The cell can be passed. */
  DSW_MARK_IMPASSABLE = 1, /**< The cell cannot be passed. */
  DSW_MARK_FORCE_INT32 = 0x7fffffff
} dsw_mark;

/** Flags of the marking calls. */
enum {
  /** Occupied volumes keep their mark; the call succeeds. */
  DSW_MARK_SKIP_OCCUPIED = 0x1
};

/** Sets the mark of volumes. An id may occur twice.
 * @param skipped occupied volumes that kept their mark.
 * @note Cost: O(count + particles + bodies). */
DSW_API dsw_status dsw_environment_mark_volumes(dsw_environment *environment,
                                                const dsw_volume_id *volumes, size_t count,
                                                dsw_mark mark, uint32_t flags, size_t *skipped);

/** Sets the mark of faces. @note Cost: O(count + bodies). */
DSW_API dsw_status dsw_environment_mark_faces(dsw_environment *environment,
                                              const dsw_face_id *faces, size_t count,
                                              dsw_mark mark);

/** Sets the mark of edges, at about 16 bytes each. @note Cost: O(count + bodies) expected. */
DSW_API dsw_status dsw_environment_mark_edges(dsw_environment *environment,
                                              const dsw_edge_id *edges, size_t count,
                                              dsw_mark mark);

/** Sets the mark of vertices. Only thick bodies can be in the way. The first mark takes a bit for
 * every vertex.
 * @note Cost: O(count + thick bodies). */
DSW_API dsw_status dsw_environment_mark_vertices(dsw_environment *environment,
                                                 const dsw_vertex_id *vertices, size_t count,
                                                 dsw_mark mark);

/** Sets the mark of every volume with the label `region`.
 * @param marked those that have the mark now.
 * @param skipped as in dsw_environment_mark_volumes.
 * @note Cost: O(volumes + particles + bodies). */
DSW_API dsw_status dsw_environment_mark_region(dsw_environment *environment, int32_t region,
                                               dsw_mark mark, uint32_t flags, size_t *marked,
                                               size_t *skipped);

/** Sets the mark of every face between region `a` and region `b`.
 * @param marked how many.
 * @note Cost: O(volumes + bodies). */
DSW_API dsw_status dsw_environment_mark_between(dsw_environment *environment, int32_t a, int32_t b,
                                                dsw_mark mark, size_t *marked);

/** Tells by `marked`, 0 or 1, whether a cell itself has a mark. */
DSW_API dsw_status dsw_environment_is_marked(const dsw_environment *environment, dsw_cell cell,
                                             int *marked);

/** Tells by `impassable`, 0 or 1, whether a cell is impassable for any reason.
 * @note Cost: O(volumes round the cell), for a vertex O(volumes). */
DSW_API dsw_status dsw_environment_is_impassable(const dsw_environment *environment, dsw_cell cell,
                                                 int *impassable);

/** Counts the marked cells of a kind. */
DSW_API dsw_status dsw_environment_get_mark_count(const dsw_environment *environment,
                                                  dsw_cell_kind kind, size_t *count);

/** Makes faces of the outer boundary exits, for particles and for vertices of bodies that move with
 * DSW_MOVE_LEAVE. All else stops there as at any wall. Exits follow changes of the topology: parts of
 * an exit are exits, and a face that is sewn is none any more. Snapshots keep them.
 * @param patch the number that reports name; 0: the faces are no exits any more.
 * @return DSW_STATUS_BAD_TOPOLOGY: a face has two volumes; SHARED.
 * @note Cost: O((count + exits) log exits). 12 bytes an exit. @since 2.1 */
DSW_API dsw_status dsw_environment_mark_exits(dsw_environment *environment,
                                              const dsw_face_id *faces, size_t count,
                                              uint32_t patch);

/** Gives the number `patch` of the exit that a face is, or 0.
 * @note Cost: O(log exits). @since 2.1 */
DSW_API dsw_status dsw_environment_get_exit(const dsw_environment *environment, dsw_face_id face,
                                            uint32_t *patch);

/** Copies the faces of all exits, ordered by the indices of volumes, then by `local`.
 * @note Cost: O(exits). @since 2.1 */
DSW_API dsw_status dsw_environment_get_exit_faces(const dsw_environment *environment,
                                                  dsw_face_id *faces, size_t capacity,
                                                  size_t *count);

#ifdef __cplusplus
}
#endif

#endif
