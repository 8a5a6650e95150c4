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

/** Flags of recordings. */
enum {
  /** After each call that was done also the checksum of all that is in the scene then and, where the call was one that changes it, of the environment,
   * as their snapshots have it: a replay compares the whole state, not only answers. O(scene) for each call, O(environment) for those. */
  DSW_RECORDING_STATES = 1,
  /** Kept in memory, for dsw_scene_write_bundle: no path and no function. Begun anew, O(environment), whenever its calls take more than 1 MiB
   * and twice the snapshots. */
  DSW_RECORDING_LATEST = 2,
  /** In dsw_replay_info: it was made by dsw_scene_write_bundle. Not for dsw_recording_desc. */
  DSW_RECORDING_BUNDLE = 4
};

/** Describes a recording. */
typedef struct dsw_recording_desc {
  uint32_t struct_size; /**< sizeof(dsw_recording_desc). */
  uint32_t flags;       /**< DSW_RECORDING_... */
  /** A file that is written anew, without a buffer: what a call has written is the system's at once and outlives the process, however it
   * ends. It is not synchronised with the disk: when the machine goes down what the system had not written yet is lost, and the
   * recording ends there. */
  const char *path;
  dsw_write_fn write; /**< Instead of `path`: where bytes go; retained until the recording ends. */
  void *user;         /**< Handed to `write`. */
} dsw_recording_desc;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_recording_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_recording_desc_init(dsw_recording_desc *desc, size_t size);

/** Begins to record a scene: writes snapshots of its environment and of what is in it; from now on each call that changes either is
 * written before it is made, and after it what came of it. Calls that are refused change nothing: they are not written, or as calls that
 * failed. Of a deformation those points are written that move. To record one call is to begin, call and end.
 * @param scene [in,out] @param desc [in] with a path or a function, or DSW_RECORDING_LATEST.
 * @return DSW_STATUS_NULL_ARGUMENT, BAD_STRUCT_SIZE, UNSUPPORTED (flags; more than one of path, function and LATEST), IN_USE (it is being
 * recorded), OUT_OF_MEMORY, WRITE_FAILED: nothing is recorded, though something may have been written.
 * @note O(environment). Each call then costs the writing of its arguments; a scene that is not recorded pays nothing. Thread: writer of the
 * environment. @since 1.0 */
DSW_API dsw_status dsw_scene_start_recording(dsw_scene *scene, const dsw_recording_desc *desc);

/** Ends it. A scene that is destroyed ends its recording, too, but its end has no status for what could not be written.
 * @param scene [in,out]
 * @return DSW_STATUS_WRITE_FAILED: something could not be written, and nothing was written after it; it has ended all the same. OK also
 * where nothing is recorded. @note Thread: writer. @since 1.0 */
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
  DSW_REPLAY_OUTCOME_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_replay_outcome;

/** One step of a replay. */
typedef struct dsw_replay_report {
  uint64_t call;              /**< Number of the call, from 0; at the end how many there were. */
  const char *function;       /**< Its name, static text; null at the end. */
  dsw_replay_outcome outcome; /**< See there. */
  dsw_status status;          /**< What it answered now. */
  uint32_t has_failed; /**< 1: the recorded one was not done, for want of memory or because of what was in the way. */
  uint32_t reserved;   /**< With DSW_REPLAY_DIFFERENT what differs, DSW_DIFFERS_...; else 0. */
} dsw_replay_report;

/** What differs in a step of a replay. */
enum {
  DSW_DIFFERS_STATUS = 1,  /**< One of both was done, the other one failed. */
  DSW_DIFFERS_RESULTS = 2, /**< What it answered. */
  DSW_DIFFERS_STATE = 4    /**< What is there after it; known with DSW_RECORDING_STATES. */
};

/** Opens a recording. The bytes are not trusted.
 * @param context [in] as for dsw_environment_create.
 * @param recording [in] any alignment; retained until the replay is destroyed. @param size_bytes [in] its size.
 * @param replay [out] owned by the caller.
 * @return DSW_STATUS_NULL_ARGUMENT, TRUNCATED (before the first call), BAD_VERSION, CORRUPT, OUT_OF_MEMORY.
 * @note O(environment). Thread: any. @since 1.0 */
DSW_API dsw_status dsw_replay_create(dsw_context *context, const void *recording, size_t size_bytes,
                                     dsw_replay **replay);

/** Destroys a replay with its scene and environment. @param replay [in] null is allowed. @return IN_USE: other scenes use the
 * environment. @note Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_replay_destroy(dsw_replay *replay);

/** The scene as it is after the last step; its environment is that of dsw_scene_get_environment. To look at, to save or to record the
 * next step alone; a replay of what somebody else has changed tells nothing.
 * @param replay [in] @param scene [out] owned by the replay.
 * @return DSW_STATUS_NULL_ARGUMENT. @note Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_replay_get_scene(const dsw_replay *replay, dsw_scene **scene);

/** Makes the next call.
 * @param replay [in,out] @param report [out] what it was, and whether it did the same.
 * @return DSW_STATUS_CORRUPT: the recording is damaged here, or has a call that this version does not know; no call was made. What the call
 * itself answered is in the report. @note Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_replay_step(dsw_replay *replay, dsw_replay_report *report);

/** Arguments of the next call as text, for people: names and values, of long arrays the first ones, of options their words beyond
 * struct_size in hexadecimal. Empty at the end.
 * @param replay [in,out] stays before that call. @param text [out] ends with 0 and is cut to `capacity`; may be null if that is 0.
 * @param capacity [in] bytes. @param size [out] bytes of all of it with its 0.
 * @return DSW_STATUS_NULL_ARGUMENT, CORRUPT. @note Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_replay_describe_next(dsw_replay *replay, char *text, size_t capacity, size_t *size);

/** Whether what a call did was right, by exact integers alone and against every obstacle: no filter, no walk, nothing remembered. */
typedef struct dsw_verdict {
  uint32_t struct_size; /**< [in] sizeof(dsw_verdict). */
  uint32_t is_right;    /**< 1: nothing that was looked at is wrong. */
  uint64_t places;      /**< Particles and vertices of bodies. */
  uint64_t lost;        /**< Of these: not in the passable volume in which they are said to be. */
  uint64_t edges;       /**< Of bodies, from DSW_LEVEL_EDGES on. */
  uint64_t crossing;    /**< Of these: meet something impassable. */
  uint64_t faces;       /**< Of bodies at DSW_LEVEL_FACES. */
  uint64_t pierced;     /**< Of these: meet something impassable. */
  /** Ways of particles and vertices that the call reported to be free, with what their edges swept from DSW_LEVEL_EDGES_SWEPT on. */
  uint64_t ways;
  uint64_t missed;   /**< Of these: meet something impassable. */
  uint64_t contacts; /**< First contacts with the environment, searched for exactly, that are found again. */
  uint64_t wrong;    /**< Of these: at another time than was reported. */
  /** Contacts and ways of the call that are not looked at: contacts with bodies, of faces, or not searched for exactly; ways of
   * bodies that a response gave or took vertices, and of walls; what looks wrong at a volume that is invalid (deform.h). */
  uint64_t not_judged;
  char text[128]; /**< What was found wrong first; empty if nothing. */
} dsw_verdict;

/** What is known of a recording that is made again. */
typedef struct dsw_replay_info {
  uint32_t struct_size; /**< [in] sizeof(dsw_replay_info). */
  uint32_t flags;       /**< Of the recording. */
  uint32_t version;     /**< dsw_version() of the library that made it. */
  uint32_t reserved;    /**< 0. */
  uint64_t calls;       /**< Made so far. */
  /** Of the recording, not read yet. At its end: of an entry that is not whole, the torn tail of what a dead process was writing. */
  uint64_t bytes_left;
  const char *note; /**< Of a bug report, known at its end: what the host has said, empty if nothing. */
  const dsw_verdict *
      verdict; /**< Likewise the verdict as it was then, null if there is none. Both are valid as long as the replay. */
} dsw_replay_info;

/** What is known of it now.
 * @param replay [in] @param info [out] struct_size set.
 * @return DSW_STATUS_NULL_ARGUMENT, BAD_STRUCT_SIZE. @note Thread: reader. @since 1.0 */
DSW_API dsw_status dsw_replay_get_info(const dsw_replay *replay, dsw_replay_info *info);

/** Makes the next call as dsw_replay_step does, and judges what it did and what is there then; at the end what is there.
 * @param replay, report [in,out] as for dsw_replay_step. @param verdict [out] struct_size set.
 * @return as dsw_replay_step; BAD_STRUCT_SIZE; OUT_OF_MEMORY: where `report->function` was set the call has been made all the same.
 * @note O(obstacles * what is judged), all but boxes near to each other passed over quickly. Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_replay_step_judged(dsw_replay *replay, dsw_replay_report *report, dsw_verdict *verdict);

/** Describes a bug report. */
typedef struct dsw_bundle_desc {
  uint32_t struct_size; /**< sizeof(dsw_bundle_desc). */
  uint32_t flags;       /**< 0. */
  const char *path;     /**< A file that is written anew. */
  dsw_write_fn write;   /**< Instead of `path`: where bytes go. */
  void *user;           /**< Handed to `write`. */
  const char *note;     /**< What is strange, in the host's words; may be null. */
} dsw_bundle_desc;

/** Writes the defaults and struct_size into at most `size` bytes.
 * @param desc [out] may be null. @param size [in] sizeof(dsw_bundle_desc). @note Thread: any. @since 1.0 */
DSW_API void dsw_bundle_desc_init(dsw_bundle_desc *desc, size_t size);

/** A bug report in one call: the scene as it was before its last recorded call, that call with its arguments and what came of it, the
 * host's note, and the exact verdict. It is a recording of one call: dsw_replay_create opens it, dsw_replay_step_judged comes to the same
 * verdict, and examples/replay prints and draws it. The scene has to be recorded, into a file that is still there or with
 * DSW_RECORDING_LATEST: what was recorded is made again up to that call. Of a scene that is not, or is recorded by a function of the host's,
 * the report is of what is there now, without a call. The scene stays as it is, and its recording goes on.
 * @param scene [in] @param desc [in] with a path or a function. @param verdict [out] struct_size set; may be null.
 * @return DSW_STATUS_NULL_ARGUMENT, BAD_STRUCT_SIZE, UNSUPPORTED (flags; both path and function), OUT_OF_MEMORY, WRITE_FAILED, NOT_FOUND
 * (the recording can't be read again), CORRUPT: it is damaged, or made again it ends in another state than the scene's: memory was written
 * over, the environment was changed behind the scene's back, or a defect. The report is written then all the same, as far as it went.
 * @note O(environment + recorded calls). Thread: writer of the environment. @since 1.0 */
DSW_API dsw_status dsw_scene_write_bundle(dsw_scene *scene, const dsw_bundle_desc *desc, dsw_verdict *verdict);

#ifdef __cplusplus
}
#endif

#endif
