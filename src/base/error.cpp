#include "base/error.h"

#include <cstdarg>
#include <cstdio>

namespace dsw {

Error::Error(dsw_status status, const char* message) noexcept : status_(status) {
  std::snprintf(message_, sizeof message_, "%s", message);
}

void fail(dsw_status status, const char* format, ...) {
  char text[400];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  throw Error(status, text);
}

}  // namespace dsw
