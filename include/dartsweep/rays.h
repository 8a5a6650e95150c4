/** @file rays.h
 * Rays and nearest places among the walls and the bodies of a scene. A body counts as far as its
 * level covers it: its vertices, its edges, its faces; a thick one out to its radius. Bodies that do
 * not meet each other count, too. Calls that run out of memory may have written some answers. More:
 * bindings/docs/rays.md.
 */
#ifndef DARTSWEEP_RAYS_H
#define DARTSWEEP_RAYS_H

#include "dartsweep/query.h"
#include "dartsweep/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Casts many segments to their ends, or to the first impassable face or part of a body.
 * Walls are met as by dsw_environment_cast_segments. Thin bodies are closed sets: a segment meets an
 * edge in space exactly where both have a point in common. If rounded times are equal, a wall
 * comes first, then the lowest body, then vertices, edges and faces by index.
 * @param flights `contact` as in dsw_body_contact; a thick body may be met 2^-30 of its radius early.
 * @param partners the body and the part that was met, or null ids.
 * @note Cost: as dsw_environment_cast_segments, and the parts of bodies near the segment; without
 * DSW_FEATURE_BODY_CONTACTS or LIVE_CHANGES all parts. Batch. Writes the scene. @since 2.1 */
DSW_API dsw_status dsw_scene_cast(dsw_scene *scene, size_t count, const dsw_volume_id *starts,
                                  const double *from, const double *to, size_t stride_bytes,
                                  const dsw_cast_options *options, dsw_flight *flights,
                                  dsw_contact_partner *partners);

/** Finds for each of many points what dsw_environment_find_nearest_to_points finds, or a body that is
 * nearer.
 * @param hints, radius, volumes, locations as in dsw_environment_find_nearest_to_points.
 * @param nearest at a body `cell` is null, and `distance` is that to its surface: negative within it.
 * @param partners as in dsw_scene_cast.
 * @note Cost: that of both searches. Batch. Writes the scene. @since 2.1 */
DSW_API dsw_status dsw_scene_find_nearest(dsw_scene *scene, const double *points, size_t count,
                                          size_t stride_bytes, const dsw_volume_id *hints,
                                          double radius, dsw_nearest *nearest,
                                          dsw_contact_partner *partners, dsw_volume_id *volumes,
                                          dsw_location *locations);

#ifdef __cplusplus
}
#endif

#endif
