#!/bin/sh
# usage: abi/renew.sh "what changed; what the caller does"
# Renews everything here that freezes the binary interface, and writes the reason into CHANGELOG.md. Allowed before the
# first release, and after it for additions only.
set -eu
cd "$(dirname "$0")/.."
if [ $# -ne 1 ] || [ -z "$1" ]; then
  sed -n 2,4p abi/renew.sh
  exit 1
fi
version=$(sed -n 's/^project(Dartsweep VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
client=abi/clients/$version

cmake --preset abi
cmake --build --preset abi --target dartsweep
library=build/abi/src/libdartsweep.so
python3 abi/check_abi.py write-symbols "$library"
mkdir -p abi/baseline
abidw --headers-dir include --exported-interfaces-only --drop-private-types --no-corpus-path --no-comp-dir-path \
  --no-parameter-names --out-file build/abi/libdartsweep.abi "$library"
# Where a type is defined tells public from private, so file names stay, without this machine's folders.
sed "s#$PWD/##g" build/abi/libdartsweep.abi > abi/baseline/libdartsweep.abi
# A release that is out keeps its headers for ever; only the version in work follows the current ones.
if ! git rev-parse -q --verify "refs/tags/v$version" >/dev/null; then
  mkdir -p "$client/include/dartsweep"
  cp include/dartsweep/*.h "$client/include/dartsweep/"
fi
python3 - "$1" <<'PY'
import datetime, pathlib, sys
path = pathlib.Path("CHANGELOG.md")
head, mark, tail = path.read_text().partition("### ABI baseline\n")
line = f"- {datetime.date.today().isoformat()}: {sys.argv[1]}\n"
if not mark:
    sys.exit("CHANGELOG.md has no section '### ABI baseline' in the version in work")
path.write_text(head + mark + line + tail)
PY
echo "renewed; layout.c is edited by hand: ctest --preset abi says what is wrong there"
