// Errors of the shared layer as Lua's. What fails here leaves the error on the stack and answers so: lua_error, which jumps over destructors,
// is for SWIG to call when those have run.
#pragma once

#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>

#include "common/host.h"

namespace dartsweep_lua {

inline constexpr char kErrorClass[] = "dartsweep.Error";

inline bool is_own(std::string_view source) {
  constexpr std::string_view file = "dartsweep.lua";
  const std::size_t at = source.rfind(file);
  return at != source.npos && at + file.size() == source.size() && at > 0 && std::strchr("@/\\", source[at - 1]);
}

// "file:line: " of the innermost call that is not the package's own.
inline void push_where(lua_State *L) {
  lua_Debug call;
  int level = 1;
  for (; lua_getstack(L, level, &call); ++level) {
    lua_getinfo(L, "Sl", &call);
    if (call.currentline > 0 && !is_own(call.source)) break;
  }
  luaL_where(L, level);
}

inline const char *class_name(dsw_status status) {
  switch (status) {
#define DSW_NAME(name, class_name) \
  case DSW_STATUS_##name:          \
    return #class_name;
    DSW_EACH_STATUS(DSW_NAME)
#undef DSW_NAME
    default:
      return "Unknown";
  }
}

// What a call has thrown.
class Failure {
 public:
  // To be called in a handler.
  void keep() noexcept {
    try {
      throw;
    } catch (const dartsweep::Closed &error) {
      set("Closed", error.status(), error.what());
    } catch (const dartsweep::Error &error) {
      set(class_name(error.status()), error.status(), error.what());
    } catch (const std::bad_alloc &) {
      set(class_name(DSW_STATUS_OUT_OF_MEMORY), DSW_STATUS_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception &error) {
      set(class_name(DSW_STATUS_INTERNAL), DSW_STATUS_INTERNAL, error.what());
    }
  }
  // False where there was none.
  bool push(lua_State *L) const {
    if (!name_) return false;
    lua_createtable(L, 0, 4);
    lua_pushinteger(L, status_);
    lua_setfield(L, -2, "status");
    lua_pushstring(L, name_);
    lua_setfield(L, -2, "name");
    lua_pushstring(L, message_);
    lua_setfield(L, -2, "message");
    push_where(L);
    lua_setfield(L, -2, "where");
    luaL_getmetatable(L, kErrorClass);
    lua_setmetatable(L, -2);
    return true;
  }

 private:
  void set(const char *name, dsw_status status, const char *message) {
    name_ = name;
    status_ = status;
    std::snprintf(message_, sizeof message_, "%s", message);
  }

  const char *name_ = nullptr;
  dsw_status status_ = DSW_STATUS_OK;
  char message_[512];
};

// An argument of the wrong type, or of the wrong size.
inline bool refuse(lua_State *L, const char *argument, const char *expected, const char *got) {
  push_where(L);
  lua_pushfstring(L, "bad argument '%s' (%s expected, got %s)", argument, expected, got);
  lua_concat(L, 2);
  return false;
}

}  // namespace dartsweep_lua
