# Random calls, which other tests make as well, also where the fuzz targets are left out.
if(NOT TARGET dartsweep_fuzz_use)
  set(dsw_use_sources use use_body use_scene worlds calls calls_bodies calls_queries)
  list(TRANSFORM dsw_use_sources REPLACE "(.+)" "${CMAKE_CURRENT_LIST_DIR}/\\1.cpp")
  add_library(dartsweep_fuzz_use STATIC EXCLUDE_FROM_ALL ${dsw_use_sources})
  target_include_directories(dartsweep_fuzz_use INTERFACE ${CMAKE_CURRENT_LIST_DIR})
  target_link_libraries(dartsweep_fuzz_use PUBLIC Dartsweep::dartsweep)
endif()
