# What the modules for hosts have in common. A module has the library in it: a host loads one file, and nothing is searched for.
if(CMAKE_SOURCE_DIR STREQUAL CMAKE_CURRENT_SOURCE_DIR)
  set(CMAKE_CXX_STANDARD 17)
  set(CMAKE_CXX_STANDARD_REQUIRED ON)
  set(CMAKE_CXX_EXTENSIONS OFF)
  if(NOT TARGET Dartsweep::dartsweep)
    find_package(Dartsweep CONFIG REQUIRED)
  endif()
endif()
include(${CMAKE_CURRENT_LIST_DIR}/../src/cmake/mingw.cmake)

# The library to link: a static one, or with DSW_MODULE_SHARED whatever is installed or built. Only the module of Python has this option; it then
# loads the shared library, and the environment variable DARTSWEEP_LIBRARY can name the file.
get_target_property(dsw_library_type Dartsweep::dartsweep TYPE)
if(DSW_MODULE_SHARED)
  set(dsw_static_library Dartsweep::dartsweep) # a library of the system, see the option
elseif(dsw_library_type STREQUAL "STATIC_LIBRARY")
  set(dsw_static_library Dartsweep::dartsweep)
elseif(dsw_objects) # the project builds a shared one
  if(NOT TARGET dartsweep_of_modules)
    find_package(Threads REQUIRED)
    add_library(dartsweep_of_modules STATIC EXCLUDE_FROM_ALL ${dsw_objects})
    set_target_properties(dartsweep_of_modules PROPERTIES LINKER_LANGUAGE CXX)
    target_include_directories(dartsweep_of_modules INTERFACE ${PROJECT_SOURCE_DIR}/include)
    target_compile_definitions(dartsweep_of_modules INTERFACE DSW_STATIC)
    target_link_libraries(dartsweep_of_modules PUBLIC Threads::Threads)
    if(DSW_WITH_LIBCCD)
      target_link_libraries(dartsweep_of_modules PRIVATE dartsweep_ccd)
    endif()
  endif()
  set(dsw_static_library dartsweep_of_modules)
else()
  message(FATAL_ERROR "Modules need a static library: install Dartsweep with -DBUILD_SHARED_LIBS=OFF")
endif()

# The system and the processor, in the words of .NET: linux-x64, win-x64, osx-arm64 and so on.
string(TOLOWER ${CMAKE_SYSTEM_NAME} dsw_system)
string(REPLACE windows win dsw_system ${dsw_system})
string(REPLACE darwin osx dsw_system ${dsw_system})
string(TOLOWER ${CMAKE_SYSTEM_PROCESSOR} dsw_processor)
string(REGEX REPLACE "^(x86_64|amd64)$" x64 dsw_processor ${dsw_processor})
string(REGEX REPLACE "^aarch64$" arm64 dsw_processor ${dsw_processor})
set(dsw_target ${dsw_system}-${dsw_processor})

# On macOS a module is a dynamic library, since not every linker makes bundles. C# and Java look for this suffix; others name their own.
if(APPLE)
  set(CMAKE_SHARED_MODULE_SUFFIX .dylib)
  set(CMAKE_SHARED_MODULE_CREATE_CXX_FLAGS -dynamiclib)
endif()

# What is done with every module, MODULE, which SWIG has written.
function(dsw_finish_module module)
  target_link_libraries(${module} PRIVATE ${dsw_static_library})
  target_compile_options(${module} PRIVATE -w -fno-strict-aliasing) # what SWIG writes
  # It only converts: -O1 takes two thirds of the time of -O3 to compile, -O0 a third, and calls are as fast.
  target_compile_options(${module} PRIVATE $<$<CONFIG:Release>:$<IF:$<BOOL:${DSW_QUICK_BUILD}>,-O0,-O1>>)
  set_target_properties(${module} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(MINGW)
    target_link_options(${module} PRIVATE -static) # the runtimes of C++ and of threads are inside
  endif()
  if(WIN32)
    set_target_properties(${module} PROPERTIES PREFIX "")
  endif()
  if(UNIX AND NOT APPLE AND NOT EMSCRIPTEN)
    # The symbols of the library stay in the module: another module or library of the process may have them as well.
    target_link_options(${module} PRIVATE -Wl,--exclude-libs,ALL)
  endif()
endfunction()

# MODULE finds functions in the program or the DLL that loads it: those that the file DEFINITIONS names, by an import library LIBRARY.
function(dsw_import_from_host module definitions library)
  add_custom_command(OUTPUT ${library} COMMAND ${CMAKE_DLLTOOL} -d ${definitions} -l ${library} DEPENDS ${definitions} VERBATIM)
  target_sources(${module} PRIVATE ${library})
  target_link_libraries(${module} PRIVATE ${library})
endfunction()
