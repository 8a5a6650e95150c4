/** @file cross_check.h
 * A cross-check of contact normals by libccd, an optional part of the library. More:
 * bindings/docs/contacts.md.
 */
#ifndef DARTSWEEP_CROSS_CHECK_H
#define DARTSWEEP_CROSS_CHECK_H

#include "dartsweep/contact.h"
#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What libccd compared. */
typedef enum dsw_cross_check_kind {
  DSW_CROSS_CHECK_NONE = 0,   /**< Nothing, see `reason`. */
  DSW_CROSS_CHECK_PLANE = 1,  /**< Touching point and volume behind the wall. */
  DSW_CROSS_CHECK_EDGE = 2,   /**< Touching segment and tetrahedron at the wall. */
  DSW_CROSS_CHECK_VERTEX = 3, /**< Touching triangle and volume at the corner. */
  DSW_CROSS_CHECK_FORCE_INT32 = 0x7fffffff
} dsw_cross_check_kind;

/** Why there is no cross-check. */
typedef enum dsw_no_cross_check {
  DSW_NO_CROSS_CHECK_NONE = 0,          /**< There is one. */
  DSW_NO_CROSS_CHECK_MARKED = 1,        /**< A marked cell has no volume. */
  DSW_NO_CROSS_CHECK_PARALLEL = 2,      /**< The edges are almost parallel. */
  DSW_NO_CROSS_CHECK_OUTSIDE_CONE = 3,  /**< The wall rises above the normal's plane. */
  DSW_NO_CROSS_CHECK_NOT_CONVERGED = 4, /**< libccd found no way out. */
  DSW_NO_CROSS_CHECK_NOT_UNIQUE = 5,    /**< Both normals are right, at a border. */
  DSW_NO_CROSS_CHECK_FORCE_INT32 = 0x7fffffff
} dsw_no_cross_check;

/** Result of a cross-check, of a `kind`, or the `reason` why there is none. */
typedef struct dsw_cross_check {
  double normal[3]; /**< libccd's unit normal, out of the obstacle. */
  double depth;     /**< Penetration measured by libccd. */
  double pushed_in; /**< Penetration made for the test. */
  double angle_rad; /**< Angle between the normals. */
  dsw_cross_check_kind kind;
  dsw_no_cross_check reason;
} dsw_cross_check;

/** Computes the normal of a contact a second time with libccd.
 * @param contact read are `point`, `position`, `fixed`, `contact`, and whether `edge` is null.
 * @return DSW_STATUS_NOT_BUILT; NOT_FOUND: `front` is not at `wall`.
 * @note Cost: O(vertices of the volume, or volumes round the edge). */
DSW_API dsw_status dsw_environment_cross_check(const dsw_environment *environment,
                                               const dsw_body_contact *contact,
                                               dsw_cross_check *result);

#ifdef __cplusplus
}
#endif

#endif
