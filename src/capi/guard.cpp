#include "capi/guard.h"

#include <cstdio>
#include <new>
#include <stdexcept>

namespace dsw::capi {
namespace {

// Fixed, so that reporting "out of memory" needs none.
thread_local char t_message[512];

dsw_status record(const char* function, dsw_status status, const char* text) noexcept {
  std::snprintf(t_message, sizeof t_message, "%s: %s", function, text);
  return status;
}

}  // namespace

const char* last_message() noexcept { return t_message; }

dsw_status refuse_unbuilt(const char* function, const char* option) noexcept {
  std::snprintf(t_message, sizeof t_message, "%s: this library was built without it (%s)", function, option);
  return DSW_STATUS_NOT_BUILT;
}

dsw_status status_of_exception(const char* function) noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return record(function, error.status(), error.what());
  } catch (const std::bad_alloc&) {
    return record(function, DSW_STATUS_OUT_OF_MEMORY, "the allocator returned null");
  } catch (const std::length_error&) {
    return record(function, DSW_STATUS_OUT_OF_MEMORY, "more memory than can be addressed");
  } catch (const std::exception& error) {
    return record(function, DSW_STATUS_INTERNAL, error.what());
  } catch (...) {
    return record(function, DSW_STATUS_INTERNAL, "unknown exception");
  }
}

}  // namespace dsw::capi
