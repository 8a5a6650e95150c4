// How arrays, ids, points and errors look in Python; see bindings/README.md for what belongs here.

%begin %{
#include "host.h"
%}

%{
#include "convert.h"
#include "errors.h"
// What SWIG says of arguments of a wrong type is put into words first.
#undef SWIG_exception_fail
#define SWIG_exception_fail(code, text) \
  do { dartsweep_python::refuse(SWIG_Python_ErrorType(code), text); SWIG_fail; } while (0)
%}

%init %{
import_array();
%}

// Arguments that are left out have one function, not one for each number of arguments.
%feature("compactdefaultargs");
%rename(from_) from;
#pragma SWIG nowarn=321

%exception {
  try {
    $action
  } catch (...) {
    dartsweep_python::raise_current();
    SWIG_fail;
  }
}

// Calls whose time follows the size of arrays or meshes let other threads of Python run; the others are shorter than that would take.
%define DSW_LONG(method)
%exception dartsweep::method {
  try {
    dartsweep_python::Released released;
    $action
  } catch (...) {
    dartsweep_python::raise_current();
    SWIG_fail;
  }
}
%enddef
%include "long_calls.i" // made by declare.py

// --- points
%immutable dartsweep::Particle::position;
%typemap(in) const dartsweep::Point & (dartsweep::Point point) {
  if (!dartsweep_python::set_point($input, point)) SWIG_fail;
  $1 = &point;
}
%typemap(out) dartsweep::Point {
  $result = dartsweep_python::copy_to_python((&$1)->at, (&$1)->size);
}
%typemap(out) double [ANY] {
  $result = dartsweep_python::copy_to_python($1, $1_dim0);
}
%typemap(out) uint32_t [ANY] {
  $result = dartsweep_python::copy_to_python($1, $1_dim0);
}
%typemap(out) double [ANY][ANY] {
  npy_intp shape[2] = {$1_dim0, $1_dim1};
  $result = PyArray_SimpleNew(2, shape, NPY_DOUBLE);
  if ($result) std::memcpy(PyArray_DATA(reinterpret_cast<PyArrayObject *>($result)), $1, sizeof(double) * $1_dim0 * $1_dim1);
}
%typemap(in) double [ANY] (dartsweep_python::ViewArgument<double> holder) {
  dartsweep::View<const double> view;
  if (!holder.set($input, view)) SWIG_fail;
  if (view.count != $1_dim0) SWIG_exception_fail(SWIG_ValueError, "$1_dim0 numbers are needed");
  $1 = const_cast<double *>(view.data);
}

%typemap(in) dartsweep::Points (dartsweep_python::PointsArgument holder) {
  if (!holder.set($input, $1)) SWIG_fail;
}
%typemap(in) dartsweep::PointsOut {
  if (!dartsweep_python::set_points_out($input, $1)) SWIG_fail;
}
%typemap(in) dartsweep::Lent {
  if (!dartsweep_python::set_lent($input, $1)) SWIG_fail;
}
%typemap(in) dartsweep::Indices (dartsweep_python::IndicesArgument holder) {
  if (!holder.set($input, $1)) SWIG_fail;
}

// --- arrays
%define DSW_NUMBERS(type, name)
%typemap(in) dartsweep::View<const type> (dartsweep_python::ViewArgument<type> holder, dartsweep::View<const type> view) {
  if (!holder.set($input, view)) SWIG_fail;
  $1 = view;
}
%typemap(in) dartsweep::View<type> (dartsweep::View<type> view) {
  if (!dartsweep_python::set_view<type>($input, view)) SWIG_fail;
  $1 = view;
}
%typemap(out) dartsweep::Array<type> {
  $result = dartsweep_python::to_python<type>(std::move($1));
}
%enddef
DSW_EACH_NUMBER(DSW_NUMBERS)
%typemap(out) dartsweep::Array<std::uint8_t> {
  $result = PyBytes_FromStringAndSize(reinterpret_cast<const char *>((&$1)->data()), static_cast<Py_ssize_t>((&$1)->size()));
}

%define DSW_RECORDS(type, name)
%typemap(in) dartsweep::View<const type> (dartsweep_python::ViewArgument<type> holder, dartsweep::View<const type> view) {
  if (!holder.set($input, view)) SWIG_fail;
  $1 = view;
}
%typemap(in) dartsweep::View<type> (dartsweep::View<type> view) {
  if (!dartsweep_python::set_view<type>($input, view)) SWIG_fail;
  $1 = view;
}
%typemap(out) dartsweep::Array<type> {
  $result = dartsweep_python::to_python<type>(std::move($1));
}
%typemap(out) type [ANY] {
  $result = dartsweep_python::copy_to_python($1, $1_dim0);
}
%enddef
DSW_EACH_RECORD(DSW_RECORDS)

// --- ids: None is the null id; an entry of an array of ids is as good as an id
%define DSW_IDS(type, name)
%fragment("read_" #name, "header") {
  static bool read_##name(PyObject *object, type *out) {
    void *held = nullptr;
    if (object == Py_None) {
      *out = {};
      return true;
    }
    if (dartsweep_python::read_scalar(object, out)) return true;
    if (SWIG_IsOK(SWIG_ConvertPtr(object, &held, $descriptor(type *), 0)) && held) {
      *out = *static_cast<type *>(held);
      return true;
    }
    dsw_cell cell;
    bool is_cell = dartsweep_python::read_scalar(object, &cell);
    if (!is_cell && SWIG_IsOK(SWIG_ConvertPtr(object, &held, $descriptor(dsw_cell *), 0)) && held) {
      cell = *static_cast<dsw_cell *>(held);
      is_cell = true;
    }
    if (is_cell && dartsweep_python::id_of(cell, *out)) return true;
    PyErr_SetString(PyExc_TypeError, is_cell ? "the cell is no " #name
                                             : #name " is needed: an id, an entry of an array of these, or None");
    return false;
  }
}
DSW_RECORDS(type, name)
%typemap(in, fragment="read_" #name) type {
  if (!read_##name($input, &$1)) SWIG_fail;
}
%typemap(in, fragment="read_" #name) dartsweep::View<const type> (dartsweep_python::ViewArgument<type> holder, dartsweep::View<const type> view) {
  if (!holder.set($input, view, read_##name)) SWIG_fail;
  $1 = view;
}
%typemap(in, fragment="read_" #name) const type & (type temporary) {
  if (!read_##name($input, &temporary)) SWIG_fail;
  $1 = &temporary;
}
%typemap(typecheck, precedence=SWIG_TYPECHECK_POINTER) type {
  void *held = nullptr;
  $1 = SWIG_IsOK(SWIG_ConvertPtr($input, &held, $descriptor(type *), 0)) && held;
}
%enddef
DSW_EACH_ID(DSW_IDS)

// --- reports: an entry of an array is as good as the object
%define DSW_READ_RECORD(type, name)
%typemap(in) const type & (type temporary) {
  void *held = nullptr;
  if (dartsweep_python::read_scalar($input, &temporary)) {
    $1 = &temporary;
  } else if (SWIG_IsOK(SWIG_ConvertPtr($input, &held, $1_descriptor, 0)) && held) {
    $1 = static_cast<type *>(held);
  } else {
    SWIG_exception_fail(SWIG_TypeError, "in method '" "$symname" "', argument " "$argnum"" of type '" "type const &" "'");
  }
}
%enddef
DSW_EACH_RECORD(DSW_READ_RECORD)

// --- constants: members of the classes in enums.py
%define DSW_CONSTANT(type, name)
%typemap(out) type {
  $result = dartsweep_python::to_constant<type>($1);
}
%enddef
DSW_EACH_ENUM(DSW_CONSTANT)

// --- labels of regions
%extend dartsweep::Environment {
  dartsweep::Array<std::int32_t> get_region_labels() const { return $self->get_region_labels(); }
}

// --- members that are structs
%define DSW_COPIED(type, name)
%typemap(out) const type & {
  $result = SWIG_NewPointerObj(new type(*$1), $descriptor(type *), SWIG_POINTER_OWN);
}
%enddef
DSW_EACH_ID(DSW_COPIED)
DSW_EACH_RECORD(DSW_COPIED)
DSW_EACH_RESULT(DSW_COPIED)
%typemap(out) const dartsweep::Vec3 & {
  $result = dartsweep_python::copy_to_python(&$1->x, 3);
}
// --- lists of a change: attributes, each made once
%define DSW_LIST(list, words)
%rename(_get_##list) dartsweep::Change::get_##list;
%extend dartsweep::Change {
%pythoncode %{list = _list_of_change(#list, words)%}
}
%enddef
DSW_LIST(volumes, "What became of each volume (dtypes.VOLUME_CHANGE).")
DSW_LIST(vertices, "Vertices added by a cut or a crack (dtypes.VERTEX_ORIGIN).")
DSW_LIST(faces, "Faces of a cut or tear; lips of a crack (dtypes.CUT_FACE).")
DSW_LIST(whole, "Cut: volumes crossed, but not split.")
DSW_LIST(carved, "Carving: volumes made passable.")
DSW_LIST(unrepaired, "Repair: volumes left invalid, by index.")
DSW_LIST(detached, "Volumes of the detached piece.")
DSW_LIST(body_vertices, "Of the detached body, by index (dtypes.VERTEX_ORIGIN).")
DSW_LIST(body_faces, "Of the detached body, by index (dtypes.FACE_ORIGIN).")
%extend dartsweep::Change {
%pythoncode %{def __repr__(self):
    return f"Change({_members_of(self, lambda value: len(value) if hasattr(value, '__len__') else value)})"
__setattr__ = _set_member%}
}

// --- values that compare, hash and describe themselves
%pythonbegin %{
def _set_member(self, name, value):
    """A name that is misspelt is an error."""
    kind = type(self)
    if name not in ("this", "thisown") and not isinstance(getattr(kind, name, None), property):
        import difflib

        near = difflib.get_close_matches(name, [known for known in dir(kind) if not known.startswith("_")], 1)
        raise AttributeError(f"{kind.__name__} has no member '{name}'" + (f": did you mean '{near[0]}'?" if near else ""))
    object.__setattr__(self, name, value)

def _members_of(self, shown=lambda value: value):
    """member=value, ..."""
    kind = type(self)
    members = [name for name in dir(kind) if name != "thisown" and isinstance(getattr(kind, name), property)]
    return ", ".join(f"{name}={shown(getattr(self, name))!r}" for name in members)

def _describe(self):
    """Name(member=value, ...)"""
    return f"{type(self).__name__}({_members_of(self)})"

def _list_of_change(name, words):
    """An array of a change, made when it is asked for first."""
    def get(self):
        kept = self.__dict__.setdefault("_lists", {})
        if name not in kept:
            kept[name] = getattr(self, "_get_" + name)()
        return kept[name]
    return property(get, doc=words)
%}
%define DSW_DESCRIBED(type, name)
%extend type {
%pythoncode %{__repr__ = _describe
__setattr__ = _set_member%}
}
%enddef
DSW_EACH_ID(DSW_DESCRIBED)
DSW_EACH_RECORD(DSW_DESCRIBED)
DSW_EACH_DESCRIPTION(DSW_DESCRIBED)
DSW_EACH_RESULT(DSW_DESCRIBED)

%define DSW_COMPARED(type, name)
%extend type {
  bool operator==(const type &other) const { return std::memcmp($self, &other, sizeof other) == 0; }
  bool operator!=(const type &other) const { return std::memcmp($self, &other, sizeof other) != 0; }
  long __hash__() const { return dartsweep_python::hash($self, sizeof *$self); }
}
%enddef
DSW_EACH_ID(DSW_COMPARED)
DSW_COMPARED(dsw_cell, Cell)
