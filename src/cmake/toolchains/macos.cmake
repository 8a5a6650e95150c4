# macOS on 64-bit ARM, or on x86-64 with -DCMAKE_SYSTEM_PROCESSOR=x86_64: zig's compiler, of PyPI's package ziglang, which brings the
# system's headers. What it makes has not been run.
set(CMAKE_SYSTEM_NAME Darwin)
if(NOT CMAKE_SYSTEM_PROCESSOR)
  set(CMAKE_SYSTEM_PROCESSOR arm64)
endif()
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CMAKE_SYSTEM_PROCESSOR)
string(REPLACE arm64 aarch64 zig_processor ${CMAKE_SYSTEM_PROCESSOR})
find_program(DSW_ZIG python-zig REQUIRED)
set(CMAKE_C_COMPILER ${DSW_ZIG} cc -target ${zig_processor}-macos.11.0)
set(CMAKE_CXX_COMPILER ${DSW_ZIG} c++ -target ${zig_processor}-macos.11.0)
include(${CMAKE_CURRENT_LIST_DIR}/search.cmake)
