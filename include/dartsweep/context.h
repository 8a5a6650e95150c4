/** @file context.h
 * A context: memory, log and parallel-for of the host. It must outlive its objects. Callbacks must
 * not call dsw functions. They run in the default mode of floating-point arithmetic, whatever the
 * mode of the host's thread, and must leave it. More: bindings/docs/exactness.md.
 */
#ifndef DARTSWEEP_CONTEXT_H
#define DARTSWEEP_CONTEXT_H

#include "dartsweep/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Opaque. */
typedef struct dsw_context dsw_context;

/** Returns `size_bytes` (never 0) of memory aligned to `alignment_bytes` (a power of two up to 64),
 * or null, on the thread of the dsw call or of the parallel-for. */
typedef void *(*dsw_allocate_fn)(void *user, size_t size_bytes, size_t alignment_bytes);

/** Releases memory (never null) from dsw_allocate_fn, with the same sizes. */
typedef void (*dsw_release_fn)(void *user, void *memory, size_t size_bytes, size_t alignment_bytes);

/** Severity of a log line. */
typedef enum dsw_log_level {
  DSW_LOG_NONE = 0,    /**< No line. */
  DSW_LOG_ERROR = 1,   /**< Something went wrong. */
  DSW_LOG_WARNING = 2, /**< A host may want to change something. */
  DSW_LOG_INFO = 3,    /**< Progress. */
  DSW_LOG_FORCE_INT32 = 0x7fffffff
} dsw_log_level;

/** Receives one line, valid during the call, on the thread of the dsw call. No lock is held. */
typedef void (*dsw_log_fn)(void *user, dsw_log_level level, const char *text);

/** Does task number `task`; never throws. */
typedef void (*dsw_task_fn)(void *task_data, size_t task);

/** Runs task(task_data, i) once for each i below task_count, in any order and threads; returns when
 * all are done. */
typedef void (*dsw_parallel_for_fn)(void *user, dsw_task_fn task, void *task_data,
                                    size_t task_count);

/** What computes casts in space, always with the same bits.
 * @note The environment variable DARTSWEEP_KERNEL replaces FASTEST if it names a kernel of the
 * processor: "portable", "avx2" or "avx512". All else then uses no newer instructions. */
typedef enum dsw_kernel {
  /** The fastest on this processor for each kind of volume; the first environment that has the kind
   * measures it, in about 0.3 ms. */
  DSW_KERNEL_FASTEST = 0,
  DSW_KERNEL_PORTABLE = 1, /**< For every processor. */
  DSW_KERNEL_AVX2 = 2,     /**< x86-64 with AVX2. */
  DSW_KERNEL_AVX512 = 3,   /**< x86-64 with AVX-512 F, DQ and VL. */
  DSW_KERNEL_FORCE_INT32 = 0x7fffffff
} dsw_kernel;

/** Describes a context. */
typedef struct dsw_context_desc {
  uint32_t struct_size;
  /** Threads of the built-in parallel-for: 1 .. 256; 0: one per processor. Large
   * environments are created with it, and their search structures made and fitted. */
  uint32_t thread_count;
  void *user;                       /**< First argument of callbacks. */
  dsw_allocate_fn allocate;         /**< Null: the C++ runtime's; with release. */
  dsw_release_fn release;           /**< See `allocate`. */
  dsw_log_fn log;                   /**< Null: no log. */
  dsw_parallel_for_fn parallel_for; /**< Null: built in. */
  uint32_t kernel;                  /**< dsw_kernel. @since 2.1 */
  uint32_t reserved;
} dsw_context_desc;

DSW_API void dsw_context_desc_init(dsw_context_desc *desc, size_t size);

/** Creates a context.
 * @param desc null: the defaults. Callbacks are retained.
 * @return DSW_STATUS_OUT_OF_RANGE: also only one of allocate and release; UNSUPPORTED: also a
 * kernel that is not there.
 * @note Thread: any. */
DSW_API dsw_status dsw_context_create(const dsw_context_desc *desc, dsw_context **context);

/** Destroys a context.
 * @return DSW_STATUS_IN_USE: its objects exist. */
DSW_API dsw_status dsw_context_destroy(dsw_context *context);

#ifdef __cplusplus
}
#endif

#endif
