// Exceptions of the shared layer as C#'s. P/Invoke lets no exception through: it is kept in C#, for this thread, and thrown there when the
// call has come back.
#pragma once

#include <new>
#include <stdexcept>

#include "common/host.h"

#if defined(_WIN32)
#define DSW_CALLBACK __stdcall
#define DSW_CSHARP_API extern "C" __declspec(dllexport)
#else
#define DSW_CALLBACK
#define DSW_CSHARP_API extern "C" __attribute__((visibility("default")))
#endif

namespace dartsweep_csharp {

// The function of C# that sets the error of a status, or ArgumentException if `status` is -1. `closed` is not 0 if the
// object is closed.
using ErrorCallback = void(DSW_CALLBACK *)(int status, int closed, const char *message);
inline ErrorCallback set_error = nullptr;

inline bool refuse(const char *message) {
  set_error(-1, 0, message);
  return false;
}

// To be called in a handler.
inline void set_pending_exception() {
  try {
    throw;
  } catch (const dartsweep::Closed &error) {
    set_error(error.status(), 1, error.what());
  } catch (const dartsweep::Error &error) {
    set_error(error.status(), 0, error.what());
  } catch (const std::bad_alloc &) {
    set_error(DSW_STATUS_OUT_OF_MEMORY, 0, "out of memory");
  } catch (const std::exception &error) {
    set_error(DSW_STATUS_INTERNAL, 0, error.what());
  }
}

}  // namespace dartsweep_csharp

// What SWIG's own typemaps call for null where an object is needed.
enum { SWIG_CSharpArgumentNullException };
inline void SWIG_CSharpSetPendingExceptionArgument(int, const char *message, const char *) {
  dartsweep_csharp::refuse(message);
}
