#!/usr/bin/env bash
# The tests of the rock in a tree of its own, and what uses it from there: bindings/lua/test.sh FOLDER, where Dartsweep is installed.
set -euo pipefail
library=$(cd "$1" && pwd)
cd "$(dirname "$0")/../.."
source=bindings/lua
out=$PWD/build/lua
rocks=$out/rocks
export LUA_PATH="$rocks/share/lua/5.4/?.lua;$source/tests/?.lua;;" LUA_CPATH="$rocks/lib/lua/5.4/?.so;;"

mkdir -p "$out/source"
rm -f "$out/source/$source"/*.rockspec # of other versions
cp -a bindings include "$out/source" # LuaRocks builds beside the sources
(cd "$out/source/$source" && luarocks --lua-version=5.4 --tree="$rocks" make "DARTSWEEP_DIR=$library")
lua5.4 $source/tests/tests.lua bindings/tests/scenario.json | tee "$out/tests.txt"
cc $source/tests/threads.c -o "$out/threads" -pthread $(pkg-config --cflags --libs lua5.4)
"$out/threads" bindings/tests/scenario.json
lua5.4 $source/examples/catheter.lua
python3 bindings/tests/readme_code.py $source/README.md lua >"$out/readme.lua"
lua5.4 "$out/readme.lua" | grep "vertex 1 met x = 1.0 after 0.5"
echo "lua: $(sed -n 's/^Ran \([0-9]*\) tests.*/\1/p' "$out/tests.txt") tests passed, and the example"
