#!/usr/bin/env bash
# Everything that must pass, in one command, on a fresh Debian 12 as root: installs what is missing, builds and tests
# every configuration, and ends with ctest's closing lines of all of them. Exits 0 only if all passed.
# usage: tests/run.sh [STEP...]    none means all_steps below
# Steps to be asked for: long, before a release: all random tests, with all cases that they are written for, and twenty times the runs
# of the fuzz targets; clang; for other targets arm64 (tests under qemu), windows (tests under wine) and wasm (tests in Node);
# components, each part of the library left out alone;
# portable, which compares the bits of all targets whose step has run; packages of these targets; browser, the page.
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(g++ clang clang-format-14 libclang-rt-14-dev cmake ninja-build pkg-config python3 binutils file dpkg-dev abigail-tools
  libccd-dev libembree-dev libbullet-dev libfcl-dev libeigen3-dev libgtest-dev libgmp-dev libcli11-dev nlohmann-json3-dev swig python3-dev python3-venv
  openjdk-17-jdk-headless maven mono-mcs mono-runtime doxygen libosmesa6 libglu1-mesa libxcursor1 libxft2 libxinerama1
  lua5.4 liblua5.4-dev lua-unit luarocks)
declare -A packages_of=( # of steps for other targets
  [arm64]="g++-aarch64-linux-gnu qemu-user m4 make"
  [windows]="g++-mingw-w64-x86-64-posix wine64 m4 make"
  [wasm]="emscripten m4 make"
  [packages]="g++-aarch64-linux-gnu qemu-user g++-mingw-w64-x86-64-posix wine64 emscripten")
all_steps=(release dev tsan python page node java csharp lua docs report format)
# clang is a step to ask for: before a release, where bits may differ, or where a source of the engine may miss a header.
# It compiles each source of the engine by itself, and tests without sanitizers.
steps=("$@")
[ ${#steps[@]} -gt 0 ] || steps=("${all_steps[@]}")
jobs=$(nproc)
export CMAKE_GENERATOR=Ninja CTEST_PARALLEL_LEVEL=$jobs CMAKE_BUILD_PARALLEL_LEVEL=$jobs

# Real meshes: tests that want them skip, visibly, where there are none.
if [ -z "${DARTSWEEP_DATA:-}" ] && [ -d ../shared/data ]; then
  DARTSWEEP_DATA=$(cd ../shared/data && pwd)
  export DARTSWEEP_DATA
fi

for step in "${steps[@]}"; do packages+=(${packages_of[$step]:-}); done
missing=()
for package in "${packages[@]}"; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  echo "installing ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq >/dev/null
  apt-get install -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

# Sanitizers of this age do not know the address layouts of newer kernels; without randomization they need not.
plain_addresses=()
if setarch "$(uname -m)" -R true 2>/dev/null; then plain_addresses=(setarch "$(uname -m)" -R); fi

# Bytecode is kept apart: some steps copy folders while others run Python in them. Tests start many processes that read large packages.
unset PYTHONDONTWRITEBYTECODE
export PYTHONPYCACHEPREFIX=$PWD/build/bytecode

# ASan keeps two frames for each allocation: GMP's frames can't be unwound, and storing them took most of the time. With one frame
# no leak would be reported. Memory that was freed is kept apart up to 16 MB: with 256 MB, a fifteenth of the time went into new pages.
export ASAN_OPTIONS=malloc_context_size=2:quarantine_size_mb=16

failed=0

# run_step NAME: keeps the output in build/NAME.log, shows it only when something is wrong; what to say at the end is in build/NAME.summary.
run_step() {
  local name=$1 start=$SECONDS log=build/$1.log status=0
  echo "== $name"
  "step_$name" >"$log" 2>&1 || status=$?
  [ $status -eq 0 ] || tail -n 150 "$log"
  local lines
  lines=$(grep -E '^(100|[0-9]+)% tests passed|^Total Test time|^No tests were found|^format:|^(python|docs|java|csharp|lua|node):|^abi\.|^# (pass|fail) [0-9]+|^Ran [0-9]+ tests|^(portable|packages|browser)[.:]' "$log" || true)
  [ $status -eq 0 ] || lines+=$'\nFAILED, see '$log
  printf '%s (%s s)\n%s\n' "$name" $((SECONDS - start)) "$lines" >"build/$name.summary"
  echo "$lines"
  return $status
}

# Steps that keep one processor busy go side by side, as many as there are processors; before any other all have ended.
single=" python page node java csharp lua docs report format "
running=0
wait_until_running() {
  while [ $running -gt "$1" ]; do
    wait -n || failed=1
    running=$((running - 1))
  done
}

# preset NAME TARGETS...
preset() {
  local name=$1
  shift
  cmake --preset "$name" && cmake --build --preset "$name" --target "$@" && "${plain_addresses[@]}" ctest --preset "$name" --no-tests=error
}

# with_library PRESET TREE RUNTIME: programs of release with the library of build/TREE, which is compiled otherwise, and the runtime of its
# sanitizer.
with_library() {
  one_at_a_time make_programs && LD_LIBRARY_PATH=build/$2/src ldd build/release/tests/capi/capi_base_test | grep "build/$2/src" &&
    DSW_PRELOADED=$3 "${plain_addresses[@]}" ctest --preset "$1" --no-tests=error
}
asan_runtime() { clang -print-file-name=libclang_rt.asan-x86_64.so; }
tsan_runtime() { g++ -print-file-name=libtsan.so; }
make_programs() { cmake --preset release && cmake --build --preset release; }

# target NAME: the tests of another target, compiled here and run by its emulator.
target() { tests/make_gmp.sh "$1" "build/gmp/$1" && preset "$1" all; }

# Wine's own processes begin here. Begun by a test they would keep its output open.
start_wine() {
  export WINEPREFIX=$PWD/build/wine WINEDEBUG=-all
  [ -e /usr/lib/wine/wine64 ] || return 0
  mkdir -p "$WINEPREFIX"
  /usr/lib/wine/wineserver64 -p60 >build/wine.log 2>&1 </dev/null || [ $? -eq 2 ] # 2: one is running
  /usr/lib/wine/wine64 wineboot >>build/wine.log 2>&1 </dev/null
}

# one_at_a_time COMMAND...: no two steps work in build/release.
one_at_a_time() {
  (flock 9 && "$@") 9>build/release.lock
}

# The library of the release preset as others find it, in build/dartsweep.
install_library() { one_at_a_time make_library; }
make_library() {
  cmake --preset release && cmake --build --preset release --target dartsweep &&
    cmake --install build/release --prefix build/dartsweep
}

# The static library as others find it, in build/dartsweep-static/prefix, and the rod, once for all steps.
rod=build/release/examples/physics/libdartsweep_rod.a
install_static_library() { one_at_a_time make_static_library; }
make_static_library() {
  [ ! -e build/static.made ] || return 0
  cmake --preset release && cmake --build --preset release --target dartsweep_internal dartsweep_rod &&
    CC=cc CXX=c++ tests/package/package_test.sh static "$PWD/build/release" "$PWD/build/dartsweep-static" &&
    touch build/static.made
}

# The wheel, once for all steps: the second step that wants the wheel waits for the first.
install_python() {
  install_static_library && (flock 8 && make_python) 8>build/python.lock
}
make_python() {
  [ ! -e build/python.made ] || return 0
  bindings/python/install.sh build/dartsweep-static/prefix "$rod" && touch build/python.made
}

# step_NAME: all of a step.
step_release() {
  preset release all && ctest --preset release_long && python3 -B abi/check_abi.py symbols build/release/src/libdartsweep.so &&
    rm -rf build/dartsweep-static && ln -s release/tests/package/static build/dartsweep-static && touch build/static.made
}
step_long() { # DSW_EFFORT=10 asks for ten times the cases
  local left_out="benchmark/error;outside;capi;cpp;boundary;portable;bindings;unit/walk;unit/corridor;unit/contact;unit/walls;unit/capi"
  one_at_a_time make_programs && ctest --preset self_tests && "${plain_addresses[@]}" ctest --preset long &&
    cmake --preset dev -DDSW_FUZZ_EFFORT=20 -DDSW_SANITIZE_LESS= "-DDSW_LEFT_OUT_TESTS=$left_out" &&
    cmake --build --preset dev && "${plain_addresses[@]}" ctest --preset dev_long && with_library dev_library_long dev "$(asan_runtime)" &&
    cmake --preset dev && cmake --preset tsan && cmake --build --preset tsan &&
    with_library tsan_long tsan "$(tsan_runtime)"
}
step_clang() { preset clang all; }
step_components() { # each left out alone: what is left links, and has all functions
  local component
  for component in $(sed -n 's/^dsw_component(\([A-Z]*\) .*/\1/p' src/cmake/components.cmake); do
    cmake --preset release -B build/components -DDSW_BUILD_TESTS=OFF -DDSW_BUILD_EXAMPLES=OFF "-DDSW_WITH_$component=OFF" &&
      cmake --build build/components --target dartsweep &&
      python3 -B abi/check_abi.py symbols build/components/src/libdartsweep.so &&
      cmake "-DDSW_WITH_$component=ON" build/components || return
  done
}
step_dev() { preset dev all && with_library dev_library dev "$(asan_runtime)"; }
step_tsan() { cmake --preset tsan && cmake --build --preset tsan && with_library tsan tsan "$(tsan_runtime)"; }
step_arm64() { target arm64; }
step_windows() { start_wine && target windows; }
step_wasm() {
  export NODE_PATH=/usr/share/nodejs # where Debian's emscripten has its modules, whichever Node runs it
  target wasm
}
step_portable() {
  local programs=build tests=tests/portable/dartsweep_portable kernel target runners=()
  cmake --preset release && cmake --build --preset release --target dartsweep_portable || return
  for target in windows arm64 wasm; do
    [ ! -e "build/$target/CMakeCache.txt" ] || cmake --build --preset "$target" --target dartsweep_portable || return
  done
  for kernel in portable avx2 avx512; do runners+=(--runner "x64-$kernel" "$kernel" "" "$programs/release/$tests"); done
  if [ -e $programs/windows/$tests.exe ]; then runners+=(--runner windows - /usr/lib/wine/wine64 $programs/windows/$tests.exe); fi
  if [ -e $programs/arm64/$tests ]; then runners+=(--runner arm64 - "qemu-aarch64 -L /usr/aarch64-linux-gnu" $programs/arm64/$tests); fi
  if [ -e $programs/wasm/$tests.js ]; then runners+=(--runner wasm - node $programs/wasm/$tests.js); fi
  start_wine
  python3 -B tests/portable/targets.py --work build/portable "${runners[@]}"
}
step_packages() {
  bindings/packages/build.sh build/packages linux-x64 linux-arm64 win-x64 osx-arm64 osx-x64 wasm32 && bindings/packages/check.sh build/packages
}
step_browser() { examples/browser/test.sh; }
step_python() { install_python && install_library && bindings/python/test.sh "$rod"; }
step_docs() { install_python && bindings/docs/build.sh build/python/venv/bin/python; }
step_java() { install_static_library && bindings/java/test.sh build/dartsweep-static/prefix; }
step_csharp() { install_static_library && bindings/csharp/test.sh build/dartsweep-static/prefix; }
step_lua() { install_library && bindings/lua/test.sh build/dartsweep; }
step_node() { install_static_library && bindings/node/test.sh build/dartsweep-static/prefix; }
step_page() { examples/insertion/page/test.sh; }
step_report() { examples/report/tests/run.sh; }
step_format() {
  local files
  mapfile -t files < <(find src include tests examples bindings -regex '.*\.\(h\|hpp\|inl\|c\|cpp\)' | sort)
  clang-format-14 --dry-run -Werror "${files[@]}" && echo "format: ${#files[@]} files in order"
}

mkdir -p build
rm -rf build/{python,static}.made build/bytecode # left by an earlier run
for step in "${steps[@]}"; do
  declare -F "step_$step" >/dev/null || {
    echo "no step '$step'"
    exit 2
  }
done
for step in "${steps[@]}"; do
  if [[ $single == *" $step "* ]]; then
    wait_until_running $((jobs - 1))
    run_step "$step" &
    running=$((running + 1))
  else
    wait_until_running 0
    run_step "$step" || failed=1
  fi
done
wait_until_running 0

echo
echo "== summary after $SECONDS s"
for step in "${steps[@]}"; do cat "build/$step.summary"; done
exit $failed
