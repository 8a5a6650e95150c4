/** @file base.h
 * Export macro, version, statuses, last error message, and what holds for all headers.
 *
 * Results:
 *  - Lengths are in scene units. A time of contact is a fraction in [0,1] of one move.
 *  - Exact arithmetic decides every sign, for all finite doubles. Simulation of Simplicity (H.
 *    Edelsbrunner, E. P. Muecke, ACM Transactions on Graphics 9, 1990) decides ties: "the shift"
 *    moves all points but the environment's vertices by (e, e^2, e^3), with an infinitesimal e > 0.
 *    More: bindings/docs/exactness.md.
 *  - A thing is free if it meets nothing impassable. A wall is an impassable face.
 *  - A geometric outcome (no contact, stopped, outside) is never a status.
 *  - A call that fails changes nothing, unless its comment says otherwise.
 *  - A function costs O(1) and is of version 2.0, unless its comment says otherwise; n counts the
 *    cells of the environment. [JCD10]: T. Jund, D. Cazier, J.-F. Dufourd, "Edge collision
 *    detection in complex deformable environments", 2010.
 *
 * Statuses that any function can answer, and that comments do not list: DSW_STATUS_NULL_ARGUMENT,
 * BAD_STRUCT_SIZE, OUT_OF_RANGE, NON_FINITE, WRONG_SIZE, STALE_ID, BUFFER_TOO_SMALL, OUT_OF_MEMORY,
 * INTERNAL; NOT_ENABLED: the scene lacks a feature that the comment names; UNSUPPORTED: an unknown
 * flag or enum value, a `reserved` member that is not 0, or no function of the plane (dartsweep.h).
 *
 * Arguments:
 *  - A pointer is used during the call only, unless a comment says "retained". It must not be null,
 *    unless a comment says "may be null". These may be: `context` and `options` (null: the
 *    defaults), `hints`, `starts`, `location`, `locations`, `missing`, `offender`, `row_count`, and
 *    outside of record.h `report` and `reports`.
 *  - A created object belongs to the caller until its `_destroy` function, which accepts null.
 *  - `point`, `points`, `position`, `positions`, `from`, `to`, `target`, `targets`, `xyz`: a point
 *    is `dimension` finite doubles. `stride_bytes` (`point_stride_bytes`) from one to the next is a
 *    multiple of 8; 0 means no gaps.
 *  - A `const T **` result, and a pointer in a report, belongs to the object. It is valid until the
 *    next call that writes the environment or the scene of the object.
 *  - Arrays have `count` entries, or as many as the member `..._count` says. An array of unknown
 *    length has `capacity` entries, or `capacity_bytes` bytes; *count, or *size_bytes, is set to
 *    what is needed, also on BUFFER_TOO_SMALL. Capacity 0 only asks, and the array may be null.
 *  - A `hint` or `start`, also in an array, is a volume near the point, or the null id. `flags` are
 *    bits of the header's enum, or 0.
 *  - `struct_size`, set by the caller or an `_init` function, is the struct's sizeof, in an older
 *    or a newer version than the library's. Members that the caller's struct lacks count as 0;
 *    members that the library does not know must be 0 in a description, and are set to 0 in a
 *    report.
 *  - An `_init` function writes the defaults into at most `size` bytes, the struct's sizeof.
 *
 * Threads: a call writes what its signature has without const: an environment with its scene, a
 * scene, or another object. It reads the rest. Calls that only read an object may run side by side;
 * a call that writes it runs alone. "Thread: any": the call may run beside all others. A "batch"
 * uses the parallel-for of the context: results do not depend on threads, and the error message
 * names the first wrong entry.
 */
#ifndef DARTSWEEP_BASE_H
#define DARTSWEEP_BASE_H

#include <stddef.h>
#include <stdint.h>

/** Marks exported functions. Define DSW_STATIC to link statically on Windows. */
#if defined(_WIN32)
#if defined(DSW_BUILDING)
#define DSW_API __declspec(dllexport)
#elif defined(DSW_STATIC)
#define DSW_API
#else
#define DSW_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define DSW_API __attribute__((visibility("default")))
#else
#define DSW_API
#endif

#define DSW_VERSION_MAJOR 2 /**< dsw_version() gives those of the library. */
#define DSW_VERSION_MINOR 1 /**< Grows with additions. */
#define DSW_VERSION_PATCH 0 /**< Grows with corrections. */

#ifdef __cplusplus
extern "C" {
#endif

/** The result of a call. Values are stable; new ones are appended. */
typedef enum dsw_status {
  DSW_STATUS_OK = 0,            /**< Done. */
  DSW_STATUS_NULL_ARGUMENT = 1, /**< A pointer is null. */
  /** struct_size is too small. */
  DSW_STATUS_BAD_STRUCT_SIZE = 2,
  DSW_STATUS_UNSUPPORTED = 3, /**< Not supported. */
  /** A number is out of range. */
  DSW_STATUS_OUT_OF_RANGE = 4,
  DSW_STATUS_NON_FINITE = 5,          /**< A number is NaN or infinite. */
  DSW_STATUS_WRONG_SIZE = 6,          /**< A size, stride or offset is wrong. */
  DSW_STATUS_STALE_ID = 7,            /**< The object of the id is gone. */
  DSW_STATUS_BUFFER_TOO_SMALL = 8,    /**< `count` is the capacity that is needed. */
  DSW_STATUS_OUT_OF_MEMORY = 9,       /**< The allocator returned null. */
  DSW_STATUS_TOO_LARGE = 10,          /**< More cells or points than 2^28. */
  DSW_STATUS_INDEX_OUT_OF_RANGE = 11, /**< A cell names a point that is not there. */
  DSW_STATUS_BAD_CELL_TYPE = 12,      /**< A cell type is unknown. */
  /** A cell repeats points, or its faces form no sphere. */
  DSW_STATUS_BAD_CELL = 13,
  DSW_STATUS_INVERTED_CELL = 14, /**< A cell is inside out. */
  /** A cell is flat, folded, or no star of its centre. */
  DSW_STATUS_INVALID_CELL = 15,
  DSW_STATUS_DUPLICATE_CELL = 16,   /**< Two cells are on one side of a face. */
  DSW_STATUS_SHARED_FACE = 17,      /**< A face belongs to three cells or more. */
  DSW_STATUS_BOUNDARY_CROSSES = 18, /**< The outer boundary passes through itself. */
  DSW_STATUS_OUTSIDE = 19,          /**< The point lies in no cell. */
  DSW_STATUS_IMPASSABLE = 20,       /**< The point lies in an impassable volume. */
  DSW_STATUS_OCCUPIED = 21,         /**< A particle or body is in the way. */
  DSW_STATUS_IN_USE = 22,           /**< Another object uses it. */
  DSW_STATUS_SHARED = 23,           /**< Several scenes share it. */
  DSW_STATUS_DUPLICATE_ID = 24,     /**< An id occurs twice. */
  DSW_STATUS_NOT_FOUND = 25,        /**< What is asked for does not exist. */
  DSW_STATUS_TRUNCATED = 26,        /**< The bytes end early. */
  DSW_STATUS_CORRUPT = 27,          /**< The bytes are damaged. */
  DSW_STATUS_BAD_VERSION = 28,      /**< The format version is unknown. */
  /** The scene lacks the feature. */
  DSW_STATUS_NOT_ENABLED = 29,
  DSW_STATUS_NOT_BUILT = 30, /**< The library was built without it. */
  DSW_STATUS_INTERNAL = 31,  /**< A bug; please report the message. */
  /** These cells do not allow the change. */
  DSW_STATUS_BAD_TOPOLOGY = 32,
  DSW_STATUS_BORROWED = 33,        /**< The host's points have no room. */
  DSW_STATUS_WRITE_FAILED = 34,    /**< A recording was not written. */
  DSW_STATUS_NOT_CLOSED = 35,      /**< The body is no closed surface. */
  DSW_STATUS_REPEATED_VERTEX = 36, /**< A part of a body repeats a vertex. */
  DSW_STATUS_DUPLICATE_PART = 37,  /**< A body has a part twice. */
  DSW_STATUS_NOT_MANIFOLD = 38,    /**< A body would not be a manifold. */
  DSW_STATUS_NOT_ORIENTED = 39,    /**< Faces are turned against each other. */
  /** Parts of a mesh that lie on each other can't be sewn. @since 2.1 */
  DSW_STATUS_NOT_CONFORMING = 40,
  DSW_STATUS_FORCE_INT32 = 0x7fffffff
} dsw_status;

/** Returns the loaded library's version.
 * @return major * 1000000 + minor * 1000 + patch.
 * @note Thread: any. */
DSW_API uint32_t dsw_version(void);

/** Returns the name of a status, such as "DSW_STATUS_OUTSIDE".
 * @return static text; "unknown status" for other values.
 * @note Thread: any. */
DSW_API const char *dsw_status_string(dsw_status status);

/** Describes this thread's last failure: function, argument, index, value, accepted range.
 * @return text, empty before the first failure, valid until the next.
 * @note Thread: any. */
DSW_API const char *dsw_last_error_message(void);

#ifdef __cplusplus
}
#endif

#endif
