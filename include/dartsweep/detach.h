/** @file detach.h
 * Pieces that come off: volumes that cuts and tears have separated become a body of the scene.
 * More: bindings/docs/carving.md.
 */
#ifndef DARTSWEEP_DETACH_H
#define DARTSWEEP_DETACH_H

#include "dartsweep/scene.h"
#include "dartsweep/sweep.h"
#include "dartsweep/topology.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Describes a piece that comes off. */
typedef struct dsw_detach_desc {
  uint32_t struct_size; /**< sizeof(dsw_detach_desc). */
  uint32_t flags;       /**< DSW_BODY_... of the body. */
  dsw_level level;      /**< DSW_LEVEL_EDGES_SWEPT by default. */
  uint32_t category;    /**< As in dsw_body_desc. */
  uint32_t mask;        /**< As in dsw_body_desc. */
  uint32_t halvings;    /**< Halvings and doublings of `gap`, at most 40; 0 means 32. */
  double motion_share;  /**< As in dsw_body_desc. */
  /** First distance from the walls: a share of the shortest edge, up to 0.25; 0 means 0.01. */
  double gap;
  dsw_volume_id volume; /**< Any volume of the piece. */
  /** Larger pieces are refused; 0: none. */
  size_t max_volumes;
} dsw_detach_desc;

/** What came off. */
typedef struct dsw_detach_report {
  double distance;       /**< Largest distance of a vertex from its origin. */
  uint32_t volume_count; /**< See dsw_scene_get_detached_volumes. */
  uint32_t vertex_count; /**< See dsw_scene_get_detached_vertices. */
  uint32_t face_count;   /**< See dsw_scene_get_detached_faces. */
  uint32_t sewn_count;   /**< Faces sewn: two became one. */
  uint32_t unsewn_count; /**< Faces of the piece that stay on the outer boundary. */
  uint32_t reserved;     /**< 0. */
} dsw_detach_report;

/** Origin of a vertex of the body: weights[0] from[0] + weights[1] from[1]. */
typedef struct dsw_detached_vertex {
  dsw_vertex_id from[2]; /**< Equal, unless an edge was split. */
  double weights[2];     /**< 1 and 0, or twice 0.5. */
} dsw_detached_vertex;

/** Origin of a face of the body. */
typedef struct dsw_detached_face {
  dsw_face_id face;     /**< Face that holds the triangle. */
  dsw_volume_id volume; /**< Volume of the piece at that face. */
} dsw_detached_face;

/** Writes the defaults.
 * @note Cost: O(1). Thread: any. @since 1.0 */
DSW_API void dsw_detach_desc_init(dsw_detach_desc *desc, size_t size);

/** Detaches a piece: impassable volumes that only cracks join to other impassable volumes. The
 * volumes become passable, and cracks round them are sewn. Their surface becomes a closed body,
 * drawn a little off the walls.
 * @param scene the only scene of its environment.
 * @param report may be null.
 * @return DSW_STATUS_SHARED; BAD_TOPOLOGY: the volume is passable; TOO_LARGE: more than
 * max_volumes; INVALID_CELL; NOT_NAMED: as dsw_body_create; OCCUPIED: vertices without a free
 * place.
 * @note Cost: O(piece + particles + bodies), expected, or O(n). Thread: writer of the environment
 * and of its scene. @since 1.0 */
DSW_API dsw_status dsw_scene_detach(dsw_scene *scene, const dsw_detach_desc *desc,
                                    dsw_body_id *body, dsw_detach_report *report);

/** Gives the volumes of the last detached piece, by their ids then.
 * @note Cost: O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_detached_volumes(const dsw_scene *scene,
                                                  const dsw_volume_id **volumes, size_t *count);

/** Gives the origins of its vertices, by index.
 * @note Cost: O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_detached_vertices(const dsw_scene *scene,
                                                   const dsw_detached_vertex **vertices,
                                                   size_t *count);

/** Gives the origins of its faces, by index.
 * @note Cost: O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_detached_faces(const dsw_scene *scene,
                                                const dsw_detached_face **faces, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
