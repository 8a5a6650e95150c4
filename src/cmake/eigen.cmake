# Finds Eigen 3.4 or any later version. The call names no version: Eigen 3.4.0 refuses a range that ends at 5, and Eigen 5 refuses 3.4.
find_package(Eigen3 REQUIRED NO_MODULE)
if(Eigen3_VERSION VERSION_LESS 3.4)
  message(FATAL_ERROR "Dartsweep needs Eigen 3.4 or later, and found ${Eigen3_VERSION} in ${Eigen3_DIR}")
endif()
