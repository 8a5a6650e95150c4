/** @file context.h
 * What a host may supply: memory, a log, a parallel-for. A context is optional: null, wherever a context is
 * asked for, means malloc, no log, and threads of the library's own (one per processor, for batches only).
 */
#ifndef DARTSWEEP_CONTEXT_H
#define DARTSWEEP_CONTEXT_H

#include "dartsweep/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Opaque. Owned by the caller from dsw_context_create to dsw_context_destroy. */
typedef struct dsw_context dsw_context;

/** Returns memory of `size_bytes` (never 0), aligned to `alignment_bytes` (a power of two, at most 64), or null.
 * Called on the thread of the dsw call, or on a worker of its parallel-for; must not call dsw functions. */
typedef void *(*dsw_allocate_fn)(void *user, size_t size_bytes, size_t alignment_bytes);

/** Takes back what dsw_allocate_fn returned, with the same sizes. Never called with null. */
typedef void (*dsw_release_fn)(void *user, void *memory, size_t size_bytes, size_t alignment_bytes);

/** Weight of a log line. */
typedef enum dsw_log_level {
  DSW_LOG_NONE = 0,                /**< No line. */
  DSW_LOG_ERROR = 1,               /**< Something went wrong. */
  DSW_LOG_WARNING = 2,             /**< Something that a host may want to change. */
  DSW_LOG_INFO = 3,                /**< What was done. */
  DSW_LOG_FORCE_INT32 = 0x7fffffff /**< No value: makes the type 32 bits wide. */
} dsw_log_level;

/** Receives one line of text, valid during the call, on the thread of the dsw call. No lock is held; it must
 * not call dsw functions. */
typedef void (*dsw_log_fn)(void *user, dsw_log_level level, const char *text);

/** One piece of work: handles task number `task`. Never throws. */
typedef void (*dsw_task_fn)(void *task_data, size_t task);

/** Runs task(task_data, i) once for every i in 0 .. task_count-1, in any order, on any threads, and returns
 * when all are done. Results do not depend on order or threads. */
typedef void (*dsw_parallel_for_fn)(void *user, dsw_task_fn task, void *task_data, size_t task_count);

/** Describes a context. Fill with dsw_context_desc_init, then set what you need. */
typedef struct dsw_context_desc {
  uint32_t struct_size;             /**< sizeof(dsw_context_desc). */
  uint32_t thread_count;            /**< Threads of the built-in parallel-for, 1 .. 256; 0: one per processor. */
  void *user;                       /**< Handed to every callback. */
  dsw_allocate_fn allocate;         /**< Null: the C++ runtime's. Set both or none. */
  dsw_release_fn release;           /**< See allocate. */
  dsw_log_fn log;                   /**< Null: no log. */
  dsw_parallel_for_fn parallel_for; /**< Null: the built-in one. */
} dsw_context_desc;

/** Writes the defaults into at most `size` bytes of `desc` and sets struct_size.
 * @param desc [out] may be null (nothing happens). @param size [in] sizeof(dsw_context_desc).
 * @note Thread: any. @since 1.0 */
DSW_API void dsw_context_desc_init(dsw_context_desc *desc, size_t size);

/** Creates a context.
 * @param desc [in] null: all defaults. Callbacks are retained until the context is destroyed.
 * @param context [out] owned by the caller.
 * @return DSW_STATUS_NULL_ARGUMENT, DSW_STATUS_BAD_STRUCT_SIZE, DSW_STATUS_UNSUPPORTED, DSW_STATUS_OUT_OF_RANGE
 * (thread_count, or one of allocate and release without the other), DSW_STATUS_OUT_OF_MEMORY.
 * @note Thread: any; contexts are independent of each other. @since 1.0 */
DSW_API dsw_status dsw_context_create(const dsw_context_desc *desc, dsw_context **context);

/** Destroys a context. Environments and scenes made with it must be gone.
 * @param context [in] null is allowed.
 * @return DSW_STATUS_IN_USE, and nothing happens, while environments made with it live.
 * @note Thread: writer. @since 1.0 */
DSW_API dsw_status dsw_context_destroy(dsw_context *context);

#ifdef __cplusplus
}
#endif

#endif
