# WebAssembly: Debian's emscripten, or any other whose emcc is found first. Tests run in Node. Needs engines with exceptions and vectors
# of 128 bits: Chrome 95, Firefox 100, Safari 16.4, Node 17 and later ones.
find_program(DSW_EMCC emcc REQUIRED)
file(REAL_PATH ${DSW_EMCC} emscripten)
cmake_path(GET emscripten PARENT_PATH emscripten)
include(${emscripten}/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH) # Eigen is headers alone
set(CMAKE_C_FLAGS_INIT -msimd128)
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fwasm-exceptions")
set(CMAKE_EXE_LINKER_FLAGS_INIT -fwasm-exceptions)
