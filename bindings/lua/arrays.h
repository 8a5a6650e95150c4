// Packed arrays as a type of Lua: userdata that holds the elements, so that Lua's collector sees their memory and calls use it in place.
// A table becomes such an array where a call needs one, in its own slot of the stack: there it is held until the call is over.
#pragma once

#include <cstring>
#include <new>
#include <utility>

#include "common/host.h"
#include "values.h"

namespace dartsweep_lua {

inline constexpr char kArrayClass[] = "dartsweep.Array";

struct Kind {
  const char *name;  // The name of the arrays, such as DoubleArray.
  std::size_t size;  // The size of an element in bytes.
  bool (*read)(lua_State *L, int index, void *element);
  void (*push)(lua_State *L, const void *element);
};

struct PackedArray {
  const Kind *kind;
  std::size_t count;

  char *at(std::size_t i) { return reinterpret_cast<char *>(this + 1) + i * kind->size; }
  // Null where it is empty, which to calls means that it is left out.
  template <class T>
  T *data() {
    return count ? reinterpret_cast<T *>(at(0)) : nullptr;
  }
};
static_assert(sizeof(PackedArray) % alignof(double) == 0, "elements follow");

template <class T>
struct ArrayName;  // `value`, for each type of elements: of structs in typemaps.i.
#define DSW_ARRAY_NAME(type, name)              \
  template <>                                   \
  struct ArrayName<type> {                      \
    static constexpr const char *value = #name; \
  };
DSW_ARRAY_NAME(double, DoubleArray)
DSW_ARRAY_NAME(std::uint8_t, ByteArray)
DSW_ARRAY_NAME(std::int32_t, IntArray)
DSW_ARRAY_NAME(std::uint32_t, UIntArray)
DSW_ARRAY_NAME(std::size_t, SizeArray)
#undef DSW_ARRAY_NAME

template <class T>
bool read_element(lua_State *L, int index, void *element) {
  if constexpr (std::is_arithmetic_v<T>) {
    return read_number(L, index, static_cast<T *>(element));
  } else {
    const auto *object = static_cast<const T *>(find_object(L, index, descriptor<T>()));
    if (object) *static_cast<T *>(element) = *object;
    return object != nullptr;
  }
}

template <class T>
void push_element(lua_State *L, const void *element) {
  push(L, *static_cast<const T *>(element));
}

template <class T>
inline const Kind kKind = {ArrayName<T>::value, sizeof(T), read_element<T>, push_element<T>};

// On the stack; elements are zero.
inline PackedArray *push_array(lua_State *L, const Kind &kind, std::size_t count) {
  if (count > std::numeric_limits<std::size_t>::max() / 2 / kind.size) luaL_error(L, "%s is too large", kind.name);
  auto *made = new (lua_newuserdata(L, sizeof(PackedArray) + count * kind.size)) PackedArray{&kind, count};
  std::memset(made->at(0), 0, count * kind.size);
  luaL_getmetatable(L, kArrayClass);
  lua_setmetatable(L, -2);
  return made;
}

template <class T>
void push(lua_State *L, dartsweep::Array<T> array) {
  std::memcpy(push_array(L, kKind<T>, array.size())->at(0), array.data(), array.size() * sizeof(T));
}

// The array at an index, or null.
inline PackedArray *find_array(lua_State *L, int index) {
  if (lua_type(L, index) != LUA_TUSERDATA || !lua_getmetatable(L, index)) return nullptr;
  luaL_getmetatable(L, kArrayClass);
  const bool same = lua_rawequal(L, -1, -2) != 0;
  lua_pop(L, 2);
  return same ? static_cast<PackedArray *>(lua_touserdata(L, index)) : nullptr;
}

inline const char *array_or_type_name(lua_State *L, int index) {
  const PackedArray *array = find_array(L, index);
  return array ? array->kind->name : type_name(L, index);
}

// In place of a table of elements, or of rows of equally many: an array. Null where the table holds something else; `row`, if not 0, is
// how many a row must have.
inline PackedArray *make_from_table(lua_State *L, int index, const Kind &kind, std::size_t row) {
  const std::size_t length = lua_rawlen(L, index);
  lua_rawgeti(L, index, 1);
  const bool has_rows = lua_istable(L, -1);
  const std::size_t width = has_rows ? lua_rawlen(L, -1) : 1;
  lua_pop(L, 1);
  if (has_rows && row != 0 && width != row) return nullptr;
  PackedArray *made = push_array(L, kind, length * width);
  for (std::size_t i = 0; i < length; ++i) {
    lua_rawgeti(L, index, static_cast<int>(i + 1));
    bool good = has_rows ? lua_istable(L, -1) && lua_rawlen(L, -1) == width : kind.read(L, lua_gettop(L), made->at(i));
    for (std::size_t k = 0; has_rows && good && k < width; ++k) {
      lua_rawgeti(L, -1, static_cast<int>(k + 1));
      good = kind.read(L, lua_gettop(L), made->at(i * width + k));
      lua_pop(L, 1);
    }
    lua_pop(L, 1);
    if (!good) {
      lua_pop(L, 1);
      return nullptr;
    }
  }
  lua_replace(L, index);
  return made;
}

// --- arguments
template <class T>
bool to_array(lua_State *L, int index, const char *argument, T *&data, std::size_t &count, std::size_t row = 0) {
  if (lua_isnil(L, index)) return true;
  PackedArray *array = lua_istable(L, index) ? make_from_table(L, index, kKind<T>, row) : find_array(L, index);
  if (!array || array->kind != &kKind<T>) return refuse(L, argument, kKind<T>.name, array_or_type_name(L, index));
  data = array->data<T>();
  count = array->count;
  return true;
}

template <class T>
bool to_view(lua_State *L, int index, const char *argument, dartsweep::View<const T> &out) {
  T *data = nullptr;
  if (std::is_same_v<T, std::uint8_t> && lua_type(L, index) == LUA_TSTRING) {
    const char *bytes = lua_tolstring(L, index, &out.count);
    out.data = out.count ? reinterpret_cast<const T *>(bytes) : nullptr;
    return true;
  }
  if (!to_array(L, index, argument, data, out.count)) return false;
  out.data = data;
  return true;
}

// What is written: no table would do.
template <class T>
bool to_view_out(lua_State *L, int index, const char *argument, T *&data, std::size_t &count) {
  if (lua_istable(L, index)) return refuse(L, argument, kKind<T>.name, "table");
  return to_array(L, index, argument, data, count);
}

// How long the first row of a table of rows is, or 0.
inline std::size_t row_length(lua_State *L, int index) {
  if (!lua_istable(L, index)) return 0;
  lua_rawgeti(L, index, 1);
  const std::size_t length = lua_istable(L, -1) ? lua_rawlen(L, -1) : 0;
  lua_pop(L, 1);
  return length;
}

inline bool to_points(lua_State *L, int index, const char *argument, dartsweep::Points &out) {
  double *data = nullptr;
  out.columns = row_length(L, index);
  if (out.columns != 0 && out.columns != 2 && out.columns != 3)
    return refuse(L, argument, "3 numbers for each point, or 2 in the plane", "others");
  if (!to_array(L, index, argument, data, out.count)) return false;
  out.data = data;
  if (out.columns != 0) out.count /= out.columns;
  return true;
}

inline bool to_indices(lua_State *L, int index, const char *argument, dartsweep::Indices &out) {
  out.bytes = 4;
  PackedArray *array = find_array(L, index);
  std::int32_t *data = nullptr;
  if (array && array->kind == &kKind<std::uint32_t>) {
    data = array->data<std::int32_t>();
    out.count = array->count;
  } else if (!to_array(L, index, argument, data, out.count)) {
    return false;
  }
  out.data = data;
  return true;
}

// The array stays with the library, which may let go of it in any call: a coroutine of its own holds it, and is a state to give it back from.
inline bool to_lent(lua_State *L, int index, const char *argument, dartsweep::Lent &out) {
  dartsweep::Points points;
  if (lua_isnil(L, index)) return refuse(L, argument, "positions", "nil");
  if (!to_points(L, index, argument, points)) return false;
  lua_State *holder = lua_newthread(L);
  lua_pushvalue(L, index);
  lua_xmove(L, holder, 1);
  const int reference = luaL_ref(L, LUA_REGISTRYINDEX);
  out.data = const_cast<double *>(points.data);
  out.count = points.count;
  out.columns = points.columns;
  out.owner = std::shared_ptr<void>(
      holder, [reference](void *held) { luaL_unref(static_cast<lua_State *>(held), LUA_REGISTRYINDEX, reference); });
  return true;
}

// --- what Lua sees of arrays: these raise, and hold no C++ objects
inline PackedArray *check_array(lua_State *L) {
  PackedArray *array = find_array(L, 1);
  if (!array) luaL_argerror(L, 1, "an array of dartsweep is needed");
  return array;
}

// Lua's indices begin with 1; true where there is such an element.
inline bool to_place(lua_State *L, const PackedArray *array, std::size_t *place) {
  if (!read_number(L, 2, place) || *place < 1 || *place > array->count) return false;
  --*place;
  return true;
}

// array[i], or a method.
inline int array_index(lua_State *L) {
  PackedArray *array = check_array(L);
  std::size_t i = 0;
  if (to_place(L, array, &i)) {
    array->kind->push(L, array->at(i));
  } else {
    lua_settop(L, 2);
    lua_rawget(L, lua_upvalueindex(1));
  }
  return 1;
}

inline int array_newindex(lua_State *L) {
  PackedArray *array = check_array(L);
  std::size_t i = 0;
  if (!to_place(L, array, &i))
    return luaL_error(L, "%s has %d elements, from 1", array->kind->name, static_cast<int>(array->count));
  if (!array->kind->read(L, 3, array->at(i)))
    return luaL_error(L, "an element of %s cannot be a %s", array->kind->name, type_name(L, 3));
  return 0;
}

inline int array_length(lua_State *L) {
  push(L, check_array(L)->count);
  return 1;
}

inline int array_tostring(lua_State *L) {
  const PackedArray *array = check_array(L);
  lua_pushfstring(L, "%s of %d", array->kind->name, static_cast<int>(array->count));
  return 1;
}

inline int array_totable(lua_State *L) {
  PackedArray *array = check_array(L);
  lua_createtable(L, static_cast<int>(array->count), 0);
  for (std::size_t i = 0; i < array->count; ++i) {
    array->kind->push(L, array->at(i));
    lua_rawseti(L, -2, static_cast<int>(i + 1));
  }
  return 1;
}

inline int array_bytes(lua_State *L) {
  PackedArray *array = check_array(L);
  lua_pushlstring(L, array->at(0), array->count * array->kind->size);
  return 1;
}

// The numbers of the i-th point.
inline double *check_point(lua_State *L, int dimension) {
  PackedArray *array = check_array(L);
  std::size_t i = 0;
  const auto width = static_cast<std::size_t>(dimension);
  if (array->kind != &kKind<double>) luaL_argerror(L, 1, "DoubleArray expected");
  if (!read_number(L, 2, &i) || i < 1 || i > array->count / width) luaL_argerror(L, 2, "there is no such point");
  return array->data<double>() + width * (i - 1);
}

// array:point(i), or array:point(i, 2) in the plane.
inline int array_point(lua_State *L) {
  const int dimension = lua_tointeger(L, 3) == 2 ? 2 : 3;
  const double *point = check_point(L, dimension);
  for (int i = 0; i < dimension; ++i) push(L, point[i]);
  return dimension;
}

// array:set_point(i, x, y, z), or without z in the plane.
inline int array_set_point(lua_State *L) {
  const int dimension = lua_gettop(L) == 4 ? 2 : 3;
  double *point = check_point(L, dimension);
  for (int i = 0; i < dimension; ++i) point[i] = luaL_checknumber(L, 3 + i);
  return 0;
}

// A new array: of a number of zero elements, of a table, or of the bytes that another one gave. The upvalue is its kind.
inline int array_new(lua_State *L) {
  const auto &kind = *static_cast<const Kind *>(lua_touserdata(L, lua_upvalueindex(1)));
  std::size_t count = 0;
  lua_settop(L, 1);
  if (read_number(L, 1, &count)) {
    push_array(L, kind, count);
  } else if (lua_type(L, 1) == LUA_TSTRING) {
    const char *bytes = lua_tolstring(L, 1, &count);
    luaL_argcheck(L, count % kind.size == 0, 1, "bytes of whole elements expected");
    std::memcpy(push_array(L, kind, count / kind.size)->at(0), bytes, count);
  } else if (!lua_istable(L, 1) || !make_from_table(L, 1, kind, 0)) {
    return luaL_error(L, "%s is made of a size, a table of elements, or bytes", kind.name);
  }
  return 1;
}

// An array of points, where the argument is not one already; in a dimension, if that is given.
inline int new_points(lua_State *L) {
  dartsweep::Points points;
  lua_settop(L, 2);
  const auto dimension = static_cast<std::size_t>(lua_tointeger(L, 2));
  if (lua_isnil(L, 1) ? !refuse(L, "points", "points", "nil") : !to_points(L, 1, "points", points)) return lua_error(L);
  const bool fits = points.columns == 0 ? points.count % (dimension == 2 ? 2 : 3) == 0 : points.columns == dimension;
  if (dimension != 0 && !fits) {
    refuse(L, "points", dimension == 2 ? "2 numbers for each point" : "3 numbers for each point", "others");
    return lua_error(L);
  }
  lua_settop(L, 1);
  return 1;
}

// Makes the class, and adds constructors to the module on the stack.
inline void open_arrays(lua_State *L, const Kind *const *kinds, std::size_t kind_count) {
  static constexpr std::pair<const char *, lua_CFunction> methods[] = {
      {"totable", array_totable}, {"bytes", array_bytes}, {"point", array_point}, {"set_point", array_set_point}};
  static constexpr std::pair<const char *, lua_CFunction> metamethods[] = {
      {"__newindex", array_newindex}, {"__len", array_length}, {"__tostring", array_tostring}};
  luaL_newmetatable(L, kArrayClass);
  for (const auto &each : metamethods) lua_pushcfunction(L, each.second), lua_setfield(L, -2, each.first);
  lua_newtable(L);
  for (const auto &each : methods) lua_pushcfunction(L, each.second), lua_setfield(L, -2, each.first);
  lua_pushcclosure(L, array_index, 1);
  lua_setfield(L, -2, "__index");
  lua_pop(L, 1);
  for (std::size_t i = 0; i < kind_count; ++i) {
    lua_pushlightuserdata(L, const_cast<Kind *>(kinds[i]));
    lua_pushcclosure(L, array_new, 1);
    lua_setfield(L, -2, kinds[i]->name);
  }
  lua_pushcfunction(L, new_points);
  lua_setfield(L, -2, "points");
}

}  // namespace dartsweep_lua
