#!/bin/sh
# usage: abi/renew.sh "what was added; what the caller does"
# Renews symbols.txt after an addition to the interface, and writes it into CHANGELOG.md.
set -eu
cd "$(dirname "$0")/.."
if [ $# -ne 1 ] || [ -z "$1" ]; then
  sed -n 2,3p abi/renew.sh
  exit 1
fi
cmake --preset release
cmake --build --preset release --target dartsweep
python3 -B abi/check_abi.py write-symbols build/release/src/libdartsweep.so
python3 - "$1" <<'PY'
import datetime, pathlib, sys
path = pathlib.Path("CHANGELOG.md")
head, mark, tail = path.read_text().partition("### ABI baseline\n")
line = f"- {datetime.date.today().isoformat()}: {sys.argv[1]}\n"
if not mark or "] - unreleased" not in head:
    sys.exit("CHANGELOG.md has no section '### ABI baseline' in the version in work")
path.write_text(head + mark + line + tail)
PY
echo "renewed; layout.c and tests/capi/struct_size_test.c are edited by hand: ctest --preset release -L abi says what they lack"
