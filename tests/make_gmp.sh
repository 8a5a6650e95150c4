#!/usr/bin/env bash
# GMP for another target, from Debian's sources, static, in PREFIX: Debian has it compiled for Linux alone.
# usage: tests/make_gmp.sh arm64|windows|wasm PREFIX
set -euo pipefail
target=$1
prefix=$(realpath -m "$2")
[ ! -e "$prefix/lib/libgmpxx.a" ] || exit 0

work=$prefix/work
mkdir -p "$work"
# The archive's sources, whether the machine has them among its own or not.
lists=$work/lists
mkdir -p "$lists/partial"
sources=(/etc/apt/sources.list.d/debian.sources)
[ -e "${sources[0]}" ] || sources=(/etc/apt/sources.list)
case ${sources[0]} in
  *.sources) sed 's/^Types:.*/Types: deb-src/' "${sources[0]}" >"$work/apt.sources" ;;
  *) sed -n 's/^deb /deb-src /p' "${sources[0]}" >"$work/apt.list" ;;
esac
options=(-qq -o Dir::Etc::sourcelist="$(echo "$work"/apt.*)" -o Dir::Etc::sourceparts=- -o Dir::State::lists="$lists" -o APT::Sandbox::User=root)
(cd "$work" && apt-get "${options[@]}" update && apt-get "${options[@]}" source gmp)
cd "$work"/gmp-*/
mkdir -p doc
printf 'all install:\n' >doc/Makefile.in # Debian leaves the manual out

options=(--prefix="$prefix" --enable-cxx --disable-shared)
case $target in
  arm64) options+=(--host=aarch64-linux-gnu) ;;
  windows) options+=(--host=x86_64-w64-mingw32 CC=x86_64-w64-mingw32-gcc-posix CXX=x86_64-w64-mingw32-g++-posix) ;;
  wasm)
    export NODE_PATH=/usr/share/nodejs # where Debian's emscripten has its modules, whichever Node runs it
    options+=(--host=none --disable-assembly CC=emcc CXX=em++ CC_FOR_BUILD=cc CXXFLAGS="-O2 -fwasm-exceptions")
    ;;
esac
run=()
if [ "$target" = wasm ]; then run=(emconfigure); fi
"${run[@]}" ./configure "${options[@]}"
make -j"$(nproc)" MAKEINFO=true
make MAKEINFO=true install
rm -rf "$work"
