// Who owns what. Objects (Environment, Scene, ...) share the states below. Every handle is
// destroyed once, and an environment after its scenes, in whatever order the objects go.
//
// Threads: as the C functions say, unless DARTSWEEP_LOCKS is defined before the first include, in
// all sources of a program. Then each call takes the lock that its C function asks for: a call on a
// scene holds the environment for reading, a call that changes the environment excludes all others.
#pragma once

#include <memory>
#ifdef DARTSWEEP_LOCKS
#include <mutex>
#include <shared_mutex>
#endif

#include "dartsweep/cpp/error.hpp"
#include "dartsweep/dartsweep.h"

namespace dartsweep {

#ifdef DARTSWEEP_LOCKS
// What a host has to do while a call waits, such as letting go of an interpreter's lock: a type,
// defined before this header.
#ifndef DSW_HOST_WAIT
struct NoWait {};
#define DSW_HOST_WAIT NoWait
#endif

class Mutex {
 public:
  void lock() {
    if (mutex_.try_lock()) return;
    [[maybe_unused]] DSW_HOST_WAIT wait;
    mutex_.lock();
  }
  void lock_shared() {
    if (mutex_.try_lock_shared()) return;
    [[maybe_unused]] DSW_HOST_WAIT wait;
    mutex_.lock_shared();
  }
  void unlock() { mutex_.unlock(); }
  void unlock_shared() { mutex_.unlock_shared(); }

 private:
  std::shared_mutex mutex_;
};
#else
struct Mutex {
  void lock() {}
  void lock_shared() {}
  void unlock() {}
  void unlock_shared() {}
};
#endif

class Writing {
 public:
  explicit Writing(Mutex &mutex) : mutex_(mutex) { mutex_.lock(); }
  ~Writing() { mutex_.unlock(); }
  Writing(const Writing &) = delete;
  Writing &operator=(const Writing &) = delete;

 private:
  Mutex &mutex_;
};

class Reading {
 public:
  explicit Reading(Mutex &mutex) : mutex_(mutex) { mutex_.lock_shared(); }
  ~Reading() { mutex_.unlock_shared(); }
  Reading(const Reading &) = delete;
  Reading &operator=(const Reading &) = delete;

 private:
  Mutex &mutex_;
};

/** Receives the lines of the log. Its exceptions are dropped: they must not reach the library. */
class LogSink {
 public:
  virtual ~LogSink() = default;
  virtual void write(int level, const char *text) = 0;
};

/** The C context. `sink` may be null; the sink must outlive all that is made with the context. */
class Context {
 public:
  explicit Context(std::uint32_t thread_count = 0, LogSink *sink = nullptr) {
    dsw_context_desc desc;
    dsw_context_desc_init(&desc, sizeof desc);
    desc.thread_count = thread_count;
    desc.user = sink;
    if (sink)
      desc.log = [](void *user, dsw_log_level level, const char *text) {
        try {
          static_cast<LogSink *>(user)->write(level, text);
        } catch (...) {
        }
      };
    dsw_context *context = nullptr;
    check(dsw_context_create(&desc, &context));
    state_.reset(context, [](dsw_context *gone) { dsw_context_destroy(gone); });
  }
#ifndef SWIG
  /** The context owns the sink. */
  Context(std::uint32_t thread_count, std::unique_ptr<LogSink> sink)
      : Context(thread_count, sink.get()) {
    state_.reset(state_.get(), [made = state_, kept = std::shared_ptr<LogSink>(std::move(sink))](
                                   dsw_context *) mutable {
      made.reset();  // before its sink
    });
  }
#endif
  const std::shared_ptr<dsw_context> &state() const { return state_; }

 private:
  std::shared_ptr<dsw_context> state_;
};

/** An environment goes when it is closed, or its last object is gone, and no scene is left. */
struct EnvironmentState {
  std::shared_ptr<dsw_context> context;
  std::shared_ptr<void> lent;  // the caller's array that the library reads points from
  dsw_environment *handle = nullptr;
  std::uint32_t dimension = 3;  // never changes
  std::size_t scenes = 0;
  bool closed = false;
  Mutex mutex;

  ~EnvironmentState() { dsw_environment_destroy(handle); }
  void destroy_if_unused() {
    if (!closed || scenes != 0) return;
    dsw_environment_destroy(handle);
    handle = nullptr;
    lent.reset();
  }
};

struct SceneState {
  std::shared_ptr<EnvironmentState> environment;
  dsw_scene *handle = nullptr;
  Mutex mutex;

  ~SceneState() { close(); }
  void close() {
    const Writing hold(environment->mutex);
    if (!handle) return;
    dsw_scene_destroy(handle);
    handle = nullptr;
    --environment->scenes;
    environment->destroy_if_unused();
  }
};

/** Locks of one call on a scene. */
class SceneReading {
 public:
  explicit SceneReading(SceneState &state)
      : outer_(state.environment->mutex), inner_(state.mutex), handle(state.handle) {
    if (!handle) throw Closed("the scene");
  }

 private:
  Reading outer_, inner_;

 public:
  dsw_scene *handle;
};

class SceneWriting {
 public:
  explicit SceneWriting(SceneState &state)
      : outer_(state.environment->mutex), inner_(state.mutex), handle(state.handle) {
    if (!handle) throw Closed("the scene");
  }

 private:
  Reading outer_;
  Writing inner_;

 public:
  dsw_scene *handle;
};

/** Lock of one call that writes a scene and its environment. */
class WholeWriting {
 public:
  explicit WholeWriting(SceneState &state)
      : outer_(state.environment->mutex), handle(state.handle) {
    if (!handle) throw Closed("the scene");
  }

 private:
  Writing outer_;

 public:
  dsw_scene *handle;
};

class EnvironmentReading {
 public:
  explicit EnvironmentReading(EnvironmentState &state) : hold_(state.mutex), handle(state.handle) {
    if (state.closed) throw Closed("the environment");
  }

 private:
  Reading hold_;

 public:
  dsw_environment *handle;
};

class EnvironmentWriting {
 public:
  explicit EnvironmentWriting(EnvironmentState &state) : hold_(state.mutex), handle(state.handle) {
    if (state.closed) throw Closed("the environment");
  }

 private:
  Writing hold_;

 public:
  dsw_environment *handle;
};

}  // namespace dartsweep
