#!/bin/sh
# usage: abi/release.sh VERSION [break]
# Makes of this tree the release VERSION, but for the commit and the tag: README.md has the list. Can be run again until it is tagged.
# "break": something was removed or changed its meaning since the last release, so the number in the SONAME grows.
set -eu
cd "$(dirname "$0")/.."
version=${1:-}
if ! echo "$version" | grep -Eqx '[0-9]+\.[0-9]+\.[0-9]+' || [ "${2:-break}" != break ]; then
  sed -n 2,4p abi/release.sh
  exit 1
fi
tagged() { git rev-parse -q --verify "refs/tags/v$1" >/dev/null; }
if tagged "$version"; then
  echo "v$version is out: its files do not change"
  exit 1
fi
# escape TEXT: for sed.
escape() { echo "$1" | sed 's/\./\\./g'; }

# The product's version, everywhere. What was to come with a version that never came out comes with this one.
old=$(sed -n 's/^project(Dartsweep VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
if ! grep -Eq "^## \[$(escape "$version")\] - |^## \[$(escape "$old")\] - unreleased" CHANGELOG.md; then
  echo "CHANGELOG.md has no section [$version]"
  exit 1
fi
abi/set_version.sh "$version"
if [ "$old" != "$version" ]; then
  old_pattern=$(escape "$old")
  sed -i "s/^## \[$old_pattern\] - unreleased/## [$version] - unreleased/" CHANGELOG.md
  if ! grep -q "^## \[$old_pattern\] - [0-9]" CHANGELOG.md; then
    sed -i "s/@since $(escape "${old%.*}")\b/@since ${version%.*}/" include/dartsweep/*.h
  fi
fi
sed -i "s/^## \[$version\] - unreleased/## [$version] - $(date +%Y-%m-%d)/" CHANGELOG.md

python3 -B abi/check_abi.py next-version "$version" ${2:+"$2"}

# The baseline. Where a type is defined tells public from private, so file names stay, without this machine's folders.
cmake --preset release
cmake --build --preset release --target dartsweep
mkdir -p build/release/abi/described
library=build/release/abi/described/libdartsweep.so
python3 -B abi/check_abi.py describe c++ "$library"
baseline=abi/baseline/$version
{
  echo "# What $version exports: $(grep -E '^(current|revision|age)' abi/VERSION | tr '\n' ' ')"
  python3 -B abi/check_abi.py names
} >"$baseline.symbols"
abidw --headers-dir include --exported-interfaces-only --drop-private-types --no-corpus-path --no-comp-dir-path \
  --no-parameter-names --out-file build/release/abi/libdartsweep.abi "$library"
sed "s#$PWD/##g" build/release/abi/libdartsweep.abi >"$baseline.abi"

# Hosts of this release: those of the last one, with the headers of today.
client=abi/clients/$version
mkdir -p "$client"
if [ ! -f "$client/client.c" ]; then
  last=$(ls abi/clients | grep -Fvx "$version" | sort -V | tail -n 1)
  cp -r "abi/clients/$last"/client.c "abi/clients/$last"/extension.* "abi/clients/$last/calls" "$client"
  rm -f "$client/calls/answers.txt"
fi
rm -rf "$client/include"
mkdir -p "$client/include/dartsweep"
cp include/dartsweep/*.h "$client/include/dartsweep"

cmake --preset release
cmake --build --preset release --target abi_programs
mkdir -p "$client/kept"
"build/release/abi/abi_client_$version" write "$client/kept" >/dev/null
"build/release/abi/abi_calls_$version" >"$client/calls/answers.txt"
cmake --preset release
ctest --preset release -L abi -LE source
echo
echo "$version is ready: README.md has what is left. Still $old, perhaps rightly:"
git grep -nwF "$old" -- . ":!abi/clients" ":!abi/baseline" ":!CHANGELOG.md" || echo "no text"
git ls-files -- . ":!abi" | grep -F "$old" || echo "no name of a file"
