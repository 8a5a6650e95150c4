/** @file marking.h
 * Marks: which cells are passable. A mark belongs to one cell, and what follows from the mark is
 * never stored: the faces of an impassable volume are impassable, and so are the edges and vertices
 * of an impassable face. Removing a mark removes nothing else. The outer boundary, all faces with
 * one volume, is always impassable. A marked edge or vertex stops no particle: only edges and faces
 * of bodies can meet it (dsw_level).
 *
 * Marking needs an environment with at most one scene (else DSW_STATUS_SHARED). It answers
 * DSW_STATUS_OCCUPIED if a cell that becomes impassable is occupied; dsw_scene_get_occupants and
 * dsw_scene_get_occupant_bodies tell by whom. Particles and vertices of bodies occupy their volume.
 * Edges of bodies (from DSW_LEVEL_EDGES on) occupy the volumes and faces that they cross. Faces of
 * bodies (at DSW_LEVEL_FACES) occupy the volumes and edges that they pierce, and the faces whose
 * rim they pierce. Nothing occupies a vertex: by the shift nothing lies exactly on it. A cell that
 * keeps its mark is not checked.
 *
 * "The bodies" in the costs below is a pass over all vertices, edges and faces of bodies, and a
 * cast or sweep for each edge and face in the box of the cells that become impassable.
 * DSW_FEATURE_LIVE_CHANGES confines both checks to what is near. Writers need the environment and
 * its scene.
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
  DSW_MARK_FORCE_INT32 = 0x7fffffff /**< No value. */
} dsw_mark;

/** Flags of the marking calls. */
enum {
  /** Occupied volumes keep their mark, and the call marks the rest. Without this flag one occupied
   * volume makes the call fail. */
  DSW_MARK_SKIP_OCCUPIED = 0x1
};

/** Sets the mark of volumes; an id may stand twice.
 * @param skipped how many occupied volumes kept their mark; may be null.
 * @return DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED.
 * @note Cost: O(count + particles), and the bodies; O(count) to make passable. Thread: writer.
 * @since 1.0 */
DSW_API dsw_status dsw_environment_mark_volumes(dsw_environment *environment,
                                                const dsw_volume_id *volumes, size_t count,
                                                dsw_mark mark, uint32_t flags, size_t *skipped);

/** Sets the mark of faces.
 * @return DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED.
 * @note Cost: O(count), and the bodies. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_faces(dsw_environment *environment,
                                              const dsw_face_id *faces, size_t count,
                                              dsw_mark mark);

/** Sets the mark of edges. A marked edge takes about 16 bytes.
 * @return DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED.
 * @note Cost: O(count) expected, and the bodies. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_edges(dsw_environment *environment,
                                              const dsw_edge_id *edges, size_t count,
                                              dsw_mark mark);

/** Sets the mark of vertices. The first mark takes a bit for every vertex.
 * @return DSW_STATUS_SHARED.
 * @note Cost: O(count). Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_vertices(dsw_environment *environment,
                                                 const dsw_vertex_id *vertices, size_t count,
                                                 dsw_mark mark);

/** Sets the mark of every volume with the label `region`.
 * @param marked how many volumes have the label and now the mark; may be null.
 * @param skipped as dsw_environment_mark_volumes.
 * @return DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED.
 * @note Cost: O(volumes + particles), and the bodies. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_region(dsw_environment *environment, int32_t region,
                                               dsw_mark mark, uint32_t flags, size_t *marked,
                                               size_t *skipped);

/** Sets the mark of every face between region `a` and region `b`.
 * @param marked how many faces there are; may be null.
 * @return DSW_STATUS_OCCUPIED, DSW_STATUS_SHARED.
 * @note Cost: O(volumes), and the bodies. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_environment_mark_between(dsw_environment *environment, int32_t a, int32_t b,
                                                dsw_mark mark, size_t *marked);

/** Tells whether a cell itself carries a mark: `marked` is 0 or 1.
 * @note Cost: O(1) expected. Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_is_marked(const dsw_environment *environment, dsw_cell cell,
                                             int *marked);

/** Tells whether a cell is impassable for any reason: `impassable` is 0 or 1.
 * @note Cost: O(volumes round the cell), for a vertex O(volumes). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_is_impassable(const dsw_environment *environment, dsw_cell cell,
                                                 int *impassable);

/** Counts the cells of a kind that carry a mark.
 * @note Cost: O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_environment_get_mark_count(const dsw_environment *environment,
                                                  dsw_cell_kind kind, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
