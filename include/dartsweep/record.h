/** @file record.h
 * Recordings: a scene writes each call that changes it before the call is made, and a replay makes
 * the calls again, with the same bits. A bug report is a recording of one call with a validation.
 * More: bindings/docs/bug_reports.md.
 */
#ifndef DARTSWEEP_RECORD_H
#define DARTSWEEP_RECORD_H

#include "dartsweep/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Takes the next bytes, without calling dsw functions. Returns 0; anything else ends the
 * recording. */
typedef int (*dsw_write_fn)(void *user, const void *bytes, size_t size_bytes);

/** Flags of recordings. */
enum {
  /** Adds a checksum of the state after each call. */
  DSW_RECORDING_STATES = 1,
  /** Keeps the latest calls in memory, for dsw_scene_write_bug_report. */
  DSW_RECORDING_LATEST = 2,
  /** Only in dsw_replay_info. */
  DSW_RECORDING_BUG_REPORT = 4
};

/** Describes a recording. */
typedef struct dsw_recording_desc {
  uint32_t struct_size;
  uint32_t flags;
  /** A file, replaced; calls outlive the process. */
  const char *path;
  dsw_write_fn write; /**< Instead of `path`; retained until the recording ends. */
  void *user;         /**< Passed to `write`. */
} dsw_recording_desc;

DSW_API void dsw_recording_desc_init(dsw_recording_desc *desc, size_t size);

/** Begins to record a scene: snapshots, then calls and results.
 * @return DSW_STATUS_IN_USE: a recording is under way; UNSUPPORTED: two of `path`, `write`,
 * DSW_RECORDING_LATEST; WRITE_FAILED.
 * @note Cost: O(environment), then O(arguments) a call. Thread: writer of the environment. */
DSW_API dsw_status dsw_scene_start_recording(dsw_scene *scene, const dsw_recording_desc *desc);

/** Ends the recording of a scene.
 * @return DSW_STATUS_WRITE_FAILED: it is incomplete. */
DSW_API dsw_status dsw_scene_stop_recording(dsw_scene *scene);

/** Opaque. A recording whose calls are made again. */
typedef struct dsw_replay dsw_replay;

/** What a step of a replay shows. */
typedef enum dsw_replay_outcome {
  DSW_REPLAY_SAME = 0,      /**< The call did what was recorded. */
  DSW_REPLAY_DIFFERENT = 1, /**< The call did something else. */
  /** The recording process died in the call. */
  DSW_REPLAY_UNFINISHED = 2,
  DSW_REPLAY_END = 3, /**< There is no further call. */
  DSW_REPLAY_OUTCOME_FORCE_INT32 = 0x7fffffff
} dsw_replay_outcome;

/** One step of a replay: the number of the `call` (from 0), its `status` now, and the `outcome`. */
typedef struct dsw_replay_report {
  uint64_t call;
  const char *function; /**< Its name, static; null at the end. */
  dsw_replay_outcome outcome;
  dsw_status status;
  uint32_t has_failed; /**< 1: the recorded one failed. */
  uint32_t differs;    /**< DSW_DIFFERS_... if DIFFERENT; else 0. */
} dsw_replay_report;

/** What differs in a step. */
enum {
  DSW_DIFFERS_STATUS = 1,  /**< Whether the call succeeded. */
  DSW_DIFFERS_RESULTS = 2, /**< The results. */
  DSW_DIFFERS_STATE = 4    /**< The state; needs DSW_RECORDING_STATES. */
};

/** Opens a recording, whose bytes are not trusted.
 * @param context retained.
 * @param recording `size_bytes`, retained until the replay is destroyed.
 * @return DSW_STATUS_TRUNCATED, BAD_VERSION, CORRUPT.
 * @note Cost: O(environment). Thread: any. */
DSW_API dsw_status dsw_replay_create(dsw_context *context, const void *recording, size_t size_bytes,
                                     dsw_replay **replay);

/** Destroys a replay with its scene and environment.
 * @return DSW_STATUS_IN_USE: other scenes use it.
 * @note Cost: O(its size). */
DSW_API dsw_status dsw_replay_destroy(dsw_replay *replay);

/** Gives the scene after the last step: the replay's, which the host must not change. */
DSW_API dsw_status dsw_replay_get_scene(const dsw_replay *replay, dsw_scene **scene);

/** Makes the next call.
 * @return DSW_STATUS_CORRUPT: damaged, or of a later version; no call was made.
 * @note Cost: that of the call. */
DSW_API dsw_status dsw_replay_step(dsw_replay *replay, dsw_replay_report *report);

/** Describes the arguments of the next call in words.
 * @param text cut to `capacity`, ends with 0.
 * @param size of the whole text.
 * @return DSW_STATUS_CORRUPT: as dsw_replay_step.
 * @note Cost: O(arguments). */
DSW_API dsw_status dsw_replay_describe_next(dsw_replay *replay, char *text, size_t capacity,
                                            size_t *size);

/** A validation of a call's result, by exact integers and against every obstacle: how many `places`
 * (particles and vertices of bodies) are `lost` outside of their volumes; how many `edges` (from
 * DSW_LEVEL_EDGES on, without dsw_body_get_untested_edges) are `crossing`, `faces` (at
 * DSW_LEVEL_FACES) are `pierced` and `ways`
 * (reported free, from DSW_LEVEL_EDGES_SWEPT on with what edges swept) are `missed`, so not free;
 * how many first `contacts` with the environment have a `wrong` time. */
typedef struct dsw_validation {
  uint32_t struct_size;
  uint32_t is_right; /**< 1: nothing is wrong. */
  uint64_t places;
  uint64_t lost;
  uint64_t edges;
  uint64_t crossing;
  uint64_t faces;
  uint64_t pierced;
  uint64_t ways;
  uint64_t missed;
  uint64_t contacts;
  uint64_t wrong;
  uint64_t not_validated; /**< Contacts and ways left out. */
  char text[128];         /**< The first error, or empty. */
} dsw_validation;

/** What is known of a recording. */
typedef struct dsw_replay_info {
  uint32_t struct_size;
  uint32_t flags;   /**< Flags of the recording. */
  uint32_t version; /**< dsw_version() of the recording library. */
  uint32_t reserved;
  uint64_t calls; /**< Calls made. */
  /** Bytes not yet read; at the end, of an incomplete entry. */
  uint64_t bytes_left;
  /** The host's note; null before the end of a bug report. */
  const char *note;
  /** Null before the end of a bug report. */
  const dsw_validation *validation;
} dsw_replay_info;

/** Gives what is known of the recording. */
DSW_API dsw_status dsw_replay_get_info(const dsw_replay *replay, dsw_replay_info *info);

/** Makes the next call and validates its results and the state.
 * @return as dsw_replay_step; after OUT_OF_MEMORY a call was made if `report->function` is set.
 * @note Cost: O(obstacles * parts validated). */
DSW_API dsw_status dsw_replay_step_validated(dsw_replay *replay, dsw_replay_report *report,
                                             dsw_validation *validation);

/** Describes a bug report; `path`, `write` and `user` as in dsw_recording_desc. */
typedef struct dsw_bug_report_desc {
  uint32_t struct_size;
  uint32_t flags;
  const char *path;
  dsw_write_fn write;
  void *user;
  const char *note; /**< Words of the host; may be null. */
} dsw_bug_report_desc;

DSW_API void dsw_bug_report_desc_init(dsw_bug_report_desc *desc, size_t size);

/** Writes a bug report: the scene before its last recorded call, the call, its results, the note,
 * and a validation; without a recording in a file or in memory, no call.
 * @param validation may be null.
 * @return DSW_STATUS_WRITE_FAILED; NOT_FOUND: the recording cannot be read; CORRUPT: the replay
 * ends early or in another state, and the report there.
 * @note Cost: O(environment + recorded calls). Thread: writer of the environment. */
DSW_API dsw_status dsw_scene_write_bug_report(dsw_scene *scene, const dsw_bug_report_desc *desc,
                                              dsw_validation *validation);

#ifdef __cplusplus
}
#endif

#endif
