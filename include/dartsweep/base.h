/** @file base.h
 * Export macro, version, status codes and the last error message. Includes nothing of Dartsweep.
 *
 * Conventions that hold for the whole interface:
 *  - Lengths are scene units, times of contact are fractions in [0,1] of one move.
 *  - Every fallible function returns a dsw_status. On failure its out-arguments are untouched and the
 *    objects it was given are unchanged, unless the function says otherwise.
 *  - Every required pointer and handle can answer DSW_STATUS_NULL_ARGUMENT, every handle DSW_STATUS_STALE_ID; they are listed
 *    where there is no other status.
 *  - A geometric outcome (no contact, stopped at a wall, outside) is never a status.
 *  - Pointers are borrowed for the call unless a parameter says "retained".
 *  - "Thread: reader" may run beside other readers of the same object; "Thread: writer" may not run
 *    beside anything else that uses the object.
 *  - A struct that begins with struct_size, set by the caller or by its _init function, is taken at any size from that of its first release
 *    on, so that programs and library need not be of one age. What a shorter one lacks counts as 0. Of a longer one, a description
 *    must be 0 where it is unknown (else DSW_STATUS_UNSUPPORTED), and a report is set to 0 there; no byte beyond is touched.
 */
#ifndef DARTSWEEP_BASE_H
#define DARTSWEEP_BASE_H

#include <stddef.h>
#include <stdint.h>

/** Marks what the library exports. A host that links it statically on Windows defines DSW_STATIC. */
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

#define DSW_VERSION_MAJOR 1 /**< Version of this header. dsw_version() tells that of the library at run time. */
#define DSW_VERSION_MINOR 1 /**< Grows with additions. */
#define DSW_VERSION_PATCH 0 /**< Grows with corrections. */

#ifdef __cplusplus
extern "C" {
#endif

/** What a call answers. Values are stable; new ones are only appended. */
typedef enum dsw_status {
  DSW_STATUS_OK = 0,                  /**< Done. */
  DSW_STATUS_NULL_ARGUMENT = 1,       /**< A required pointer or handle is null. */
  DSW_STATUS_BAD_STRUCT_SIZE = 2,     /**< struct_size is smaller than the first release's struct. */
  DSW_STATUS_UNSUPPORTED = 3,         /**< A value, flag or non-zero unknown member this library does not know. */
  DSW_STATUS_OUT_OF_RANGE = 4,        /**< An index or number lies outside the documented range. */
  DSW_STATUS_NON_FINITE = 5,          /**< A coordinate is NaN or infinite. */
  DSW_STATUS_WRONG_SIZE = 6,          /**< Sizes, strides or offsets contradict each other, or no array is so long. */
  DSW_STATUS_STALE_ID = 7,            /**< The id names nothing that is alive, or was never given out. */
  DSW_STATUS_BUFFER_TOO_SMALL = 8,    /**< The count argument was set to the capacity that is needed. */
  DSW_STATUS_OUT_OF_MEMORY = 9,       /**< The allocator returned null. */
  DSW_STATUS_TOO_LARGE = 10,          /**< More cells or points than 28-bit indices can name. */
  DSW_STATUS_INDEX_OUT_OF_RANGE = 11, /**< A cell names a point that does not exist. */
  DSW_STATUS_BAD_CELL_TYPE = 12,      /**< A cell type that is not 10, 12, 13, 14 or 42. */
  DSW_STATUS_BAD_CELL = 13,           /**< Repeated points in a cell, or faces that do not close a sphere. */
  DSW_STATUS_INVERTED_CELL = 14,      /**< A cell is turned inside out. */
  DSW_STATUS_INVALID_CELL = 15,       /**< A cell is flat, folded, or not seen whole from the mean of its vertices. */
  DSW_STATUS_DUPLICATE_CELL = 16,     /**< Two cells lie on the same side of one face. */
  DSW_STATUS_SHARED_FACE = 17,        /**< A face belongs to three cells or more. */
  DSW_STATUS_BOUNDARY_CROSSES = 18,   /**< The outer boundary passes through itself. */
  DSW_STATUS_OUTSIDE = 19,            /**< The point lies in no cell. */
  DSW_STATUS_IMPASSABLE = 20,         /**< The point lies in an impassable volume. */
  DSW_STATUS_OCCUPIED = 21,           /**< The change would make a cell impassable that something occupies. */
  DSW_STATUS_IN_USE = 22,             /**< Scenes (or other scenes) use the environment. */
  DSW_STATUS_SHARED = 23,             /**< Several scenes share the environment: it can't be changed. */
  DSW_STATUS_DUPLICATE_ID = 24,       /**< An id stands twice in a batch. */
  DSW_STATUS_NOT_FOUND = 25,          /**< No cell has these vertices. */
  DSW_STATUS_TRUNCATED = 26,          /**< The snapshot block ends early. */
  DSW_STATUS_CORRUPT = 27,            /**< The snapshot block is damaged. */
  DSW_STATUS_BAD_VERSION = 28,        /**< The snapshot block was written by an unknown format version. */
  DSW_STATUS_NOT_NAMED = 29,          /**< The scene did not name the feature that this call needs. */
  DSW_STATUS_NOT_BUILT = 30,          /**< The library was built without this part. */
  DSW_STATUS_INTERNAL = 31,           /**< A defect of the library; please report the message. */
  DSW_STATUS_BAD_TOPOLOGY = 32,       /**< The cells are not arranged as the change needs them; the message says how. */
  DSW_STATUS_BORROWED = 33,           /**< The points are the host's, without room for another vertex. */
  DSW_STATUS_WRITE_FAILED = 34,       /**< A recording could not be written. */
  DSW_STATUS_NOT_CLOSED = 35,         /**< The body is not a closed surface. */
  DSW_STATUS_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_status;

/** One point or direction, scene units. */
typedef struct dsw_vec3 {
  double x; /**< First coordinate. */
  double y; /**< Second. */
  double z; /**< Third. */
} dsw_vec3;

/** Version of the loaded library.
 * @return major * 1000000 + minor * 1000 + patch. @note Thread: any. @since 1.0 */
DSW_API uint32_t dsw_version(void);

/** Name of a status, for example "DSW_STATUS_OUTSIDE".
 * @param status [in] any value; unknown ones give "unknown status".
 * @return static text, never null. @note Thread: any. @since 1.0 */
DSW_API const char *dsw_status_string(dsw_status status);

/** What went wrong in the last call on this thread that did not return DSW_STATUS_OK: function, argument,
 * index, value received, range accepted.
 * @return text owned by the library, valid until the next dsw call on this thread that fails; empty if
 * none has failed yet. Never null.
 * @note Thread: each thread has its own message. @since 1.0 */
DSW_API const char *dsw_last_error_message(void);

#ifdef __cplusplus
}
#endif

#endif
