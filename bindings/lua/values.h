// Numbers, points and objects on their way from Lua and back. What reads answers false where a value is not what is needed.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "dartsweep/dartsweep.h"
#include "errors.h"

namespace dartsweep_lua {

// Numbers that are exact in all versions of Lua.
template <class T>
bool read_number(lua_State *L, int index, T *out) {
  if (lua_type(L, index) != LUA_TNUMBER) return false;
  const lua_Number value = lua_tonumber(L, index);
  if constexpr (!std::is_floating_point_v<T>) {
    constexpr lua_Number exact = 9007199254740992.0;
    constexpr lua_Number low = std::is_signed_v<T> && sizeof(T) == 8 ? -exact : std::numeric_limits<T>::min();
    constexpr lua_Number high = sizeof(T) == 8 ? exact : std::numeric_limits<T>::max();
    if (!(value >= low && value <= high) || value != std::floor(value)) return false;
  }
  *out = static_cast<T>(value);
  return true;
}

template <class T>
bool to_integer(lua_State *L, int index, const char *argument, T *out) {
  return read_number(L, index, out) ||
         refuse(L, argument, sizeof(T) == 8 ? "an integer" : "an integer of 32 bits", luaL_typename(L, index));
}

// The object of a class of SWIG's at an index, or null: SWIG's own conversions take any userdata for one.
inline void *find_object(lua_State *L, int index, const swig_type_info *type) {
  if (lua_type(L, index) != LUA_TUSERDATA || !luaL_getmetafield(L, index, ".type")) return nullptr;
  lua_pop(L, 1);
  const auto *held = static_cast<swig_lua_userdata *>(lua_touserdata(L, index));
  return held->type == type ? held->ptr : nullptr;
}

inline const char *class_of(const swig_type_info *type) {
  return static_cast<swig_lua_class *>(type->clientdata)->name;
}

inline const char *type_name(lua_State *L, int index) {
  if (lua_type(L, index) != LUA_TUSERDATA || !luaL_getmetafield(L, index, ".type")) return luaL_typename(L, index);
  lua_pop(L, 1);
  return class_of(static_cast<swig_lua_userdata *>(lua_touserdata(L, index))->type);
}

template <class T>
bool to_object(lua_State *L, int index, const swig_type_info *type, const char *argument, T *&out) {
  out = static_cast<T *>(find_object(L, index, type));
  return out || refuse(L, argument, class_of(type), type_name(L, index));
}

// Members of the object at index 1 from the table at index 2. Raises.
inline int set_members(lua_State *L) {
  lua_settop(L, 2);
  luaL_getmetafield(L, 1, ".set");
  for (lua_pushnil(L); lua_next(L, 2); lua_pop(L, 1)) {
    lua_pushvalue(L, 4);
    lua_rawget(L, 3);
    if (lua_isnil(L, -1)) {
      push_where(L);
      lua_pushfstring(L, "%s has no member '%s'", type_name(L, 1),
                      lua_type(L, 4) == LUA_TSTRING ? lua_tostring(L, 4) : luaL_typename(L, 4));
      lua_concat(L, 2);
      return lua_error(L);
    }
    lua_pushvalue(L, 1);
    lua_pushvalue(L, 5);
    lua_call(L, 2, 0);
  }
  return 0;
}

// In place of a table of members: an object that has them. `made` is its own.
inline bool make_from_members(lua_State *L, int index, void *made, swig_type_info *type) {
  SWIG_NewPointerObj(L, made, type, 1);
  const int object = lua_gettop(L);
  lua_pushcfunction(L, set_members);
  lua_pushvalue(L, object);
  lua_pushvalue(L, index);
  if (lua_pcall(L, 2, 0, 0) != 0) return false;
  lua_replace(L, index);
  return true;
}

using FewNumbers = std::array<double, 4>;  // The numbers of a member.

// Numbers of a table, all of them.
template <class T>
bool read_numbers(lua_State *L, int index, T *out, std::size_t count) {
  if (lua_type(L, index) != LUA_TTABLE || lua_rawlen(L, index) != count) return false;
  bool good = true;
  for (std::size_t i = 0; good && i < count; ++i) {
    lua_rawgeti(L, index, static_cast<int>(i + 1));
    good = read_number(L, -1, out + i);
    lua_pop(L, 1);
  }
  return good;
}

// 2 coordinates in the plane, 3 in space: which of them it has to be, the layer knows.
inline bool to_point(lua_State *L, int index, const char *argument, dartsweep::Point *out) {
  if (lua_type(L, index) == LUA_TTABLE && lua_rawlen(L, index) == 2) out->size = 2;
  return read_numbers(L, index, out->at, out->size) ||
         refuse(L, argument, "a point, {x, y, z} or {x, y},", luaL_typename(L, index));
}

// --- results
template <class T>
swig_type_info *descriptor();  // The type of a class; defined in typemaps.i.

template <class T>
void push(lua_State *L, const T &value) {
  if constexpr (std::is_same_v<T, bool>) {
    lua_pushboolean(L, value);
  } else if constexpr (std::is_floating_point_v<T>) {
    lua_pushnumber(L, value);
  } else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
    lua_pushinteger(L, static_cast<lua_Integer>(value));
  } else {
    SWIG_NewPointerObj(L, new T(value), descriptor<T>(), 1);
  }
}

template <class T>
void push_list(lua_State *L, const T *values, std::size_t count) {
  lua_createtable(L, static_cast<int>(count), 0);
  for (std::size_t i = 0; i < count; ++i) {
    push(L, values[i]);
    lua_rawseti(L, -2, static_cast<int>(i + 1));
  }
}

inline void push(lua_State *L, const std::string &text) { lua_pushlstring(L, text.data(), text.size()); }
inline void push(lua_State *L, const dartsweep::Vec3 &point) { push_list(L, &point.x, 3); }
inline void push(lua_State *L, const dartsweep::Point &point) { push_list(L, point.at, point.size); }

// Several results of one call; answers how many.
template <class... T>
int push_all(lua_State *L, const T &...values) {
  (push(L, values), ...);
  return sizeof...(T);
}

}  // namespace dartsweep_lua
