// How Lua loads the module: what SWIG opens, with the classes of arrays and errors. Included where all kinds of arrays are known.
#pragma once

#include <iterator>
#include <mutex>

#include "arrays.h"

extern "C" SWIGEXPORT int SWIG_init(lua_State *L);

// SWIG's tables belong to all Lua states of the process, which may load the module at the same time; and SWIG leaves two functions among the
// globals.
extern "C" SWIGEXPORT int luaopen_dartsweep_core(lua_State *L) {
  static std::mutex mutex;
  static constexpr const char *left[] = {"swig_type", "swig_equals"};
  lua_settop(L, 0);
  for (const char *name : left) lua_getglobal(L, name);
  lua_pushcfunction(L, SWIG_init);
  mutex.lock();
  const int status = lua_pcall(L, 0, 1, 0);
  mutex.unlock();
  if (status != 0) return lua_error(L);
  for (int i = 0; i < 2; ++i) lua_pushvalue(L, i + 1), lua_setglobal(L, left[i]);
  dartsweep_lua::open_arrays(L, dartsweep_lua_kinds, std::size(dartsweep_lua_kinds));
  luaL_newmetatable(L, dartsweep_lua::kErrorClass);
  lua_setfield(L, -2, "Error");
  return 1;
}
