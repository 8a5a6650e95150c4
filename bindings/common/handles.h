// Who owns what, and who may call at the same time. Host objects (Environment, Scene, ...) share these states, so that
// every handle is destroyed exactly once, in the right order, whatever the order in which a collector lets go.
//
// The header says of each call whether it reads or writes; here that becomes locks, so that a host's threads may call as they like.
// Calls on a scene hold its environment for reading, or for writing where they change it; that excludes all its scenes.
#pragma once

#include <memory>
#include <mutex>
#include <shared_mutex>

#include "common/error.h"
#include "dartsweep/dartsweep.h"

namespace dartsweep {

// What a host has to do round a wait, such as letting go of an interpreter's lock: a callback of whoever is waited for may need it.
// A binding that needs it defines DSW_HOST_WAIT as a type of its own before this header.
#ifndef DSW_HOST_WAIT
struct NoWait {};
#define DSW_HOST_WAIT NoWait
#endif

inline void lock(std::shared_mutex &mutex) {
  if (mutex.try_lock()) return;
  [[maybe_unused]] DSW_HOST_WAIT wait;
  mutex.lock();
}

inline void lock_shared(std::shared_mutex &mutex) {
  if (mutex.try_lock_shared()) return;
  [[maybe_unused]] DSW_HOST_WAIT wait;
  mutex.lock_shared();
}

class Writing {
 public:
  explicit Writing(std::shared_mutex &mutex) : mutex_(mutex) { lock(mutex_); }
  ~Writing() { mutex_.unlock(); }
  Writing(const Writing &) = delete;
  Writing &operator=(const Writing &) = delete;

 private:
  std::shared_mutex &mutex_;
};

class Reading {
 public:
  explicit Reading(std::shared_mutex &mutex) : mutex_(mutex) { lock_shared(mutex_); }
  ~Reading() { mutex_.unlock_shared(); }
  Reading(const Reading &) = delete;
  Reading &operator=(const Reading &) = delete;

 private:
  std::shared_mutex &mutex_;
};

// Receives log lines; a host derives from it (a SWIG director). Exceptions must not reach the library and are dropped.
class LogSink {
 public:
  virtual ~LogSink() = default;
  virtual void write(int level, const char *text) = 0;
};

// The C context. `sink` may be null and must outlive everything made with the context: the binding keeps it.
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
  // For languages that cannot keep a sink for as long: the context owns it.
  Context(std::uint32_t thread_count, std::unique_ptr<LogSink> sink) : Context(thread_count, sink.get()) {
    state_.reset(state_.get(),
                 [made = state_, kept = std::shared_ptr<LogSink>(std::move(sink))](dsw_context *) mutable {
                   made.reset();  // before its sink
                 });
  }
#endif
  const std::shared_ptr<dsw_context> &state() const { return state_; }

 private:
  std::shared_ptr<dsw_context> state_;
};

// An environment goes when it is closed (or its last object is gone) and no scene is left.
struct EnvironmentState {
  std::shared_ptr<dsw_context> context;
  std::shared_ptr<void> lent;  // The array that the library reads points from, if that is the host's.
  dsw_environment *handle = nullptr;
  std::uint32_t dimension = 3;  // It never changes: no lock is needed.
  std::size_t scenes = 0;
  bool closed = false;
  std::shared_mutex mutex;

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
  std::shared_mutex mutex;

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

// Locks of one call on a scene; `handle` is the scene's.
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

// For calls that change the environment, too.
class WholeWriting {
 public:
  explicit WholeWriting(SceneState &state) : outer_(state.environment->mutex), handle(state.handle) {
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
