// Exceptions of the shared layer as Python's: the classes of errors.py, by status.
#pragma once

#include <new>

#include "common/host.h"
#include "host.h"

namespace dartsweep_python {

inline PyObject *error_classes = nullptr;  // A dict: status -> class; -1 -> Closed.

// To be called in a handler: sets the Python error that the exception stands for.
inline void raise_current() {
  const auto raise = [](long key, const char *message) {
    PyObject *number = PyLong_FromLong(key);
    PyObject *type = error_classes ? PyDict_GetItem(error_classes, number) : nullptr;
    Py_XDECREF(number);
    PyErr_SetString(type ? type : PyExc_RuntimeError, message);
  };
  try {
    throw;
  } catch (const dartsweep::Closed &error) {
    raise(-1, error.what());
  } catch (const dartsweep::Error &error) {
    raise(error.status(), error.what());
  } catch (const std::bad_alloc &) {
    raise(DSW_STATUS_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception &error) {
    raise(DSW_STATUS_INTERNAL, error.what());
  }
}

}  // namespace dartsweep_python
