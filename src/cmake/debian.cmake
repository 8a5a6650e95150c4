# cpack -G DEB, in a build configured with -DCMAKE_INSTALL_PREFIX=/usr: the package of the library, which is named after the SONAME so
# that several can be installed side by side, and that of those who develop with it.
set(components Dartsweep_runtime Dartsweep_development)
set(packages libdartsweep${abi_soname} libdartsweep-dev)
foreach(component package IN ZIP_LISTS components packages) # in Debian's packages alone
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} RENAME copyright
          COMPONENT ${component} EXCLUDE_FROM_ALL)
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${package})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Dartsweep developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENT_DARTSWEEP_DEVELOPMENT_DEPENDS Dartsweep_runtime)
set(CPACK_COMPONENT_DARTSWEEP_RUNTIME_DESCRIPTION 
  "Tells a simulation exactly when and where moving points, edges and surfaces\nmeet a volume mesh, at the cost of the cells that a move meets.\nThis is the shared library, with an interface in C.")
set(CPACK_COMPONENT_DARTSWEEP_DEVELOPMENT_DESCRIPTION 
  "Headers of the shared library, in C99 that is C++98 as well, and files by which\nCMake's find_package and pkg-config find it.")
set(CPACK_STRIP_FILES ON)
# Whatever the umask is.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_DARTSWEEP_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DARTSWEEP_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DARTSWEEP_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON) # for the dependencies of what is linked to it
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY >=)
include(CPack)
