# What a build can leave out. A component is on by default. Without it the functions that some sources of capi define answer
# DSW_STATUS_NOT_BUILT: stubs of a few bytes take their place. What nothing else asks for is then left out by the linker.

# dsw_component(NAME WORDS SOURCES...): the option DSW_WITH_NAME, and the sources of capi whose functions belong to it.
set(dsw_components)
macro(dsw_component name words)
  option(DSW_WITH_${name} "${words}" ON)
  list(APPEND dsw_components ${name})
  set(dsw_sources_of_${name} ${ARGN})
endmacro()
dsw_component(PLANE "Environments of the plane")
dsw_component(BODIES "Bodies" body body_edit cut_bodies move penetration free_fractions rays)
dsw_component(PAIRS "Pairs of moving features" pairs)
dsw_component(DEFORM "Environments that deform" deform)
dsw_component(SURGERY "Changes of the topology, cuts and carving" topology surgery carve detach remesh)
dsw_component(COARSEN "Coarsening" coarsen)
dsw_component(NEAR "Near rows" near)
dsw_component(TOGETHER "Moves of all vertices at once" together)
dsw_component(RECORD "Recordings, replays and traces" record replay validate bug_report trace)
dsw_component(SNAPSHOT "Snapshots" snapshot)

# dsw_leave_out(SOURCES DEFINITIONS COMPONENTS...): replaces sources in the list of this name by stubs; what capi then compiles with.
function(dsw_leave_out sources definitions)
  set(defined)
  foreach(component IN LISTS ARGN)
    list(APPEND defined DSW_WITHOUT_${component}=1)
    foreach(source IN LISTS dsw_sources_of_${component})
      dsw_write_stubs(${source} ${component})
      list(REMOVE_ITEM ${sources} capi/${source}.cpp)
      list(APPEND ${sources} ${CMAKE_CURRENT_BINARY_DIR}/stubs/${source}.cpp)
    endforeach()
  endforeach()
  set(${sources} ${${sources}} PARENT_SCOPE)
  set(${definitions} ${defined} PARENT_SCOPE)
endfunction()

# Stubs of the functions that capi/SOURCE.cpp defines.
function(dsw_write_stubs source component)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/capi/${source}.cpp)
  file(READ ${CMAKE_CURRENT_SOURCE_DIR}/capi/${source}.cpp text)
  string(REPLACE ";" "|" text "${text}") # it would end an item of a list
  string(REGEX MATCHALL "\ndsw_status dsw_[a-z0-9_]+\\([^{}|]*\\) {" heads "${text}")
  string(REGEX MATCHALL "\n[a-z_]+ [*]?dsw_[a-z0-9_]+\\(" defined "${text}")
  list(LENGTH heads count)
  list(LENGTH defined expected)
  if(NOT count EQUAL expected)
    message(FATAL_ERROR "capi/${source}.cpp defines ${expected} functions, of which ${count} can have stubs")
  endif()
  set(stubs "#include \"capi/guard.h\"\n#include \"dartsweep/dartsweep.h\"\n")
  foreach(head IN LISTS heads)
    string(APPEND stubs "${head}\n  return dsw::capi::refuse_unbuilt(__func__, \"DSW_WITH_${component}\")|\n}\n")
  endforeach()
  string(REPLACE "|" ";" stubs "${stubs}")
  file(CONFIGURE OUTPUT stubs/${source}.cpp CONTENT "${stubs}" @ONLY)
  set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/stubs/${source}.cpp PROPERTIES
    COMPILE_OPTIONS -w # parameters are not used
    SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
