/** @file detach.h
 * Pieces that come off: what cuts and tears have parted from the rest becomes a body of the scene. Of space alone: in the plane
 * DSW_STATUS_UNSUPPORTED.
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
  uint32_t
      flags; /**< DSW_BODY_... of the body that it becomes; level, category, mask, motion_share as in dsw_body_desc. */
  dsw_level level;   /**< DSW_LEVEL_EDGES_SWEPT by default. */
  uint32_t category; /**< As in dsw_body_desc. */
  uint32_t mask;     /**< As in dsw_body_desc. */
  uint32_t
      halvings; /**< How often, at most, the distance by which a vertex is drawn in is halved, and as often doubled; 40
                          at most; 0 means 32. */
  double motion_share; /**< As in dsw_body_desc. */
  double gap; /**< How far a vertex is drawn into the piece at first: share of the shortest edge of the surface there,
                   above 0 and at most 0.25; 0 means 0.01. */
  dsw_volume_id volume; /**< Any volume of the piece. */
  size_t
      max_volumes; /**< A piece of more is refused; 0: none is. What is not off takes all that it hangs on with it. */
} dsw_detach_desc;

/** What has come off. */
typedef struct dsw_detach_report {
  double distance;       /**< Largest distance, rounded, by which a vertex was drawn in. Scene units. */
  uint32_t volume_count; /**< See dsw_scene_get_detached_volumes. */
  uint32_t vertex_count; /**< Vertices of the body, see dsw_scene_get_detached_vertices. */
  uint32_t face_count;   /**< Its triangles, see dsw_scene_get_detached_faces. */
  uint32_t sewn_count;   /**< Faces of cracks that were sewn: two became one. */
  uint32_t unsewn_count; /**< Faces of the piece that stay on the outer boundary. */
  uint32_t reserved;     /**< 0. */
} dsw_detach_report;

/** Where a vertex of the body comes from: weights[0] from[0] + weights[1] from[1], before it was drawn in. */
typedef struct dsw_detached_vertex {
  dsw_vertex_id from[2]; /**< The same twice, but where an edge had to be split. */
  double weights[2];     /**< 1 and 0; there 0.5 and 0.5. */
} dsw_detached_vertex;

/** Where a face of the body comes from. */
typedef struct dsw_detached_face {
  dsw_face_id face;     /**< Face of the environment that it is a triangle of, or a part of one. */
  dsw_volume_id volume; /**< The piece's volume there, on the inner side of the body's face. */
} dsw_detached_face;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_detach_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_detach_desc_init(dsw_detach_desc *desc, size_t size);

/** Detaches a piece: impassable volumes that hang together through faces, and with no other impassable one but across cracks (of
 * dsw_environment_cut with DSW_CUT_UNSEW, dsw_environment_tear_faces, dsw_environment_unsew_face). They become passable, and their
 * surface becomes a body of the scene, which can be moved away.
 *
 * The space. Marks of all faces of the piece go, and of edges and vertices inside of it; of edges and vertices on its surface
 * they stay. Cracks round the piece and in it are sewn where both sides have the same vertices and triangles; other faces that
 * have one volume stay on the outer boundary (dsw_environment_get_face_volumes tells which). No volume changes: all ids stay valid,
 * and dsw_environment_get_volume_changes lists none.
 *
 * The body. Its vertex i is that of dsw_scene_get_detached_vertices, its face i that of dsw_scene_get_detached_faces, counter-clockwise
 * seen from outside. It is closed, and a manifold: where the piece touches itself in a vertex or along an edge, each part has
 * vertices of its own; of several edges that then still have the same two ends all but one are split in the middle. Cracks that end
 * inside of the piece are no part of it. Its surface lies on walls, so vertices are drawn into the piece, each towards where it
 * leaves all faces at it behind: by `gap` of the shortest edge at it, then, where that is not free or touches a body, by half as much,
 * twice as much, a quarter, and so on, but never by more than `gap` of the shortest or a quarter of the longest edge at it.
 * @param scene [in,out] the only one of its environment. @param desc [in] see dsw_detach_desc. @param body [out] its id.
 * @param report [out] may be null.
 * @return DSW_STATUS_NULL_ARGUMENT, BAD_STRUCT_SIZE, UNSUPPORTED (flags, level), OUT_OF_RANGE (gap, halvings, motion_share), NOT_NAMED
 * (as dsw_body_create), STALE_ID, SHARED (other scenes use the environment), BAD_TOPOLOGY (the volume is passable), TOO_LARGE
 * (more than max_volumes hang together: the piece is not off), INVALID_CELL (a volume of it is, after a deformation), OCCUPIED (the
 * body can't be drawn free: where the piece is hardly thicker than the rounding of its coordinates, or so bent round a vertex
 * that no place near that sees all faces at it; the message names vertices), OUT_OF_MEMORY: nothing has changed.
 * @note O(size of the piece and of what touches it + particles and size of the bodies), expected; once tables as topology.h says; and
 * O(volumes) where the other side of a crack can't be reached round its rim, as of a piece cut out all round. Points may be
 * borrowed. Thread: writer of the environment and of its scene. Certain: what the level covers is free. @since 1.0 */
DSW_API dsw_status dsw_scene_detach(dsw_scene *scene, const dsw_detach_desc *desc, dsw_body_id *body,
                                    dsw_detach_report *report);

/** Volumes of the last piece that came off. Ids are those from right after it.
 * @param scene [in] @param volumes [out] owned by the scene, valid until its next successful dsw_scene_detach.
 * @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_detached_volumes(const dsw_scene *scene, const dsw_volume_id **volumes, size_t *count);

/** Where the vertices of its body come from, by index.
 * @param scene [in] @param vertices [out] as above. @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_detached_vertices(const dsw_scene *scene, const dsw_detached_vertex **vertices,
                                                   size_t *count);

/** Where the faces of its body come from, by index.
 * @param scene [in] @param faces [out] as above. @param count [out] how many there are.
 * @return DSW_STATUS_NULL_ARGUMENT. @note O(1). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_scene_get_detached_faces(const dsw_scene *scene, const dsw_detached_face **faces, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
