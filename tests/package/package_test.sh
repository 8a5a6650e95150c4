#!/bin/sh
# usage: package_test.sh shared SOURCE WORK C_COMPILER CXX_COMPILER BUILD   installs the tree that BUILD holds
#        package_test.sh static SOURCE WORK C_COMPILER CXX_COMPILER         builds a static library first
# Installs Dartsweep, moves the installation elsewhere, then builds and runs a C host against it by find_package and by
# pkg-config. Whatever is missing in the installation fails here.
set -eu
kind=$1 source=$2 work=$3 cc=$4 cxx=$5
rm -rf "$work"
mkdir -p "$work"

if [ "$kind" = static ]; then
  # Debug: this is about packaging, and unoptimized code compiles fastest.
  cmake -S "$source" -B "$work/build" -DCMAKE_BUILD_TYPE=Debug -DBUILD_SHARED_LIBS=OFF -DDSW_UNITY=ON -DDSW_BUILD_TESTS=OFF \
    -DDSW_BUILD_EXAMPLES=OFF -DCMAKE_C_COMPILER="$cc" -DCMAKE_CXX_COMPILER="$cxx" >"$work/configure.log"
  cmake --build "$work/build" >"$work/build.log"
  build=$work/build
else
  build=$6
fi
cmake --install "$build" --prefix "$work/first" >"$work/install.log"
mv "$work/first" "$work/prefix"
prefix=$work/prefix
library_dir=$(dirname "$(find "$prefix" -name 'libdartsweep.*' | head -n 1)")

echo "headers: the installed ones are the public ones"
diff -r "$source/include/dartsweep" "$prefix/include/dartsweep"

echo "no file names the place it was built in"
if grep -rIl -e "$work/first" -e "$source" "$prefix"; then
  echo "the files above do"
  exit 1
fi

echo "find_package:"
cmake -S "$source/tests/package/consumer" -B "$work/consumer" -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_C_COMPILER="$cc" >"$work/consumer.log"
cmake --build "$work/consumer" >>"$work/consumer.log"
"$work/consumer/consumer"
echo "find_package refuses a version that does not fit:"
mkdir "$work/newer"
sed 's/find_package(Dartsweep 0.1/find_package(Dartsweep 0.2/' "$source/tests/package/consumer/CMakeLists.txt" \
  >"$work/newer/CMakeLists.txt"
cp "$source/tests/package/consumer/main.c" "$work/newer"
if cmake -S "$work/newer" -B "$work/refused" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$cc" \
  >"$work/refused.log" 2>&1; then
  echo "0.2 was accepted"
  exit 1
fi
grep -q 'compatible' "$work/refused.log"

echo "pkg-config:"
export PKG_CONFIG_PATH="$library_dir/pkgconfig"
flags=$(pkg-config --cflags --libs dartsweep)
# shellcheck disable=SC2086  # flags are words
"$cc" -std=c99 -Wall -Wextra -Wpedantic -Werror "$source/tests/package/consumer/main.c" $flags -o "$work/by_pkg_config"
LD_LIBRARY_PATH=$library_dir "$work/by_pkg_config"
if [ "$kind" = static ]; then
  echo "pkg-config --static, a program without any shared library:"
  flags=$(pkg-config --static --cflags --libs dartsweep)
  # shellcheck disable=SC2086
  "$cc" -static -std=c99 "$source/tests/package/consumer/main.c" $flags -o "$work/all_static"
  "$work/all_static"
fi
