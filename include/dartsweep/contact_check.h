/** @file contact_check.h
 * A cross-check of contact normals by libccd, an optional part of the library. More:
 * bindings/docs/contacts.md.
 */
#ifndef DARTSWEEP_CONTACT_CHECK_H
#define DARTSWEEP_CONTACT_CHECK_H

#include "dartsweep/contact.h"
#include "dartsweep/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What libccd compared. */
typedef enum dsw_opinion {
  DSW_OPINION_NONE = 0,   /**< Nothing, see `reason`. */
  DSW_OPINION_PLANE = 1,  /**< Touching point and volume behind the wall. */
  DSW_OPINION_EDGE = 2,   /**< Touching segment and tetrahedron at the wall's edge or diagonal. */
  DSW_OPINION_VERTEX = 3, /**< Touching triangle and volume at the wall's corner. */
  DSW_OPINION_FORCE_INT32 = 0x7fffffff /**< No value. */
} dsw_opinion;

/** Why there is no cross-check. */
typedef enum dsw_no_opinion {
  DSW_NO_OPINION_NONE = 0,          /**< There is one. */
  DSW_NO_OPINION_WIRE = 1,          /**< A marked edge or vertex has no volume. */
  DSW_NO_OPINION_PARALLEL = 2,      /**< The edges are almost parallel. */
  DSW_NO_OPINION_OUTSIDE_CONE = 3,  /**< The wall rises above the plane across the normal. */
  DSW_NO_OPINION_NOT_CONVERGED = 4, /**< libccd found no way out of this contact. */
  DSW_NO_OPINION_NOT_UNIQUE = 5,    /**< Both normals are right, at the border of a feature. */
  DSW_NO_OPINION_FORCE_INT32 = 0x7fffffff /**< No value. */
} dsw_no_opinion;

/** Result of a cross-check. */
typedef struct dsw_contact_opinion {
  double normal[3];      /**< libccd's unit normal, out of the obstacle. */
  double depth;          /**< Penetration measured by libccd. */
  double pushed_in;      /**< Penetration made for the test. */
  double angle_rad;      /**< Angle between the normals. */
  dsw_opinion opinion;   /**< What was compared. */
  dsw_no_opinion reason; /**< Why there is no cross-check. */
} dsw_contact_opinion;

/** Computes the normal of a contact a second time with libccd.
 * @param contact `time`, `from`, `to`, `vertex`, `face`, `tag` and `history` do not count; `edge`
 * only has to be null or not.
 * @return DSW_STATUS_NOT_BUILT; NOT_FOUND: `front` is not at `wall`.
 * @note Cost: O(vertices of the volume, or volumes round the edge). Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_contact_check(const dsw_environment *environment, const dsw_contact *contact,
                                     dsw_contact_opinion *opinion);

#ifdef __cplusplus
}
#endif

#endif
