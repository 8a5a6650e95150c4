# dsw_gmp: exact integers and rationals, for tests alone. Debian has GMP compiled for the machine itself. For another target
# tests/make_gmp.sh installs GMP in a folder, which DSW_GMP names.
set(DSW_GMP "" CACHE PATH "The folder where GMP is installed, if it is not with the libraries of the compiler")
if(DSW_GMP)
  set(where PATHS ${DSW_GMP} NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
endif()
find_path(DSW_GMP_INCLUDE gmpxx.h PATH_SUFFIXES include ${where} REQUIRED)
find_library(DSW_GMP_LIBRARY gmp PATH_SUFFIXES lib ${where} REQUIRED)
find_library(DSW_GMPXX_LIBRARY gmpxx PATH_SUFFIXES lib ${where} REQUIRED)
mark_as_advanced(DSW_GMP DSW_GMP_INCLUDE DSW_GMP_LIBRARY DSW_GMPXX_LIBRARY)
add_library(dsw_gmp INTERFACE)
target_include_directories(dsw_gmp SYSTEM INTERFACE ${DSW_GMP_INCLUDE})
target_link_libraries(dsw_gmp INTERFACE ${DSW_GMPXX_LIBRARY} ${DSW_GMP_LIBRARY})
