#!/bin/sh
# usage: package_test.sh shared|static|debian BUILD WORK     CC and CXX name the compilers
# Installs what BUILD has compiled and moves that elsewhere, or makes Debian's packages of it and unpacks them; then builds and runs a C
# host against it by find_package and by pkg-config. Whatever is missing in the installation fails here.
set -eu
kind=$1 build=$2 work=$3
source=$(cd "$(dirname "$0")/../.." && pwd)
prefix=$work/prefix
rm -rf "$work"
mkdir -p "$work"

# configure OPTIONS...: a build like BUILD but for the options, which gets the library that BUILD has compiled.
configure() {
  # shellcheck disable=SC2046  # options are words
  cmake -S "$source" -B "$work/build" $(sed -nE 's/^(CMAKE_BUILD_TYPE|DSW_WITH_LIBCCD):[^=]*=/-D\1=/p' "$build/CMakeCache.txt") \
    -DDSW_BUILD_TESTS=OFF -DDSW_BUILD_EXAMPLES=OFF "$@" >"$work/configure.log"
}

install_and_move() {
  DESTDIR=$work/stage cmake --install "$1" --prefix /opt/first >"$work/install.log"
  mv "$work/stage/opt/first" "$prefix"
}

# same EXPECTED VALUE
same() {
  if [ "$1" != "$2" ]; then
    echo "expected '$1', got '$2'" >&2
    exit 1
  fi
}

# What of the packages an installation does not show: names, dependencies, and that the runtime's has the library alone.
check_packages() {
  soname=$(objdump -p "$build/src/libdartsweep.so" | sed -n 's/.*SONAME *//p')
  major=${soname##*.} version=$(dpkg-deb -f "$2" Version)
  name=libdartsweep$major
  same "$name" "$(dpkg-deb -f "$1" Package)"
  same "$name (= $version)" "$(dpkg-deb -f "$2" Depends)"
  dpkg-deb -f "$1" Depends | grep 'libc6 .*libstdc++6 '
  same "libdartsweep $major $name (>= $version)" "$(dpkg-deb -I "$1" shlibs)"
  dpkg-deb -I "$1" postinst | grep ldconfig
  arch=$(dpkg-architecture -q DEB_HOST_MULTIARCH)
  file=$(basename "$(readlink -f "$build/src/libdartsweep.so")")
  same "$(printf './usr/%s\n' "lib/$arch/$soname" "lib/$arch/$file" "share/doc/$name/copyright")" \
    "$(dpkg-deb --fsys-tarfile "$1" | tar -t | grep -v '/$' | sort)"
  apt-get --simulate install "$1" "$2" # their dependencies can be had, and they can be installed together
}

case $kind in
  shared) install_and_move "$build" ;;
  static)
    configure -DBUILD_SHARED_LIBS=OFF
    cp "$build/src/libdartsweep_internal.a" "$work/build/src/libdartsweep.a"
    install_and_move "$work/build"
    ;;
  debian)
    configure -DCMAKE_INSTALL_PREFIX=/usr
    cp -P "$build"/src/libdartsweep.so* "$work/build/src"
    cpack --config "$work/build/CPackConfig.cmake" -B "$work/packages" >"$work/cpack.log"
    check_packages "$work"/packages/libdartsweep[0-9]*.deb "$work"/packages/libdartsweep-dev_*.deb >"$work/packages.log"
    for package in "$work"/packages/*.deb; do dpkg-deb -x "$package" "$work/unpacked"; done
    prefix=$work/unpacked/usr
    ;;
esac
library_dir=$(dirname "$(find "$prefix" -name 'libdartsweep.*' | head -n 1)")

echo "headers: the installed ones are the public ones"
diff -r "$source/include/dartsweep" "$prefix/include/dartsweep"

echo "no file names the place it was built in"
if grep -rIl -e "$work/stage" -e /opt/first -e "$source" "$prefix"; then
  echo "the files above do"
  exit 1
fi

# consumer NAME SED: a host whose CMakeLists.txt the expression alters, configured in WORK/NAME/build.
consumer() {
  cp -r "$source/tests/package/consumer" "$work/$1"
  sed -i "$2" "$work/$1/CMakeLists.txt"
  cmake -S "$work/$1" -B "$work/$1/build" -DCMAKE_PREFIX_PATH="$prefix" >"$work/$1.log" 2>&1
}

echo "find_package, in a project in C and in one that has C++ as well:"
for languages in C "C CXX"; do
  consumer "in $languages" "s/LANGUAGES C/LANGUAGES $languages/"
  cmake --build "$work/in $languages/build" >>"$work/in $languages.log"
  "$work/in $languages/build/consumer"
  cpp="$work/in $languages/build/consumer_cpp"
  [ "$languages" = C ] || "$cpp"
done
echo "find_package refuses a version that does not fit, and components that are not there:"
if consumer newer 's/find_package(Dartsweep [0-9]*/&9/'; then exit 1; fi
grep -q compatible "$work/newer.log"
if consumer components 's/REQUIRED/& COMPONENTS nothing/'; then exit 1; fi
grep -q 'set Dartsweep_FOUND to FALSE' "$work/components.log"

echo "pkg-config:"
export PKG_CONFIG_PATH="$library_dir/pkgconfig"
flags=$(pkg-config --cflags --libs dartsweep)
# shellcheck disable=SC2086  # flags are words
"$CC" -std=c99 -Wall -Wextra -Wpedantic -Werror "$source/tests/package/consumer/main.c" $flags -o "$work/by_pkg_config"
LD_LIBRARY_PATH=$library_dir "$work/by_pkg_config"
flags=$(pkg-config --static --cflags --libs dartsweep)
if [ "$kind" = static ] && [ "${flags#*-lccd}" = "$flags" ]; then # Debian has no static libccd
  echo "pkg-config --static, a program without any shared library:"
  # shellcheck disable=SC2086
  "$CC" -static -std=c99 "$source/tests/package/consumer/main.c" $flags -o "$work/all_static"
  "$work/all_static"
fi
