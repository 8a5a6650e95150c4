# The elastic rod, which examples/physics and the Python package use. Eigen is what the library is built with anyway.
if(NOT TARGET dartsweep_rod)
  include(${CMAKE_CURRENT_LIST_DIR}/../../src/cmake/eigen.cmake)
  set(rod ${CMAKE_CURRENT_LIST_DIR})
  add_library(dartsweep_rod STATIC EXCLUDE_FROM_ALL ${rod}/chain_matrix.cpp ${rod}/rod.cpp ${rod}/rod_contacts.cpp ${rod}/rod_shape.cpp
    ${rod}/rod_row.cpp ${rod}/rod_system.cpp)
  target_include_directories(dartsweep_rod PUBLIC ${rod}/..)
  target_link_libraries(dartsweep_rod PUBLIC Eigen3::Eigen)
  set_target_properties(dartsweep_rod PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(DSW_QUICK_BUILD OR dsw_unity_tests) # as in the library; and Eigen is read once
    set_target_properties(dartsweep_rod PROPERTIES UNITY_BUILD ON)
    target_compile_options(dartsweep_rod PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endif()
