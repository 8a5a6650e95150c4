#!/usr/bin/env bash
# How large the library without components is as WebAssembly: tests/benchmark/wasm_size.sh [--json FILE]
#
# Builds in build/wasm_size at -Os, with all C functions exported, and prints the bytes of the module, and what gzip -9 leaves of them.
# Fails if that is more than 250,000. Needs what examples/browser/build.sh needs. Takes some minutes.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
build=$root/build/wasm_size json=
case ${1:-} in
  '') ;;
  --json) json=${2:?a file} ;;
  -h | --help) sed -n '2,5s/^# \{0,1\}//p' "$0"; exit 0 ;;
  *) echo "wasm_size: only --json FILE may follow" >&2; exit 2 ;;
esac
mkdir -p "$build"

without=()
for component in $(sed -n 's/^dsw_component(\([A-Z]*\) .*/\1/p' "$root/src/cmake/components.cmake"); do
  without+=("-DDSW_WITH_$component=OFF")
done
cmake -Wno-dev -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=MinSizeRel -DBUILD_SHARED_LIBS=OFF -DDSW_WITH_LIBCCD=OFF \
  -DCMAKE_TOOLCHAIN_FILE="$root/src/cmake/toolchains/wasm.cmake" "${without[@]}" > "$build/log.txt"
cmake --build "$build" --target dartsweep >> "$build/log.txt"
exported=$({ python3 -B "$root/abi/check_abi.py" names; printf '%s\n' malloc free; } | sed 's/^/_/' | paste -sd, -)
export NODE_PATH=/usr/share/nodejs${NODE_PATH:+:$NODE_PATH} # as in examples/browser/build.sh
em++ -Os -msimd128 -fwasm-exceptions --no-entry "$build/src/libdartsweep.a" -o "$build/core.js" -sMODULARIZE=1 -sENVIRONMENT=web,worker,node \
  -sALLOW_MEMORY_GROWTH=1 -sTOTAL_STACK=1MB -sFILESYSTEM=0 -sEXPORTED_FUNCTIONS="$exported"
compressed=$(gzip -9 -c "$build/core.wasm" | wc -c)
printf '{\n "wasm.core.bytes": %d,\n "wasm.core.gzip_bytes": %d\n}\n' "$(stat -c %s "$build/core.wasm")" "$compressed" | tee ${json:+"$json"}
[ "$compressed" -le 250000 ] || { echo "wasm_size: more than 250,000 bytes" >&2; exit 1; }
