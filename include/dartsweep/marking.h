/** @file marking.h
 * Marks: which cells are passable. A mark belongs to one cell. Faces of an impassable volume, and
 * edges and vertices of an impassable face, are impassable, too, until that mark is removed. The
 * outer boundary (faces with one volume) is always impassable. A marked edge or vertex stops no
 * particle, only edges and faces of bodies (dsw_level). More: bindings/docs/topology.md.
 *
 * Marking answers DSW_STATUS_SHARED if several scenes use the environment, and DSW_STATUS_OCCUPIED
 * if particles or bodies are in the way; dsw_scene_get_occupants and dsw_scene_get_occupant_bodies
 * tell which. Particles and bodies are in the way in the cells that they lie in or cross; edges of
 * bodies count from DSW_LEVEL_EDGES on, faces at DSW_LEVEL_FACES.
 *
 * Making cells impassable checks the bodies of the scene. Writers need the environment and its
 * scene.
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
  /** Occupied volumes keep their mark, instead of failing the call. */
  DSW_MARK_SKIP_OCCUPIED = 0x1
};

/** Sets the mark of volumes; an id may stand twice.
 * @param skipped how many occupied volumes kept their mark; may be null.
 * @note Cost: O(count + particles + bodies). Thread: writer.
 * @since 2.0 */
DSW_API dsw_status dsw_environment_mark_volumes(dsw_environment *environment,
                                                const dsw_volume_id *volumes, size_t count,
                                                dsw_mark mark, uint32_t flags, size_t *skipped);

/** Sets the mark of faces. @note Cost: O(count + bodies). Thread: writer. @since 2.0 */
DSW_API dsw_status dsw_environment_mark_faces(dsw_environment *environment,
                                              const dsw_face_id *faces, size_t count,
                                              dsw_mark mark);

/** Sets the mark of edges, about 16 bytes each.
 * @note Cost: O(count + bodies) expected. Thread: writer. @since 2.0 */
DSW_API dsw_status dsw_environment_mark_edges(dsw_environment *environment,
                                              const dsw_edge_id *edges, size_t count,
                                              dsw_mark mark);

/** Sets the mark of vertices, never OCCUPIED. The first takes a bit for every vertex.
 * @note Cost: O(count). Thread: writer. @since 2.0 */
DSW_API dsw_status dsw_environment_mark_vertices(dsw_environment *environment,
                                                 const dsw_vertex_id *vertices, size_t count,
                                                 dsw_mark mark);

/** Sets the mark of every volume with the label `region`.
 * @param marked how many volumes have the label and now the mark; may be null.
 * @param skipped as dsw_environment_mark_volumes.
 * @note Cost: O(volumes + particles + bodies). Thread: writer. @since 2.0 */
DSW_API dsw_status dsw_environment_mark_region(dsw_environment *environment, int32_t region,
                                               dsw_mark mark, uint32_t flags, size_t *marked,
                                               size_t *skipped);

/** Sets the mark of every face between region `a` and region `b`.
 * @param marked how many faces there are; may be null.
 * @note Cost: O(volumes + bodies). Thread: writer. @since 2.0 */
DSW_API dsw_status dsw_environment_mark_between(dsw_environment *environment, int32_t a, int32_t b,
                                                dsw_mark mark, size_t *marked);

/** Tells whether a cell itself carries a mark: `marked` is 0 or 1.
 * @note Cost: O(1) expected. Thread: reader. @since 2.0 */
DSW_API dsw_status dsw_environment_is_marked(const dsw_environment *environment, dsw_cell cell,
                                             int *marked);

/** Tells whether a cell is impassable for any reason: `impassable` is 0 or 1.
 * @note Cost: O(volumes round the cell), for a vertex O(volumes). Thread: reader. @since 2.0 */
DSW_API dsw_status dsw_environment_is_impassable(const dsw_environment *environment, dsw_cell cell,
                                                 int *impassable);

/** Counts the cells of a kind that carry a mark. @note Cost: O(1). Thread: reader. @since 2.0 */
DSW_API dsw_status dsw_environment_get_mark_count(const dsw_environment *environment,
                                                  dsw_cell_kind kind, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
