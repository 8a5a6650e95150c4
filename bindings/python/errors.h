// Exceptions of the shared layer as Python's: the classes of errors.py, by status.
#pragma once

#include <cctype>
#include <new>
#include <string>

#include "common/host.h"
#include "host.h"

namespace dartsweep_python {

inline PyObject *error_classes = nullptr;  // A dict: status -> class; -1 -> Closed.

// To be called in a handler: sets the Python error that the exception stands for.
inline void raise_current() {
  const auto raise = [](long key, const char *message) {
    PyObject *number = PyLong_FromLong(key);
    PyObject *type = error_classes ? PyDict_GetItem(error_classes, number) : nullptr;
    Py_XDECREF(number);
    PyErr_SetString(type ? type : PyExc_RuntimeError, message);
  };
  try {
    throw;
  } catch (const dartsweep::Closed &error) {
    raise(-1, error.what());
  } catch (const dartsweep::Error &error) {
    raise(error.status(), error.what());
  } catch (const std::bad_alloc &) {
    raise(DSW_STATUS_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception &error) {
    raise(DSW_STATUS_INTERNAL, error.what());
  }
}

// "dsw_cast_options const *" -> "CastOptions"
inline std::string class_of(const std::string &type) {
  std::string name = type.substr(0, type.find(' '));
  if (name.rfind("dartsweep::", 0) == 0) return name.substr(11);
  std::string out;
  bool upper = true;
  for (const char c : name.rfind("dsw_", 0) == 0 ? name.substr(4) : name) {
    if (c != '_') out += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = c == '_';
  }
  return out;
}

inline std::string words_of_type(const std::string &type) {
  const auto has = [&](const char *part) { return type.find(part) != std::string::npos; };
  if (has("char")) return "a string";
  if (has("bool")) return "True or False";
  if (has("double")) return has("*") || has("[") ? "an array of numbers" : "a number";
  if (has("int") || has("size_t") || has("long")) return "an integer in its range";
  if (has("*") || has("&")) return "an object of type " + class_of(type);
  return "a constant of " + class_of(type);
}

// Sets the error of an argument that has a wrong type. SWIG's text is "in method 'M', argument N of type 'T'".
inline void refuse(PyObject *kind, const std::string &text) {
  const auto between = [&](const char *from, char to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) return std::string();
    const std::size_t begin = at + std::string(from).size();
    return text.substr(begin, text.find(to, begin) - begin);
  };
  std::string method = between("in method '", '\'');
  const std::string type = between("of type '", '\'');
  if (method.empty() || type.empty()) return PyErr_SetString(kind, text.c_str());
  const bool is_member = method.size() > 4 && method.compare(method.size() - 4, 4, "_set") == 0;
  const std::size_t end_of_class = method.find('_');
  if (is_member) {
    method = method.substr(0, method.size() - 4);
    method[end_of_class] = '.';
  } else if (method.rfind("new_", 0) == 0) {
    method = method.substr(4);
  } else if (end_of_class != std::string::npos) {
    method = method.substr(end_of_class + 1);
  }
  PyErr_SetString(kind, (method + (is_member ? " takes " : "() takes ") + words_of_type(type) +
                         (is_member ? "" : ", and was given something else"))
                            .c_str());
}

}  // namespace dartsweep_python
