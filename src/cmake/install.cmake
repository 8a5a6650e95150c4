# What an installation holds, in two components: what programs need to run, and headers, find_package and pkg-config files.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME Dartsweep_development)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/dartsweep DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(TARGETS dartsweep EXPORT DartsweepTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT Dartsweep_runtime NAMELINK_COMPONENT Dartsweep_development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT Dartsweep_runtime)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Dartsweep)
install(EXPORT DartsweepTargets NAMESPACE Dartsweep:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/DartsweepConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/DartsweepConfig.cmake INSTALL_DESTINATION ${package_dir})
# Releases only add to the interface: abi/README.md.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/DartsweepConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/DartsweepConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/DartsweepConfigVersion.cmake DESTINATION ${package_dir})

# pkg-config: a static library drags its C++ runtime along, a shared one names it itself. The prefix is found from
# where the .pc file lies, so that a tree may be moved.
set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR} OR IS_ABSOLUTE ${CMAKE_INSTALL_INCLUDEDIR})
  set(pc_prefix ${CMAKE_INSTALL_PREFIX})
  set(pc_libdir ${CMAKE_INSTALL_FULL_LIBDIR})
  set(pc_includedir ${CMAKE_INSTALL_FULL_INCLUDEDIR})
else()
  file(RELATIVE_PATH pc_up /${pc_dir} /)
  string(REGEX REPLACE "/$" "" pc_up ${pc_up})
  set(pc_prefix "\${pcfiledir}/${pc_up}")
  set(pc_libdir "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
  set(pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
set(pc_runtime "-lstdc++ -lm -pthread")
if(DSW_WITH_LIBCCD)
  string(PREPEND pc_runtime "-lccd ")
endif()
if(library_type STREQUAL "SHARED_LIBRARY")
  set(pc_libs "-L\${libdir} -ldartsweep")
  set(pc_cflags "-I\${includedir}")
else()
  # Only the static library is installed: a plain `pkg-config --libs` must work too.
  set(pc_libs "-L\${libdir} -ldartsweep ${pc_runtime}")
  set(pc_cflags "-I\${includedir} -DDSW_STATIC")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/dartsweep.pc.in ${CMAKE_CURRENT_BINARY_DIR}/dartsweep.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/dartsweep.pc DESTINATION ${pc_dir})
