# libccd by its own package or by pkg-config; dartsweep_ccd is what the library links privately.
if(NOT DSW_WITH_LIBCCD)
  return()
endif()
add_library(dartsweep_ccd INTERFACE)
if(ccd_FOUND) # looked for where the option's default is chosen
  get_target_property(ccd_headers ccd INTERFACE_INCLUDE_DIRECTORIES)
  target_include_directories(dartsweep_ccd SYSTEM INTERFACE ${ccd_headers})
  target_link_libraries(dartsweep_ccd INTERFACE ccd)
else()
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(ccd REQUIRED IMPORTED_TARGET ccd)
  target_link_libraries(dartsweep_ccd INTERFACE PkgConfig::ccd)
endif()
