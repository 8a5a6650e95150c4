/* A Python extension as it was written for 1.0.0: compiled with the headers beside it, never changed, run by
 * extension.py on every later library. Environments of hexahedra, casts, counts and snapshots. */
#define PY_SSIZE_T_CLEAN
#define Py_LIMITED_API 0x030B0000
#include <Python.h>

#include "dartsweep/dartsweep.h"

static const char kName[] = "dartsweep.environment";

static int failed(dsw_status status) {
  if (status == DSW_STATUS_OK) return 0;
  PyErr_Format(PyExc_RuntimeError, "%s: %s", dsw_status_string(status), dsw_last_error_message());
  return 1;
}

static void destroy(PyObject *capsule) {
  dsw_environment_destroy((dsw_environment *)PyCapsule_GetPointer(capsule, kName));
}

static PyObject *wrap(dsw_environment *environment) {
  PyObject *const capsule = PyCapsule_New(environment, kName, destroy);
  if (capsule == NULL) dsw_environment_destroy(environment);
  return capsule;
}

static PyObject *create(PyObject *self, PyObject *args) {
  Py_buffer points, cells;
  dsw_environment_desc desc;
  dsw_environment *environment = NULL;
  dsw_status status;
  (void)self;
  if (!PyArg_ParseTuple(args, "y*y*", &points, &cells)) return NULL;
  dsw_environment_desc_init(&desc, sizeof desc);
  desc.points = (const double *)points.buf;
  desc.point_count = (size_t)points.len / (3 * sizeof(double));
  desc.volume_count = (size_t)cells.len / (8 * sizeof(int64_t));
  desc.connectivity = cells.buf;
  desc.connectivity_count = (size_t)cells.len / sizeof(int64_t);
  status = dsw_environment_create(NULL, &desc, &environment, NULL);
  PyBuffer_Release(&points);
  PyBuffer_Release(&cells);
  return failed(status) ? NULL : wrap(environment);
}

static PyObject *cast(PyObject *self, PyObject *args) {
  const dsw_volume_id nowhere = {0, 0};
  PyObject *capsule;
  double from[3], to[3];
  dsw_environment *environment;
  dsw_cast_options options;
  dsw_flight flight;
  (void)self;
  if (!PyArg_ParseTuple(args, "O(ddd)(ddd)", &capsule, from, from + 1, from + 2, to, to + 1, to + 2)) return NULL;
  environment = (dsw_environment *)PyCapsule_GetPointer(capsule, kName);
  if (environment == NULL) return NULL;
  dsw_cast_options_init(&options, sizeof options);
  if (failed(dsw_environment_cast(environment, nowhere, from, to, &options, &flight))) return NULL;
  return Py_BuildValue("(id(ddd))", (int)flight.outcome, flight.time, flight.contact.normal[0], flight.contact.normal[1],
                       flight.contact.normal[2]);
}

static PyObject *count(PyObject *self, PyObject *capsule) {
  dsw_environment_info info;
  dsw_environment *const environment = (dsw_environment *)PyCapsule_GetPointer(capsule, kName);
  (void)self;
  if (environment == NULL) return NULL;
  info.struct_size = sizeof info;
  if (failed(dsw_environment_get_info(environment, &info))) return NULL;
  return Py_BuildValue("(kk)", (unsigned long)info.volume_count, (unsigned long)info.face_count);
}

static PyObject *save(PyObject *self, PyObject *capsule) {
  dsw_environment *const environment = (dsw_environment *)PyCapsule_GetPointer(capsule, kName);
  PyObject *bytes;
  size_t size = 0;
  (void)self;
  if (environment == NULL || failed(dsw_environment_save(environment, NULL, 0, &size))) return NULL;
  bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)size);
  if (bytes == NULL) return NULL;
  if (!failed(dsw_environment_save(environment, PyBytes_AsString(bytes), size, &size))) return bytes;
  Py_DECREF(bytes);
  return NULL;
}

static PyObject *load(PyObject *self, PyObject *bytes) {
  dsw_environment *environment = NULL;
  char *block;
  Py_ssize_t size;
  (void)self;
  if (PyBytes_AsStringAndSize(bytes, &block, &size) != 0) return NULL;
  return failed(dsw_environment_load(NULL, block, (size_t)size, &environment)) ? NULL : wrap(environment);
}

static PyObject *version(PyObject *self, PyObject *none) {
  (void)self, (void)none;
  return PyLong_FromUnsignedLong(dsw_version());
}

static PyMethodDef methods[] = {{"create", create, METH_VARARGS, NULL}, {"cast", cast, METH_VARARGS, NULL},
                                {"count", count, METH_O, NULL},         {"save", save, METH_O, NULL},
                                {"load", load, METH_O, NULL},           {"version", version, METH_NOARGS, NULL},
                                {NULL, NULL, 0, NULL}};

static struct PyModuleDef module = {PyModuleDef_HEAD_INIT, "client", NULL, -1, methods, NULL, NULL, NULL, NULL};

PyMODINIT_FUNC PyInit_client(void) { return PyModule_Create(&module); }
