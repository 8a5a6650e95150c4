#!/usr/bin/env bash
# The library and the scene as WebAssembly: examples/browser/build.sh [FOLDER]
#
# Leaves dartsweep.js and dartsweep.wasm in FOLDER, by default build/browser. Needs Emscripten, CMake, Ninja and Eigen (Debian 12:
# emscripten, cmake, ninja-build, libeigen3-dev).
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${1:-$root/build/browser}
mkdir -p "$build"
build=$(cd "$build" && pwd)

cmake -S "$root" -B "$build/library" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF -DDSW_WITH_LIBCCD=OFF \
  -DCMAKE_TOOLCHAIN_FILE="$root/src/cmake/toolchains/wasm.cmake"
cmake --build "$build/library" --target dartsweep

# Debian keeps the module that Emscripten shortens JavaScript with where other builds of Node do not look.
export NODE_PATH=/usr/share/nodejs${NODE_PATH:+:$NODE_PATH}

# All functions of the C API, and those of the scene.
exported=$({
  python3 -B "$root/abi/check_abi.py" names
  grep -o 'scene_[a-z_]*(' "$here/scene.h" | tr -d '('
  printf '%s\n' malloc free
} | sed 's/^/_/' | paste -sd, -)

objects=()
for source in "$here"/{bend,blade,create,entry,scene,wire}.c "$here"/../demo/{mesh,vessel}.c; do
  object=$build/$(basename "$source" .c).o
  emcc -std=c99 -O2 -msimd128 -ffp-contract=off -Wall -Wextra -Wpedantic -Werror -I "$root/include" -c "$source" -o "$object"
  objects+=("$object")
done
# Memory grows as needed. The stack has 1 MB, since the library's walks keep batches on it.
em++ -O2 -msimd128 -fwasm-exceptions "${objects[@]}" "$build/library/src/libdartsweep.a" -o "$build/dartsweep.js" \
  -sMODULARIZE=1 -sEXPORT_NAME=createDartsweep -sENVIRONMENT=web,worker,node -sALLOW_MEMORY_GROWTH=1 -sTOTAL_STACK=1MB \
  -sFILESYSTEM=0 -sEXPORTED_FUNCTIONS="$exported" -sEXPORTED_RUNTIME_METHODS=UTF8ToString

printf 'browser: module_bytes %s\nbrowser: module_gzip_bytes %s\n' "$(stat -c %s "$build/dartsweep.wasm")" \
  "$(gzip -9 -c "$build/dartsweep.wasm" | wc -c)"
