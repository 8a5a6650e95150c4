# Python3::Module and Python3_NumPy_INCLUDE_DIRS for a module of another target. The headers are those of the Python that builds: they are
# the same everywhere but for pyconfig.h and _numpyconfig.h, which hold the sizes of types. Those take the compiler's.
execute_process(COMMAND ${Python3_EXECUTABLE} -c "import sysconfig, numpy; print(sysconfig.get_path('include'), numpy.get_include(), sep=';', end='')"
  OUTPUT_VARIABLE host_headers COMMAND_ERROR_IS_FATAL ANY)
list(GET host_headers 0 python_headers)
list(GET host_headers 1 numpy_headers)

set(headers ${CMAKE_CURRENT_BINARY_DIR}/headers)
file(COPY ${python_headers}/ DESTINATION ${headers}/python PATTERN pyconfig.h EXCLUDE)
configure_file(${CMAKE_CURRENT_LIST_DIR}/cross_pyconfig.h ${headers}/python/pyconfig.h COPYONLY)
file(COPY ${numpy_headers}/ DESTINATION ${headers}/numpy)
file(READ ${numpy_headers}/numpy/_numpyconfig.h sizes)
foreach(type IN ITEMS LONG WCHAR_T)
  string(REGEX REPLACE "(NPY_SIZEOF_${type}) [0-9]+" "\\1 __SIZEOF_${type}__" sizes "${sizes}")
endforeach()
if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
  string(REPLACE "#define NPY_HAVE_ENDIAN_H 1" "" sizes "${sizes}")
endif()
file(WRITE ${headers}/numpy/numpy/_numpyconfig.h "${sizes}")

add_library(Python3::Module INTERFACE IMPORTED)
target_include_directories(Python3::Module INTERFACE ${headers}/python)
set(Python3_NumPy_INCLUDE_DIRS ${headers}/numpy)
