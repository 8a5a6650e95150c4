/** @file contact_check.h
 * A second opinion on contact normals by libccd, for tests and for whoever doubts. An optional part of the build.
 */
#ifndef DARTSWEEP_CONTACT_CHECK_H
#define DARTSWEEP_CONTACT_CHECK_H

#include "dartsweep/contact.h"
#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What libccd was asked. */
typedef enum dsw_opinion {
  DSW_OPINION_NONE = 0, /**< It has none: see dsw_contact_opinion::reason. */
  DSW_OPINION_PLANE =
      1, /**< The touching point or segment against the volume behind the wall, or the wall's triangle. */
  DSW_OPINION_EDGE = 2, /**< The touching segment against the tetrahedron of the wall's edge and its two faces. */
  DSW_OPINION_FORCE_INT32 = 0x7fffffff
} dsw_opinion;

/** Why there is no opinion. */
typedef enum dsw_no_opinion {
  DSW_NO_OPINION_NONE = 0,
  DSW_NO_OPINION_WIRE = 1,          /**< The obstacle has no volume: a wire, a marked vertex. */
  DSW_NO_OPINION_PARALLEL = 2,      /**< Edge and edge: the sine of their angle is below 1e-3. */
  DSW_NO_OPINION_OUTSIDE_CONE = 3,  /**< Edge and edge: the normal lies outside the cone of the wall's two faces. */
  DSW_NO_OPINION_NOT_CONVERGED = 4, /**< libccd found nothing, did not end within its calls, or answered NaN. */
  DSW_NO_OPINION_FORCE_INT32 = 0x7fffffff
} dsw_no_opinion;

/** libccd's answer beside ours. */
typedef struct dsw_contact_opinion {
  double normal[3]; /**< libccd's, unit, out of the obstacle. */
  double depth;     /**< Of the test penetration, as libccd sees it; scene units. */
  double pushed_in; /**< How deep the feature was pushed in for the test; scene units. */
  double angle_rad; /**< Between the two normals. */
  dsw_opinion opinion;
  dsw_no_opinion reason;
} dsw_contact_opinion;

/** Computes the normal of a contact a second time with libccd on the two convex features.
 * @param environment [in] where the contact was found, unchanged since. @param contact [in] of a body's move.
 * @param opinion [out]
 * @return DSW_STATUS_OK also without an opinion. DSW_STATUS_NOT_BUILT without libccd, STALE_ID, NON_FINITE, UNSUPPORTED (kind).
 * @note O(1). Thread: reader. @since 0.1 */
DSW_API dsw_status dsw_contact_check(const dsw_environment *environment, const dsw_contact *contact,
                                     dsw_contact_opinion *opinion);

#ifdef __cplusplus
}
#endif

#endif
