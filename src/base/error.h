#pragma once
// The one exception of the engine. It is thrown during set-up only (never in casts) and becomes a status at the C ABI.

#include <exception>

#include "base/compiler.h"
#include "dartsweep/base.h"

namespace dsw {

class Error : public std::exception {
 public:
  Error(dsw_status status, const char* message) noexcept;
  const char* what() const noexcept override { return message_; }
  dsw_status status() const noexcept { return status_; }

 private:
  dsw_status status_;
  char message_[400];
};

/** Throws Error with a printf-style message that names argument, index, value received and range accepted. */
[[noreturn]] DSW_PRINTF(2, 3) void fail(dsw_status status, const char* format, ...);

}  // namespace dsw
