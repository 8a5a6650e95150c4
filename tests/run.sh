#!/usr/bin/env bash
# Everything that must pass, in one command, on a fresh Debian 12 as root: installs what is missing, builds and tests
# every configuration, and ends with ctest's closing lines of all of them. Exits 0 only if all passed.
# usage: tests/run.sh [STEP...]    steps: release clang dev tsan abi fuzz python docs java csharp lua node page report format; none means all
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(g++ clang clang-format-14 libclang-rt-14-dev cmake ninja-build pkg-config python3 binutils file dpkg-dev abigail-tools
  libccd-dev libeigen3-dev libgtest-dev libgmp-dev libcli11-dev nlohmann-json3-dev swig python3-dev python3-venv
  openjdk-17-jdk-headless maven mono-mcs mono-runtime doxygen libosmesa6
  lua5.4 liblua5.4-dev lua-unit luarocks)
steps=("$@")
[ ${#steps[@]} -gt 0 ] || steps=(release clang dev tsan abi fuzz python docs java csharp lua node page report format)
jobs=$(nproc)
export CMAKE_GENERATOR=Ninja CTEST_PARALLEL_LEVEL=$jobs CMAKE_BUILD_PARALLEL_LEVEL=$jobs

# Real meshes: tests that want them skip, visibly, where there are none.
if [ -z "${DARTSWEEP_DATA:-}" ] && [ -d ../shared/data ]; then
  DARTSWEEP_DATA=$(cd ../shared/data && pwd)
  export DARTSWEEP_DATA
fi

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

# Of where memory came from one frame is kept: GMP's frames can't be unwound, and storing what comes of that took most of the time.
# With a leak to find, run ctest --preset dev without it.
export ASAN_OPTIONS=malloc_context_size=1

summary=()
failed=0

# run_step NAME COMMAND...: keeps the output in build/NAME.log, shows it only when something is wrong.
run_step() {
  local name=$1 start=$SECONDS log=build/$1.log status=0
  shift
  echo "== $name"
  "$@" >"$log" 2>&1 || status=$?
  if [ $status -ne 0 ]; then
    failed=1
    tail -n 150 "$log"
  fi
  local lines
  lines=$(grep -E '^(100|[0-9]+)% tests passed|^Total Test time|^No tests were found|^format:|^(python|docs|java|csharp|lua|node):|^abi\.|^# (pass|fail) [0-9]+|^Ran [0-9]+ tests' "$log" || true)
  [ $status -eq 0 ] || lines+=$'\nFAILED, see '$log
  summary+=("$name ($((SECONDS - start)) s)"$'\n'"$lines")
  echo "$lines"
}

# preset NAME CTEST_ARGUMENTS -- TARGETS...
preset() {
  local name=$1
  shift
  local test_arguments=()
  while [ "$1" != -- ]; do
    test_arguments+=("$1")
    shift
  done
  shift
  cmake --preset "$name" && cmake --build --preset "$name" --target "$@" &&
    "${plain_addresses[@]}" ctest --preset "$name" --no-tests=error "${test_arguments[@]}"
}

check_binary_interface() {
  preset abi -- dartsweep abi_programs && python3 abi/check_abi.py symbols build/abi/src/libdartsweep.so
}

# The wheel as users get it, built from the source distribution and with a tag of the systems that it is for; but its library is that of
# the release preset. In build/python/venv, with all that is used with it.
install_python() {
  local source=bindings/python out=$PWD/build/python
  local venv=$out/venv
  mkdir -p "$out"
  cmake --preset release && cmake --build --preset release --target dartsweep &&
    cmake --install build/release --prefix "$out/dartsweep" || return 1
  cat bindings/{python/tests,docs}/requirements.txt examples/planning/requirements.txt >"$out/requirements.txt" || return 1
  if ! cmp -s "$out/requirements.txt" "$venv/installed.txt"; then
    # Not that of a version manager: python3-dev belongs to this one.
    /usr/bin/python3 -m venv --clear "$venv" && "$venv/bin/pip" install -q -r "$out/requirements.txt" || return 1
    cp "$out/requirements.txt" "$venv/installed.txt"
  fi
  rm -rf "$out/dist"
  "$venv/bin/python" -m build --no-isolation --skip-dependency-check --outdir "$out/dist" \
    -Ccmake.define.DSW_USE_INSTALLED=ON -Ccmake.define.CMAKE_PREFIX_PATH="$out/dartsweep" $source &&
    PATH=$venv/bin:$PATH auditwheel repair --wheel-dir "$out/dist/tagged" "$out"/dist/*.whl &&
    "$venv/bin/pip" install -q --no-deps --force-reinstall "$out"/dist/tagged/*-manylinux*.whl
}

check_python() {
  local source=bindings/python out=$PWD/build/python
  local venv=$out/venv
  install_python && "$venv/bin/python" -m pytest $source --junitxml="$out/tests.xml" || return 1
  for example in $source/examples/*.py; do "$venv/bin/python" "$example" || return 1; done
  "$venv/bin/python" -m pytest examples/planning || return 1
  echo "python: $(grep -o 'tests="[0-9]*"' "$out/tests.xml" | tr -dc 0-9) tests passed, and the examples"
}

# The pages, with what the headers and the package say of themselves.
check_docs() { install_python && bindings/docs/build.sh build/python/venv/bin/python; }

# The library of the release preset as others find it, in build/dartsweep.
install_library() {
  cmake --preset release && cmake --build --preset release --target dartsweep &&
    cmake --install build/release --prefix build/dartsweep
}

# The jar, and the example with what it takes from a repository: one of its own, so that no other version is there.
check_java() {
  local source=bindings/java out=$PWD/build/java
  local mvn=(mvn -q -B "-Dmaven.repo.local=$PWD/build/maven")
  rm -rf "$out/maven/target/surefire-reports"
  install_library && cmake -S $source -B "$out" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$PWD/build/dartsweep" &&
    cmake --build "$out" && "${mvn[@]}" -f $source/pom.xml "-Dnative=$out/maven" install &&
    "${mvn[@]}" -f $source/examples/pom.xml "-Doutput=$out/example" compile exec:exec || return 1
  if grep -l "WARNING in native method" "$out"/maven/target/surefire-reports/*; then return 1; fi # by -Xcheck:jni
  printf '\njava: %s tests passed, and the example\n' "$(grep -ho '<testcase ' "$out"/maven/target/surefire-reports/*.xml | wc -l)"
}

# The assembly with a module that has the library in it, then the NuGet package as a program finds it, with nothing else of ours on its way,
# and the sources of the one for Unity, which compiles them itself.
check_csharp() {
  local source=bindings/csharp out=$PWD/build/csharp library=$PWD/build/dartsweep-static
  local package=$out/package program=$out/example unity=$out/unity
  cmake --preset release && cmake --build --preset release --target dartsweep_internal &&
    CC=cc CXX=c++ tests/package/package_test.sh static "$PWD/build/release" "$library" &&
    cmake -S $source -B "$out" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$library/prefix" && cmake --build "$out" &&
    ! readelf -d "$package"/native/*.so | grep NEEDED | grep -Ev '\[(lib(c|m|gcc_s|stdc\+\+)|ld-linux)' && cp "$package/native"/* "$package" &&
    mcs -nologo -out:"$package/tests.exe" -r:"$package/Dartsweep.dll" $source/tests/*.cs || return 1
  mono --debug "$package/tests.exe" bindings/tests/scenario.json | tee "$out/tests.txt" || return 1
  python3 $source/pack.py $source/Dartsweep.nuspec "$package" "$out" && rm -rf "$program" &&
    python3 -m zipfile -e "$out"/Dartsweep.*.nupkg "$program" &&
    cp "$program"/lib/net45/* "$program"/runtimes/linux-x64/native/* "$program" &&
    mcs -nologo -out:"$program/catheter.exe" -r:"$program/Dartsweep.dll" $source/examples/Catheter.cs && mono "$program/catheter.exe" &&
    mcs -nologo -unsafe -nowarn:1591 -out:"$unity/Plugins/x86_64/catheter.exe" $source/examples/Catheter.cs "$unity"/Runtime/*.cs &&
    mono "$unity/Plugins/x86_64/catheter.exe" || return 1
  echo "csharp: $(tail -n 1 "$out/tests.txt"), and the example"
}

# The npm package, as one installs it.
check_node() {
  install_library && bindings/node/test.sh build/dartsweep
}

# The rock in a tree of its own, and what uses it from there. LuaRocks builds beside the sources: in a copy of them.
check_lua() {
  local source=bindings/lua out=$PWD/build/lua
  local rocks=$out/rocks dartsweep=$PWD/build/dartsweep
  local -x LUA_PATH="$rocks/share/lua/5.4/?.lua;$source/tests/?.lua;;" LUA_CPATH="$rocks/lib/lua/5.4/?.so;;"
  mkdir -p "$out/source" && install_library && cp -a bindings include "$out/source" &&
    (cd "$out/source/$source" && luarocks --lua-version=5.4 --tree="$rocks" make "DARTSWEEP_DIR=$dartsweep") || return 1
  lua5.4 $source/tests/tests.lua bindings/tests/scenario.json | tee "$out/tests.txt" || return 1
  cc $source/tests/threads.c -o "$out/threads" -pthread $(pkg-config --cflags --libs lua5.4) &&
    "$out/threads" bindings/tests/scenario.json && lua5.4 $source/examples/catheter.lua || return 1
  echo "lua: $(sed -n 's/^Ran \([0-9]*\) tests.*/\1/p' "$out/tests.txt") tests passed, and the example"
}

check_format() {
  local files
  mapfile -t files < <(find src include tests examples bindings -regex '.*\.\(h\|inl\|c\|cpp\)' | sort)
  clang-format-14 --dry-run -Werror "${files[@]}" && echo "format: ${#files[@]} files in order"
}

mkdir -p build
for step in "${steps[@]}"; do
  case $step in
    release) run_step release preset release -- all ;;
    clang) run_step clang preset clang -- all ;;
    dev) run_step dev preset dev -- all ;;
    tsan) run_step tsan preset tsan -- threads_tests ;;
    abi) run_step abi check_binary_interface ;;
    fuzz) run_step fuzz preset fuzz -- all ;;
    python) run_step python check_python ;;
    docs) run_step docs check_docs ;;
    java) run_step java check_java ;;
    csharp) run_step csharp check_csharp ;;
    node) run_step node check_node ;;
}

    lua) run_step lua check_lua ;;
    format) run_step format check_format ;;
    page) run_step page examples/insertion/page/test.sh ;;
    report) run_step report examples/report/tests/run.sh ;;
    *) echo "no step '$step'"; exit 2 ;;
  esac
done

echo
echo "== summary after $SECONDS s"
printf '%s\n' "${summary[@]}"
exit $failed
