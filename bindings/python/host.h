// The interpreter's lock and exceptions. Comes before the shared layer, which asks for DSW_HOST_WAIT.
#pragma once

#define PY_SSIZE_T_CLEAN
#include <Python.h>

namespace dartsweep_python {

// Whether this thread has given up the interpreter's lock: Python's stable interface does not tell.
inline thread_local bool without_lock = false;

// Gives it up for as long as it lives, where this thread has it.
class Released {
 public:
  Released() : state_(without_lock ? nullptr : PyEval_SaveThread()) { without_lock = true; }
  ~Released() {
    if (!state_) return;
    PyEval_RestoreThread(state_);
    without_lock = false;
  }
  Released(const Released &) = delete;
  Released &operator=(const Released &) = delete;

 private:
  PyThreadState *state_;
};

// Has it for as long as it lives, on any thread.
class Held {
 public:
  Held() : state_(PyGILState_Ensure()), before_(without_lock) { without_lock = false; }
  ~Held() {
    without_lock = before_;
    PyGILState_Release(state_);
  }
  Held(const Held &) = delete;
  Held &operator=(const Held &) = delete;

 private:
  PyGILState_STATE state_;
  bool before_;
};

}  // namespace dartsweep_python

#define DSW_HOST_WAIT dartsweep_python::Released
