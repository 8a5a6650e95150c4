#pragma once
// The shape of every entry point: one try, one place that turns what was thrown into a status and a message. Checks of
// null pointers and handles stand inside the try too.

#include "base/fp_mode.h"
#include "base/points.h"
#include "dartsweep/base.h"

namespace dsw::capi {

/** Turns the exception being handled into a status and writes the message of this thread. Allocates nothing. */
dsw_status status_of_exception(const char* function) noexcept;

/** The answer of a function that a build has left out, and its message: `option` would have kept it. */
dsw_status refuse_unbuilt(const char* function, const char* option) noexcept;

/** Text of the last failure on this thread. */
const char* last_message() noexcept;

/** Runs the body of the entry point named `function`; the body throws Error to fail. Whatever mode of arithmetic the
 * host is in, the body, its messages and the callbacks are in the default one. */
template <class Body>
dsw_status guard(const char* function, Body&& body) noexcept {
  const FpMode mode;
  try {
    body();
    return DSW_STATUS_OK;
  } catch (...) {
    return status_of_exception(function);
  }
}

}  // namespace dsw::capi
