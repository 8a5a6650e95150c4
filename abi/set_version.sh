#!/bin/sh
# usage: abi/set_version.sh VERSION
# Writes the product's version into header, CMake and bindings. `check_abi.py versions` says whether they and the changelog agree.
set -eu
cd "$(dirname "$0")/.."
version=${1:-}
if ! echo "$version" | grep -Eqx '[0-9]+\.[0-9]+\.[0-9]+'; then
  sed -n 2,3p abi/set_version.sh
  exit 1
fi
old=$(sed -n 's/^project(Dartsweep VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
old_pattern=$(echo "$old" | sed 's/\./\\./g')
set -- $(echo "$version" | tr . ' ')
sed -i -E "s/^(#define DSW_VERSION_MAJOR) [0-9]+/\1 $1/; s/^(#define DSW_VERSION_MINOR) [0-9]+/\1 $2/; s/^(#define DSW_VERSION_PATCH) [0-9]+/\1 $3/" \
  include/dartsweep/base.h
sed -i "s/^project(Dartsweep VERSION [0-9.]*/project(Dartsweep VERSION $version/" CMakeLists.txt
if [ "$old" != "$version" ]; then
  git grep -lwF "$old" -- bindings ':!*lock*' | xargs -r sed -i "s/\b$old_pattern\b/$version/g"
  sed -i "/\"name\": \"dartsweep\"/{n;s/$old_pattern/$version/}" bindings/node/package-lock.json
  git mv "bindings/lua/dartsweep-$old-1.rockspec" "bindings/lua/dartsweep-$version-1.rockspec"
fi
