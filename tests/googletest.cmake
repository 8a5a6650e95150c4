# GoogleTest, and how its cases become tests.
if(CMAKE_CROSSCOMPILING)
  # Debian has the sources for other targets.
  find_path(DSW_GOOGLETEST_SOURCES CMakeLists.txt PATHS /usr/src/googletest NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  set(INSTALL_GTEST OFF)
  set(BUILD_GMOCK OFF)
  add_subdirectory(${DSW_GOOGLETEST_SOURCES} ${PROJECT_BINARY_DIR}/googletest EXCLUDE_FROM_ALL SYSTEM)
  foreach(library IN ITEMS gtest gtest_main)
    target_compile_options(${library} PRIVATE -w)
    set_target_properties(${library} PROPERTIES UNITY_BUILD OFF)
    if(NOT TARGET GTest::${library})
      add_library(GTest::${library} ALIAS ${library})
    endif()
  endforeach()
else()
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()

# What nearly every source of a program of GoogleTest reads takes a second.
function(dsw_read_googletest_once target)
  get_target_property(options ${target} COMPILE_OPTIONS)
  set(level)
  if("-O0" IN_LIST options)
    set(level -O0)
  endif()
  dsw_read_once(dsw_googletest${level} TARGETS ${target} LINKS dartsweep_settings GTest::gtest OPTIONS ${level}
    HEADERS <gtest/gtest.h> <algorithm> <array> <atomic> <cmath> <cstdint> <cstring> <functional> <limits> <map> <memory> <random> <set>
      <string> <thread> <tuple> <utility> <vector>)
endfunction()

# dsw_google_tests(TARGET [EACH] [SHARES N] [PROPERTIES LABELS L]): the cases of a program are one test, or N tests. Starting a process
# for each case took longer than most cases, above all under a sanitizer. Presets choose cases by GTEST_FILTER. With EACH a case is a
# test, so that ctest names those that were skipped.
function(dsw_google_tests target)
  dsw_read_googletest_once(${target})
  cmake_parse_arguments(PARSE_ARGV 1 arg "EACH" "SHARES" "PROPERTIES")
  if(arg_EACH AND NOT CMAKE_CROSSCOMPILING)
    gtest_discover_tests(${target} PROPERTIES TIMEOUT 900 ${arg_PROPERTIES} DISCOVERY_TIMEOUT 60)
    return()
  endif()
  if(CMAKE_CROSSCOMPILING OR NOT arg_SHARES)
    add_test(NAME ${target} COMMAND ${target} --gtest_brief=1)
    set_tests_properties(${target} PROPERTIES TIMEOUT 900 ${arg_PROPERTIES})
    return()
  endif()
  math(EXPR last "${arg_SHARES} - 1")
  foreach(share RANGE ${last})
    math(EXPR number "${share} + 1")
    add_test(NAME ${target}.${number} COMMAND ${target} --gtest_brief=1)
    set_tests_properties(${target}.${number} PROPERTIES TIMEOUT 900 COST 40 ${arg_PROPERTIES}
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${arg_SHARES};GTEST_SHARD_INDEX=${share}")
  endforeach()
endfunction()
