// The interpreter's lock and exceptions. Comes before the shared layer, which asks for DSW_HOST_WAIT.
#pragma once

#define PY_SSIZE_T_CLEAN
#include <Python.h>

namespace dartsweep_python {

// Gives up the interpreter's lock for as long as it lives, where this thread has it.
class Released {
 public:
  Released() : state_(PyGILState_Check() ? PyEval_SaveThread() : nullptr) {}
  ~Released() {
    if (state_) PyEval_RestoreThread(state_);
  }
  Released(const Released &) = delete;
  Released &operator=(const Released &) = delete;

 private:
  PyThreadState *state_;
};

}  // namespace dartsweep_python

#define DSW_HOST_WAIT dartsweep_python::Released
