# Options that give every target the arithmetic of IEEE 754, each operation rounded once. CMake puts options of targets behind
# CMAKE_CXX_FLAGS and behind what a parent project adds for its folders, so these have the last word. base/fp_rules.h refuses
# what a macro shows.
#
# -ffp-contract=off stands last: clang's -fno-fast-math may reset it. -fno-unsafe-math-optimizations is not among them: clang
# then takes every operation for one that may trap, which costs speed, and which WebAssembly does not have.
set(dsw_fp_options -fno-fast-math -fno-associative-math -fno-reciprocal-math -fno-finite-math-only -fsigned-zeros
  -ffp-contract=off)

# Sets `out` to the first flag of a text that asks for other arithmetic, or to "". The options above would undo most of these:
# who asks for them should hear that they are not to be had. -ffp-contract is not among them, for GCC fuses unless it is told.
function(dsw_find_bad_flag out)
  set(${out} "" PARENT_SCOPE)
  separate_arguments(flags NATIVE_COMMAND "${ARGN}")
  foreach(flag IN LISTS flags)
    if(flag MATCHES "^(-Ofast|-ffast-math|-funsafe-math-optimizations|-fassociative-math|-freciprocal-math|-ffinite-math-only|-fno-signed-zeros|-fapprox-func|-fsingle-precision-constant|-ffp-model=(fast|aggressive)|-ffp-eval-method=(double|extended)|-fdenormal-fp-math(-f32)?=.*|-mfpmath=.*387.*|-mdaz-ftz)$"
       AND NOT flag MATCHES "^-fdenormal-fp-math(-f32)?=ieee")
      set(${out} "${flag}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()

# Refuses bad flags among all that CMake gives to a compiler of C++ here.
function(dsw_refuse_bad_flags)
  string(TOUPPER "${CMAKE_BUILD_TYPE};${CMAKE_CONFIGURATION_TYPES}" types)
  get_directory_property(inherited COMPILE_OPTIONS)
  set(flags "${CMAKE_CXX_FLAGS} ${CMAKE_EXE_LINKER_FLAGS} ${CMAKE_SHARED_LINKER_FLAGS}")
  foreach(type IN LISTS types)
    string(APPEND flags " ${CMAKE_CXX_FLAGS_${type}}")
  endforeach()
  string(REPLACE ";" " " inherited "${inherited}")
  dsw_find_bad_flag(bad "${flags} ${inherited}")
  if(bad)
    message(FATAL_ERROR "Dartsweep can't be compiled with ${bad}: no sign and no bit of a result would be certain. "
                        "Give it to your own targets only, by target_compile_options.")
  endif()
endfunction()
