/** @file contact_check.h
 * A second opinion on contact normals by libccd, for tests and for whoever doubts. An optional part of the build. Of space
 * alone: in the plane DSW_STATUS_UNSUPPORTED.
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
  /** The touching point against the volume behind the wall, or, where that is not convex, not impassable or not there,
   * against the tetrahedron over one of the wall's triangles. */
  DSW_OPINION_PLANE = 1,
  /** The touching segment against the tetrahedron of the wall's edge and its two faces; of a diagonal, of the two triangles
   * there. */
  DSW_OPINION_EDGE = 2,
  DSW_OPINION_VERTEX = 3, /**< The touching triangle against what DSW_OPINION_PLANE says, at the wall's corner. */
  DSW_OPINION_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_opinion;

/** Why there is no opinion. */
typedef enum dsw_no_opinion {
  DSW_NO_OPINION_NONE = 0,          /**< There is one. */
  DSW_NO_OPINION_WIRE = 1,          /**< The obstacle has no volume: a wire, a marked vertex. */
  DSW_NO_OPINION_PARALLEL = 2,      /**< Edge and edge: the sine of their angle is below 1e-3. */
  DSW_NO_OPINION_OUTSIDE_CONE = 3,  /**< Edge or corner: the wall reaches above the plane across the normal. */
  DSW_NO_OPINION_NOT_CONVERGED = 4, /**< libccd found nothing, no way out of this contact, no number, or no end. */
  DSW_NO_OPINION_NOT_UNIQUE = 5,    /**< libccd's normal is another, but ours is one too: at the border of a feature. */
  DSW_NO_OPINION_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_no_opinion;

/** libccd's answer beside ours. */
typedef struct dsw_contact_opinion {
  double normal[3];      /**< libccd's, unit, out of the obstacle. */
  double depth;          /**< Of the test penetration, as libccd sees it; scene units. */
  double pushed_in;      /**< How deep the feature was pushed in for the test; scene units. */
  double angle_rad;      /**< Between the two normals. */
  dsw_opinion opinion;   /**< What was asked. */
  dsw_no_opinion reason; /**< Why there is none. */
} dsw_contact_opinion;

/** Computes the normal of a contact a second time with libccd on the two convex features. They are seen from the contact
 * point, scaled to unit size and pushed into each other by a millionth of it: as they come libccd finds no normal where things only
 * touch, nothing at the scale of millimetres, and no end at that of kilometres.
 * @param environment [in] where the contact was found, unchanged since. @param contact [in] of a body's move, or filled in
 * from a dsw_sweep: all members but time, from, to, vertex, face, tag and history count; `edge` is null or not. The place of a contact
 * by DSW_SEARCH_BISECTION is approximate, and so is an opinion on it.
 * @param opinion [out]
 * @return DSW_STATUS_OK also without an opinion. DSW_STATUS_NOT_BUILT without libccd, STALE_ID, NON_FINITE, NOT_FOUND (`front` is not
 * at `wall`, as it is but for DSW_CONTACT_VERTEX), OUT_OF_RANGE (the normal is not unit), UNSUPPORTED (kinds).
 * @note O(vertices of the volume, or volumes round the edge). libccd's own memory is the C runtime's. Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_contact_check(const dsw_environment *environment, const dsw_contact *contact,
                                     dsw_contact_opinion *opinion);

#ifdef __cplusplus
}
#endif

#endif
