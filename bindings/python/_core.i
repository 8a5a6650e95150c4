// The module dartsweep._core: the shared interface, and what the package hands over when it is loaded.
%module _core

%typemap(in) PyObject * "$1 = $input;"

%include "dartsweep.i"

%inline %{
namespace dartsweep_python {

// A dict: status -> class of exceptions; -1 -> that of Closed.
void set_errors(PyObject *classes) {
  Py_INCREF(classes);
  error_classes = classes;
}

template <class T>
void set_dtype(PyObject *dtype) {
  PyObject *size = PyArray_DescrCheck(dtype) ? PyObject_GetAttrString(dtype, "itemsize") : nullptr;
  const bool fits = size && PyLong_AsSize_t(size) == sizeof(T);
  Py_XDECREF(size);
  if (!fits) throw dartsweep::Error(DSW_STATUS_INTERNAL, "a dtype does not have the size of its struct");
  Py_INCREF(dtype);
  Type<T>::descr = reinterpret_cast<PyArray_Descr *>(dtype);
}

// A dict: value -> member of an enum's class.
template <class Enum>
void set_enum(PyObject *members) {
  Py_INCREF(members);
  Constants<Enum>::members = members;
}

// Hands lines of the log to a callable.
class Log : public dartsweep::LogSink {
 public:
  explicit Log(PyObject *callable) : callable_(callable) { Py_INCREF(callable_); }
  ~Log() override { Py_DECREF(callable_); }
  void write(int level, const char *text) override {
    const Held lock;
    PyObject *answer = PyObject_CallFunction(callable_, "is", level, text);
    if (!answer) PyErr_WriteUnraisable(callable_);
    Py_XDECREF(answer);
  }

 private:
  PyObject *callable_;
};

}  // namespace dartsweep_python
%}

// Steps of the elastic rods of rod.py.
%{
#include "rod_solver.h"
%}
%include "rod_solver.h"

%define DSW_DTYPE(type, name)
%template(set_dtype_##name) dartsweep_python::set_dtype<type>;
%enddef
DSW_EACH_ID(DSW_DTYPE)
DSW_EACH_RECORD(DSW_DTYPE)
DSW_DTYPE(dsw_cell, Cell)

%define DSW_SET_ENUM(type, name)
%template(set_enum_##name) dartsweep_python::set_enum<type>;
%enddef
DSW_EACH_ENUM(DSW_SET_ENUM)

// A member that the comment of its struct describes has these words.
%pythoncode %{
for _kind in [kind for kind in globals().values() if isinstance(kind, type)]:
    for _member in vars(_kind).values():
        if isinstance(_member, property) and not _member.__doc__:
            _member.__doc__ = _kind.__doc__
%}
