# src/cmake/eigen.cmake takes Eigen from 3.4 on, however strict the version file of an Eigen is: cmake -DROOT=... -DWORK=... -P eigen_test.cmake
include(CMakePackageConfigHelpers)
foreach(case IN ITEMS
    "3.3.9 SameMajorVersion 1" "3.4.0 SameMajorVersion 0" "3.4.1 SameMajorVersion 0" "5.0.1 SameMinorVersion 0" "5.1.0 SameMajorVersion 0")
  string(REPLACE " " ";" case "${case}")
  list(GET case 0 version)
  list(GET case 1 compatibility)
  list(GET case 2 expected)
  file(WRITE ${WORK}/${version}/Eigen3Config.cmake "")
  write_basic_package_version_file(${WORK}/${version}/Eigen3ConfigVersion.cmake
    VERSION ${version} COMPATIBILITY ${compatibility} ARCH_INDEPENDENT)
  execute_process(COMMAND ${CMAKE_COMMAND} -DEigen3_DIR=${WORK}/${version} -P ${ROOT}/src/cmake/eigen.cmake
    RESULT_VARIABLE status ERROR_VARIABLE said)
  if(NOT status EQUAL expected OR status AND NOT said MATCHES "needs Eigen 3.4 or later, and found ${version}")
    message(FATAL_ERROR "Eigen ${version}: status ${status} instead of ${expected}: ${said}")
  endif()
endforeach()
