/** @file record.h
 * Recordings: every call that changes a scene, written as it is made, and made again. For the bug that shows once in an hour: what was
 * written before the process died can be replayed, call by call, with the same bits.
 */
#ifndef DARTSWEEP_RECORD_H
#define DARTSWEEP_RECORD_H

#include "dartsweep/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Takes bytes of a recording, in their order. Returns 0; anything else ends the recording. Called on the thread of the dsw call; must
 * not call dsw functions. */
typedef int (*dsw_write_fn)(void *user, const void *bytes, size_t size_bytes);

/** Describes a recording. */
typedef struct dsw_recording_desc {
  uint32_t struct_size; /**< sizeof(dsw_recording_desc). */
  uint32_t flags;       /**< 0. */
  const char *path; /**< A file that is written anew, without a buffer: what a call has written outlives the process. */
  dsw_write_fn write; /**< Instead of `path`: where bytes go; retained until the recording ends. */
  void *user;         /**< Handed to `write`. */
} dsw_recording_desc;

/** Writes the defaults and struct_size into at most `size` bytes. @param desc [out] may be null. @note Thread: any. @since 0.1 */
DSW_API void dsw_recording_desc_init(dsw_recording_desc *desc, size_t size);

/** Begins to record a scene: writes snapshots of its environment and of what is in it; from now on each call that changes either is
 * written before it is made, and after it what came of it. Calls that are refused change nothing: they are not written, or as calls that
 * failed. Of a deformation those points are written that move. To record one call is to begin, call and end.
 * @param desc [in] with a path or a function.
 * @return DSW_STATUS_NULL_ARGUMENT, BAD_STRUCT_SIZE, UNSUPPORTED (flags; both path and function), IN_USE (it is being recorded), OUT_OF_MEMORY,
 * WRITE_FAILED: nothing is recorded, though something may have been written.
 * @note O(environment). Each call then costs the writing of its arguments; a scene that is not recorded pays nothing. Thread: writer of the
 * environment. @since 0.1 */
DSW_API dsw_status dsw_scene_start_recording(dsw_scene *scene, const dsw_recording_desc *desc);

/** Ends it. A scene that is destroyed ends its recording, too.
 * @return DSW_STATUS_WRITE_FAILED: something could not be written, and nothing was written after it; it has ended all the same. OK also
 * where nothing is recorded. @note Thread: writer. @since 0.1 */
DSW_API dsw_status dsw_scene_stop_recording(dsw_scene *scene);

/** Opaque. A recording that is made again, with an environment and a scene of its own. Owned by the caller from dsw_replay_create to
 * dsw_replay_destroy. */
typedef struct dsw_replay dsw_replay;

/** What a step of a replay has shown. */
typedef enum dsw_replay_outcome {
  DSW_REPLAY_SAME = 0,      /**< The call did what was recorded, as far as its digest tells. */
  DSW_REPLAY_DIFFERENT = 1, /**< It did something else: another version, other hardware limits, or a defect. */
  DSW_REPLAY_UNFINISHED =
      2,              /**< What came of it was not recorded: the process died in it. It was made here all the same. */
  DSW_REPLAY_END = 3, /**< There is no further call. */
  DSW_REPLAY_OUTCOME_FORCE_INT32 = 0x7fffffff
} dsw_replay_outcome;

/** One step of a replay. */
typedef struct dsw_replay_report {
  uint64_t call;              /**< Number of the call, from 0; at the end how many there were. */
  const char *function;       /**< Its name, static text; null at the end. */
  dsw_replay_outcome outcome; /**< See there. */
  dsw_status status;          /**< What it answered now. */
  uint32_t has_failed; /**< 1: the recorded one was not done, for want of memory or because of what was in the way. */
  uint32_t reserved;   /**< 0. */
} dsw_replay_report;

/** Opens a recording. The bytes are not trusted.
 * @param context [in] as for dsw_environment_create. @param recording [in] any alignment; retained until the replay is destroyed.
 * @param replay [out] owned by the caller.
 * @return DSW_STATUS_NULL_ARGUMENT, TRUNCATED (before the first call), BAD_VERSION, CORRUPT, OUT_OF_MEMORY.
 * @note O(environment). Thread: any. @since 0.1 */
DSW_API dsw_status dsw_replay_create(dsw_context *context, const void *recording, size_t size_bytes,
                                     dsw_replay **replay);

/** Destroys a replay with its scene and environment. @param replay [in] null is allowed. @return IN_USE: other scenes use the
 * environment. @note Thread: writer. @since 0.1 */
DSW_API dsw_status dsw_replay_destroy(dsw_replay *replay);

/** The scene as it is after the last step; its environment is that of dsw_scene_get_environment. To look at, to save or to record the
 * next step alone; a replay of what somebody else has changed tells nothing. @param scene [out] owned by the replay. @note Thread: reader.
 * @since 0.1 */
DSW_API dsw_status dsw_replay_get_scene(const dsw_replay *replay, dsw_scene **scene);

/** Makes the next call. @param report [out] what it was, and whether it did the same.
 * @return DSW_STATUS_CORRUPT: the recording is damaged here, or has a call that this version does not know; no call was made. What the call
 * itself answered is in the report. @note Thread: writer. @since 0.1 */
DSW_API dsw_status dsw_replay_step(dsw_replay *replay, dsw_replay_report *report);

#ifdef __cplusplus
}
#endif

#endif
