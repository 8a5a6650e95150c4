// How arrays, ids, points and errors look in Lua; see bindings/README.md for what belongs here.

%{
#include "arrays.h"
%}

%feature("compactdefaultargs");
%rename("$ignore", %$isenumitem, regexmatch$name="FORCE_INT32$") ""; // only fixes sizes in C
%rename(local_index) local; // a keyword of Lua

%exception {
  dartsweep_lua::Failure failure;
  try {
    $action
  } catch (...) {
    failure.keep();
  }
  if (failure.push(L)) SWIG_fail;
}

%ignore dartsweep::Points;
%ignore dartsweep::PointsOut;
%ignore dartsweep::Indices;
%ignore dartsweep::Lent;
%ignore dartsweep::LogSink;

// --- numbers: integers are integers, also in Lua 5.4
%define DSW_INTEGERS(type)
%typemap(in) type {
  if (!dartsweep_lua::to_integer(L, $input, "$1_name", &$1)) SWIG_fail;
}
%typemap(out) type {
  dartsweep_lua::push(L, $1);
  ++SWIG_arg;
}
%typemap(typecheck, precedence=SWIG_TYPECHECK_INTEGER) type "$1 = lua_type(L, $input) == LUA_TNUMBER;"
%enddef
DSW_INTEGERS(int)
DSW_INTEGERS(unsigned int)
DSW_INTEGERS(std::int32_t)
DSW_INTEGERS(std::uint32_t)
DSW_INTEGERS(uint32_t)
DSW_INTEGERS(std::uint64_t)
DSW_INTEGERS(uint64_t)
DSW_INTEGERS(std::size_t)
DSW_INTEGERS(size_t)
%typemap(in) enum SWIGTYPE {
  int value = 0;
  if (!dartsweep_lua::to_integer(L, $input, "$1_name", &value)) SWIG_fail;
  $1 = static_cast<$1_ltype>(value);
}
%typemap(out) enum SWIGTYPE {
  dartsweep_lua::push(L, $1);
  ++SWIG_arg;
}

// --- what may be left out at the end of a call; nil is as good
%typemap(in) std::uint32_t flags, std::uint32_t label, std::uint32_t thread_count {
  if (!lua_isnil(L, $input) && !dartsweep_lua::to_integer(L, $input, "$1_name", &$1)) SWIG_fail;
}
%typemap(default) dsw_mark mark "$1 = DSW_MARK_IMPASSABLE;"
%typemap(default) double radius "$1 = std::numeric_limits<double>::infinity();"

// --- objects: only of the class that is needed; nil where a pointer may be null
%typemap(in) SWIGTYPE *self, SWIGTYPE & {
  if (!dartsweep_lua::to_object(L, $input, $descriptor, "$1_name", $1)) SWIG_fail;
}
%typemap(in) SWIGTYPE * {
  if (!lua_isnil(L, $input) && !dartsweep_lua::to_object(L, $input, $descriptor, "$1_name", $1)) SWIG_fail;
}

// --- options: a table of members will do
%define DSW_FROM_TABLE(type, maker)
%typemap(in) const type & {
  if (lua_istable(L, $input) && !dartsweep_lua::make_from_members(L, $input, maker, $descriptor(type *))) SWIG_fail;
  if (!dartsweep_lua::to_object(L, $input, $descriptor(type *), "$1_name", $1)) SWIG_fail;
}
%typemap(in) const type * {
  if (lua_istable(L, $input) && !dartsweep_lua::make_from_members(L, $input, maker, $descriptor(type *))) SWIG_fail;
  if (!lua_isnil(L, $input) && !dartsweep_lua::to_object(L, $input, $descriptor(type *), "$1_name", $1)) SWIG_fail;
}
%enddef
%define DSW_DESCRIPTION(type, name)
DSW_FROM_TABLE(type, new_##type())
%enddef
DSW_EACH_DESCRIPTION(DSW_DESCRIPTION)
DSW_FROM_TABLE(dsw_rigid_motion, new dsw_rigid_motion())

// --- points: {x, y, z}, in the plane {x, y}
%ignore dartsweep::Vec3;
%typemap(in) const dartsweep::Point & (dartsweep::Point point) {
  if (!dartsweep_lua::to_point(L, $input, "$1_name", &point)) SWIG_fail;
  $1 = &point;
}
%typemap(out) dartsweep::Point {
  dartsweep_lua::push(L, *&$1);
  ++SWIG_arg;
}
%typemap(in) double [ANY] (dartsweep_lua::FewNumbers held) {
  static_assert($1_dim0 <= 4, "room for all");
  if (!dartsweep_lua::read_numbers(L, $input, held.data(), $1_dim0)) {
    dartsweep_lua::refuse(L, "$1_name", "$1_dim0 numbers", luaL_typename(L, $input));
    SWIG_fail;
  }
  $1 = held.data();
}
%typemap(in) SWIGTYPE [ANY], SWIGTYPE [ANY][ANY] {
  dartsweep_lua::refuse(L, "$1_name", "nothing", luaL_typename(L, $input)); // reports are not written
  SWIG_fail;
}
%typemap(out) SWIGTYPE [ANY] {
  dartsweep_lua::push_list(L, $1, $1_dim0);
  ++SWIG_arg;
}
%typemap(out) SWIGTYPE [ANY][ANY] {
  lua_createtable(L, $1_dim0, 0);
  for (int i = 0; i < $1_dim0; ++i) {
    dartsweep_lua::push_list(L, $1[i], $1_dim1);
    lua_rawseti(L, -2, i + 1);
  }
  ++SWIG_arg;
}

// --- arrays
%typemap(in) dartsweep::Points {
  if (!dartsweep_lua::to_points(L, $input, "$1_name", $1)) SWIG_fail;
}
%typemap(in) dartsweep::PointsOut {
  if (!dartsweep_lua::to_view_out(L, $input, "$1_name", $1.data, $1.count)) SWIG_fail;
}
%typemap(in) dartsweep::Indices {
  if (!dartsweep_lua::to_indices(L, $input, "$1_name", $1)) SWIG_fail;
}
%typemap(in) dartsweep::Lent {
  if (!dartsweep_lua::to_lent(L, $input, "$1_name", $1)) SWIG_fail;
}
%define DSW_ARRAYS(type, name)
%typemap(in) dartsweep::View<const type> (dartsweep::View<const type> view) {
  if (!dartsweep_lua::to_view(L, $input, "$1_name", view)) SWIG_fail;
  $1 = view;
}
%typemap(in) dartsweep::View<type> (dartsweep::View<type> view) {
  if (!dartsweep_lua::to_view_out(L, $input, "$1_name", view.data, view.count)) SWIG_fail;
  $1 = view;
}
%typemap(out) dartsweep::Array<type> {
  dartsweep_lua::push(L, std::move(*&$1));
  ++SWIG_arg;
}
%enddef
DSW_EACH_NUMBER(DSW_ARRAYS)
DSW_EACH_ID(DSW_ARRAYS)
DSW_EACH_RECORD(DSW_ARRAYS)
%typemap(out) dartsweep::Array<std::uint8_t> {
  lua_pushlstring(L, reinterpret_cast<const char *>((&$1)->data()), (&$1)->size());
  ++SWIG_arg;
}

// --- structs
%define DSW_STRUCTS(type, name)
%insert("header") {
template <>
swig_type_info *dartsweep_lua::descriptor<type>() { return SWIGTYPE_p_##type; }
template <>
struct dartsweep_lua::ArrayName<type> {
  static constexpr const char *value = #name "Array";
};
}
%typemap(out) const type & {
  dartsweep_lua::push(L, *$1);
  ++SWIG_arg;
}
%enddef
DSW_EACH_ID(DSW_STRUCTS)
DSW_EACH_RECORD(DSW_STRUCTS)
DSW_STRUCTS(dsw_cross_check, CrossCheck)
DSW_STRUCTS(dsw_contact, Contact)
DSW_STRUCTS(dsw_cell, Cell)

// --- ids: nil is the null id
%define DSW_IDS(type, name)
%typemap(in) type {
  type *held = nullptr;
  if (!lua_isnil(L, $input) && !dartsweep_lua::to_object(L, $input, $&1_descriptor, "$1_name", held)) SWIG_fail;
  $1 = held ? *held : type();
}
%typemap(in) const type & (type id) {
  type *held = nullptr;
  if (!lua_isnil(L, $input) && !dartsweep_lua::to_object(L, $input, $descriptor(type *), "$1_name", held)) SWIG_fail;
  id = held ? *held : type();
  $1 = &id;
}
%typemap(typecheck, precedence=SWIG_TYPECHECK_POINTER) type "$1 = dartsweep_lua::find_object(L, $input, $&1_descriptor) != nullptr;"
%enddef
DSW_EACH_ID(DSW_IDS)
%typemap(in) dsw_cell {
  dsw_cell *held = nullptr;
  if (!dartsweep_lua::to_object(L, $input, $&1_descriptor, "$1_name", held)) SWIG_fail;
  $1 = *held;
}

// --- a change: its numbers and lists in one class
%include "common/change_numbers.i"

// --- several results of one call
%define DSW_RESULTS(type, ...)
%ignore dartsweep::type;
%typemap(out) dartsweep::type {
  const dartsweep::type &parts = *&$1;
  SWIG_arg += dartsweep_lua::push_all(L, __VA_ARGS__);
}
%enddef
DSW_RESULTS(Located, parts.volume, parts.location)
DSW_RESULTS(VolumeCounts, parts.type, parts.vertices, parts.edges, parts.faces)
DSW_RESULTS(FaceVolumes, parts.near_side, parts.far_side)
DSW_RESULTS(Neighbour, parts.volume, parts.impassable)
DSW_RESULTS(Marked, parts.marked, parts.skipped)
DSW_RESULTS(VolumeSplit, parts.left, parts.right, parts.face)
DSW_RESULTS(FaceSplit, parts.left, parts.right, parts.edge)
DSW_RESULTS(EdgeSplit, parts.vertex, parts.first, parts.second)
DSW_RESULTS(Particle, parts.position, parts.volume)
DSW_RESULTS(BodyFilter, parts.category, parts.mask)
DSW_RESULTS(Depenetration, parts.freed, parts.distance)
