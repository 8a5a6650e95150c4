// Python objects as arguments of the shared layer, and its results as Python objects. Arrays of the right type and layout are used
// in place; others are converted once.
#pragma once

#define NPY_NO_DEPRECATED_API NPY_2_0_API_VERSION
#include <numpy/arrayobject.h>
#include <numpy/arrayscalars.h>

#include <cstring>
#include <limits>
#include <type_traits>

#include "common/host.h"
#include "dartsweep/dartsweep.h"
#include "host.h"

namespace dartsweep_python {

using dartsweep::Array;
using dartsweep::View;

// NumPy's type of T; that of structs is made in dtypes.py and handed over by set_dtypes.
template <class T>
struct Type {
  static PyArray_Descr *descr;
};
template <class T>
PyArray_Descr *Type<T>::descr = nullptr;

template <class T>
inline constexpr int kNumber = std::is_same_v<T, double>          ? NPY_DOUBLE
                               : std::is_same_v<T, std::uint8_t>  ? NPY_UINT8
                               : std::is_same_v<T, std::int32_t>  ? NPY_INT32
                               : std::is_same_v<T, std::uint32_t> ? NPY_UINT32
                               : std::is_same_v<T, std::size_t>   ? NPY_UINTP
                                                                  : NPY_NOTYPE;

// A new reference.
template <class T>
PyArray_Descr *descr_of() {
  if constexpr (kNumber<T> != NPY_NOTYPE) return PyArray_DescrFromType(kNumber<T>);
  Py_XINCREF(Type<T>::descr);
  return Type<T>::descr;
}

template <class T>
bool has_type(PyArrayObject *array) {
  if constexpr (kNumber<T> != NPY_NOTYPE) return PyArray_TYPE(array) == kNumber<T> && PyArray_ISNOTSWAPPED(array);
  return PyArray_DESCR(array) == Type<T>::descr || PyArray_EquivTypes(PyArray_DESCR(array), Type<T>::descr);
}

// An argument: what it refers to lives as long as this. set_* answer false with a Python error set.
struct Argument {
  PyObject *array = nullptr;
  Argument() = default;
  Argument(const Argument &) = delete;
  Argument &operator=(const Argument &) = delete;
  ~Argument() { Py_XDECREF(array); }

  bool hold(PyObject *made) {
    array = made;
    return made != nullptr;
  }
};

// A new array of integers, or null with an error: numbers with fractions are not cut.
inline PyObject *to_integers(PyObject *object, int type) {
  PyObject *any = PyArray_FROM_O(object);
  if (!any) return nullptr;
  auto *array = reinterpret_cast<PyArrayObject *>(any);
  PyObject *made = nullptr;
  if (PyArray_ISINTEGER(array) || PyArray_SIZE(array) == 0) {
    made = PyArray_FROMANY(any, type, 0, 0, NPY_ARRAY_CARRAY_RO | NPY_ARRAY_FORCECAST);
  } else {
    PyErr_SetString(PyExc_TypeError, "integers are needed");
  }
  Py_DECREF(any);
  return made;
}

// A new tuple of what a sequence has; the limited interface of Python has no quicker way.
inline PyObject *to_tuple(PyObject *object, const char *what) {
  PyObject *items = PySequence_Tuple(object);
  if (!items && PyErr_ExceptionMatches(PyExc_TypeError)) PyErr_SetString(PyExc_TypeError, what);
  return items;
}

// 2 in the plane, 3 in space: which of them it has to be, the layer knows.
inline bool is_dimension(npy_intp count) { return count == 2 || count == 3; }

// One point, from an array or any sequence of numbers.
inline bool set_point(PyObject *object, dartsweep::Point &out) {
  if (PyArray_Check(object)) {
    auto *array = reinterpret_cast<PyArrayObject *>(object);
    if (PyArray_NDIM(array) == 1 && is_dimension(PyArray_DIM(array, 0)) && has_type<double>(array) &&
        PyArray_ISALIGNED(array)) {
      out.size = static_cast<std::uint32_t>(PyArray_DIM(array, 0));
      for (std::uint32_t i = 0; i < out.size; ++i) out.at[i] = *static_cast<double *>(PyArray_GETPTR1(array, i));
      return true;
    }
  }
  PyObject *items = to_tuple(object, "a point is a sequence of 3 numbers, or 2 in the plane");
  if (!items) return false;
  const Py_ssize_t count = PyTuple_Size(items);
  bool good = is_dimension(count);
  if (!good) PyErr_SetString(PyExc_ValueError, "a point has 3 coordinates, or 2 in the plane");
  if (good) out.size = static_cast<std::uint32_t>(count);
  for (Py_ssize_t i = 0; good && i < count; ++i) {
    out.at[i] = PyFloat_AsDouble(PyTuple_GetItem(items, i));
    good = out.at[i] != -1.0 || !PyErr_Occurred();
  }
  Py_DECREF(items);
  return good;
}

struct PointsArgument : Argument {
  bool set(PyObject *object, dartsweep::Points &out) {
    if (object == Py_None) return true;
    if (PyArray_Check(object)) {
      auto *given = reinterpret_cast<PyArrayObject *>(object);
      if (has_type<double>(given) && PyArray_ISALIGNED(given) && PyArray_NDIM(given) == 2 &&
          is_dimension(PyArray_DIM(given, 1)) && PyArray_STRIDE(given, 1) == 8 &&
          PyArray_STRIDE(given, 0) >= 8 * PyArray_DIM(given, 1)) {
        Py_INCREF(object);
        hold(object);
        return point_to(given, out);
      }
    }
    if (!hold(PyArray_FROMANY(object, NPY_DOUBLE, 0, 0, NPY_ARRAY_CARRAY_RO))) return false;
    auto *made = reinterpret_cast<PyArrayObject *>(array);
    if (PyArray_NDIM(made) == 2 && is_dimension(PyArray_DIM(made, 1))) return point_to(made, out);
    PyErr_SetString(PyExc_ValueError, "points are an array of shape (n, 3), or (n, 2) in the plane");
    return false;
  }

 private:
  static bool point_to(PyArrayObject *from, dartsweep::Points &out) {
    out.data = static_cast<const double *>(PyArray_DATA(from));
    out.count = static_cast<std::size_t>(PyArray_DIM(from, 0));
    out.columns = static_cast<std::size_t>(PyArray_DIM(from, 1));
    out.stride_bytes = out.count > 1 ? static_cast<std::size_t>(PyArray_STRIDE(from, 0)) : 8 * out.columns;
    return true;
  }
};

// An array that is written: no conversion would do.
inline bool is_writable(PyObject *object, const char *what) {
  if (PyArray_Check(object) && PyArray_ISCARRAY(reinterpret_cast<PyArrayObject *>(object))) return true;
  PyErr_Format(PyExc_TypeError, "%s must be a writable, C-contiguous NumPy array", what);
  return false;
}

template <class Out>
bool set_points_out(PyObject *object, Out &out) {
  if (object == Py_None) return true;
  if (!is_writable(object, "points")) return false;
  auto *array = reinterpret_cast<PyArrayObject *>(object);
  if (!has_type<double>(array) || PyArray_NDIM(array) != 2 || !is_dimension(PyArray_DIM(array, 1))) {
    PyErr_SetString(PyExc_TypeError,
                    "points that are written must be float64, of shape (n, 3), or (n, 2) in the plane");
    return false;
  }
  out.data = static_cast<double *>(PyArray_DATA(array));
  out.count = static_cast<std::size_t>(PyArray_DIM(array, 0));
  out.columns = static_cast<std::size_t>(PyArray_DIM(array, 1));
  return true;
}

// The array stays with the library: the reference goes when that lets go, on whatever thread.
inline bool set_lent(PyObject *object, dartsweep::Lent &out) {
  if (object == Py_None) {
    PyErr_SetString(PyExc_TypeError, "positions must be an array");
    return false;
  }
  if (!set_points_out(object, out)) return false;
  Py_INCREF(object);
  out.owner = std::shared_ptr<void>(object, [](void *held) {
    const Held lock;
    Py_DECREF(static_cast<PyObject *>(held));
  });
  return true;
}

struct IndicesArgument : Argument {
  bool set(PyObject *object, dartsweep::Indices &out) {
    if (object == Py_None) return true;
    const bool narrow = PyArray_Check(object) && PyArray_TYPE(reinterpret_cast<PyArrayObject *>(object)) == NPY_INT32;
    if (!hold(to_integers(object, narrow ? NPY_INT32 : NPY_INT64))) return false;
    auto *made = reinterpret_cast<PyArrayObject *>(array);
    out.data = PyArray_DATA(made);
    out.count = static_cast<std::size_t>(PyArray_SIZE(made));
    out.bytes = narrow ? 4 : 8;
    return true;
  }
};

// View<const T>. `read_one` converts one element of a sequence of structs; numbers need none.
template <class T>
struct ViewArgument : Argument {
  Array<T> own;

  bool set(PyObject *object, View<const T> &out, bool (*read_one)(PyObject *, T *) = nullptr) {
    if (object == Py_None) return true;
    if constexpr (std::is_same_v<T, std::uint8_t>) {
      if (PyBytes_Check(object)) {
        out = {reinterpret_cast<const T *>(PyBytes_AsString(object)), static_cast<std::size_t>(PyBytes_Size(object))};
        return true;
      }
    }
    if (PyArray_Check(object)) {
      auto *given = reinterpret_cast<PyArrayObject *>(object);
      if (has_type<T>(given) && PyArray_ISCARRAY_RO(given)) {
        Py_INCREF(object);
        hold(object);
        out = {static_cast<const T *>(PyArray_DATA(given)), static_cast<std::size_t>(PyArray_SIZE(given))};
        return true;
      }
    }
    if constexpr (kNumber<T> == NPY_NOTYPE) {
      if (read_one && !PyArray_Check(object) && set_one(object, out, read_one)) return true;
      return set_structs(object, out, read_one);
    } else if constexpr (std::is_same_v<T, double>) {
      return set_converted(object, NPY_DOUBLE, out);
    } else {
      return set_integers(object, out);
    }
  }

 private:
  bool set_converted(PyObject *object, int type, View<const T> &out) {
    if (!hold(PyArray_FROMANY(object, type, 0, 0, NPY_ARRAY_CARRAY_RO))) return false;
    auto *made = reinterpret_cast<PyArrayObject *>(array);
    out = {static_cast<const T *>(PyArray_DATA(made)), static_cast<std::size_t>(PyArray_SIZE(made))};
    return true;
  }

  // Integers of another type: each has to fit.
  bool set_integers(PyObject *object, View<const T> &out) {
    if (!hold(to_integers(object, NPY_INT64))) return false;
    auto *made = reinterpret_cast<PyArrayObject *>(array);
    const auto *values = static_cast<const std::int64_t *>(PyArray_DATA(made));
    own = Array<T>(static_cast<std::size_t>(PyArray_SIZE(made)));
    for (std::size_t i = 0; i < own.size(); ++i) {
      own.data()[i] = static_cast<T>(values[i]);
      if (static_cast<std::int64_t>(own.data()[i]) == values[i] && (std::is_signed_v<T> || values[i] >= 0)) continue;
      PyErr_Format(PyExc_OverflowError, "entry %zu is %lld, which does not fit", i, static_cast<long long>(values[i]));
      return false;
    }
    out = {own.data(), own.size()};
    return true;
  }

  // One id is as good as an array of one.
  bool set_one(PyObject *object, View<const T> &out, bool (*read_one)(PyObject *, T *)) {
    T one;
    if (!read_one(object, &one)) {
      PyErr_Clear();
      return false;
    }
    own = Array<T>(&one, 1);
    out = {own.data(), 1};
    return true;
  }

  bool set_structs(PyObject *object, View<const T> &out, bool (*read_one)(PyObject *, T *)) {
    if (!read_one) {
      PyErr_SetString(PyExc_TypeError, "a NumPy array of the type in dartsweep.dtypes is needed");
      return false;
    }
    PyObject *items = to_tuple(object, "a NumPy array or a sequence of ids is needed");
    if (!items) return false;
    own = Array<T>(static_cast<std::size_t>(PyTuple_Size(items)));
    bool good = true;
    for (std::size_t i = 0; good && i < own.size(); ++i)
      good = read_one(PyTuple_GetItem(items, static_cast<Py_ssize_t>(i)), own.data() + i);
    Py_DECREF(items);
    out = {own.data(), own.size()};
    return good;
  }
};

// View<T>: written in place.
template <class T>
bool set_view(PyObject *object, View<T> &out) {
  if (object == Py_None) return true;
  if (!is_writable(object, "an array that is filled")) return false;
  auto *array = reinterpret_cast<PyArrayObject *>(object);
  if (!has_type<T>(array)) {
    PyErr_SetString(PyExc_TypeError, "an array that is filled has another dtype: see dartsweep.dtypes");
    return false;
  }
  out = {static_cast<T *>(PyArray_DATA(array)), static_cast<std::size_t>(PyArray_SIZE(array))};
  return true;
}

// A scalar of a structured array, such as ids[3].
template <class T>
bool read_scalar(PyObject *object, T *out) {
  if (PyArray_Check(object) && PyArray_NDIM(reinterpret_cast<PyArrayObject *>(object)) == 0) {
    auto *array = reinterpret_cast<PyArrayObject *>(object);
    if (!has_type<T>(array)) return false;
    std::memcpy(out, PyArray_DATA(array), sizeof *out);
    return true;
  }
  if (!PyArray_IsScalar(object, Void)) return false;
  PyArray_Descr *descr = PyArray_DescrFromScalar(object);
  const bool same = descr == Type<T>::descr || PyArray_EquivTypes(descr, Type<T>::descr);
  Py_DECREF(descr);
  if (same) std::memcpy(out, reinterpret_cast<PyVoidScalarObject *>(object)->obval, sizeof *out);
  return same;
}

// The id of a cell of the right kind.
template <class Id>
bool id_of(const dsw_cell &, Id &) {
  return false;
}
inline bool id_of(const dsw_cell &cell, dsw_vertex_id &out) {
  out = {cell.index, cell.generation};
  return cell.kind == DSW_CELL_VERTEX;
}
inline bool id_of(const dsw_cell &cell, dsw_volume_id &out) {
  out = {cell.index, cell.generation};
  return cell.kind == DSW_CELL_VOLUME;
}
inline bool id_of(const dsw_cell &cell, dsw_face_id &out) {
  out = {cell.index, cell.generation, cell.local};
  return cell.kind == DSW_CELL_FACE;
}
inline bool id_of(const dsw_cell &cell, dsw_edge_id &out) {
  out = {cell.index, cell.generation, cell.local};
  return cell.kind == DSW_CELL_EDGE;
}

// Value -> member of the class in enums.py; an integer where the library is newer.
template <class Enum>
struct Constants {
  static PyObject *members;
};
template <class Enum>
PyObject *Constants<Enum>::members = nullptr;

template <class Enum>
PyObject *to_constant(Enum value) {
  PyObject *number = PyLong_FromLong(static_cast<long>(value));
  PyObject *member = number && Constants<Enum>::members ? PyDict_GetItem(Constants<Enum>::members, number) : nullptr;
  if (!member) return number;
  Py_INCREF(member);
  Py_DECREF(number);
  return member;
}

// NumPy takes the memory over.
template <class T>
PyObject *to_python(Array<T> array) {
  npy_intp count = static_cast<npy_intp>(array.size());
  if (count == 0) return PyArray_NewFromDescr(&PyArray_Type, descr_of<T>(), 1, &count, nullptr, nullptr, 0, nullptr);
  T *data = array.release();
  PyObject *owner = PyCapsule_New(
      data, nullptr, [](PyObject *capsule) { delete[] static_cast<T *>(PyCapsule_GetPointer(capsule, nullptr)); });
  PyObject *made =
      PyArray_NewFromDescr(&PyArray_Type, descr_of<T>(), 1, &count, nullptr, data, NPY_ARRAY_CARRAY, nullptr);
  PyArray_SetBaseObject(reinterpret_cast<PyArrayObject *>(made), owner);
  return made;
}

template <class T>
PyObject *copy_to_python(const T *values, npy_intp count) {
  PyObject *made = PyArray_NewFromDescr(&PyArray_Type, descr_of<T>(), 1, &count, nullptr, nullptr, 0, nullptr);
  if (made)
    std::memcpy(PyArray_DATA(reinterpret_cast<PyArrayObject *>(made)), values,
                sizeof(T) * static_cast<std::size_t>(count));
  return made;
}

// Gives the hash of a struct without padding; never -1, which means an error.
inline long hash(const void *value, std::size_t bytes) {
  PyObject *text = PyBytes_FromStringAndSize(static_cast<const char *>(value), static_cast<Py_ssize_t>(bytes));
  const Py_hash_t made = text ? PyObject_Hash(text) : -1;
  Py_XDECREF(text);
  return static_cast<long>(made);
}

}  // namespace dartsweep_python
