#!/bin/sh
# usage: abidiff.sh LIBRARY      compares a library (with debug information) with baseline/
#        abidiff.sh --self-test  proves that a changed struct is refused and that hidden changes are not
# New functions and enum values pass, everything else needs a renewed baseline.
set -u
here=$(cd "$(dirname "$0")" && pwd)

compare() { # BASELINE HEADERS LIBRARY
  abidiff --no-added-syms --drop-private-types --headers-dir2 "$2" "$1" "$3"
}

if [ "$1" = --self-test ]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  cd "$folder" || exit 1
  build() { # NAME PUBLIC_MEMBERS PRIVATE_MEMBERS MORE_CODE
    mkdir "$1"
    printf 'struct dsw_hidden;\nstruct dsw_info { %s };\n' "$2" > "$1/api.h"
    printf '#include "api.h"\nstruct dsw_hidden { %s };\nint dsw_get(struct dsw_hidden *h, struct dsw_info *i)\n%s\n' \
      "$3" "{ return h->a + i->a; } $4" > "$1/lib.c"
    gcc -g -shared -fPIC -I"$1" "$1/lib.c" -o "$1/lib.so"
  }
  build old 'int a;' 'int a;' ''
  build hidden 'int a;' 'int b, a;' 'int dsw_more(void) { return 1; }'
  build moved 'int b, a;' 'int a;' ''
  abidw --headers-dir old --drop-private-types --out-file old.abi old/lib.so || exit 1
  compare old.abi hidden hidden/lib.so || { echo "a hidden change and a new function were refused"; exit 1; }
  compare old.abi moved moved/lib.so > moved.txt && { echo "a moved member was accepted"; exit 1; }
  grep -q "dsw_info" moved.txt || { cat moved.txt; exit 1; }
  echo "abidiff refuses what it should"
  exit 0
fi

baseline=$here/baseline/libdartsweep.abi
if [ ! -f "$baseline" ]; then
  echo "no baseline: make one with abi/renew.sh"
  exit 1
fi
compare "$baseline" "$here/../include" "$1"
status=$?
if [ $status -ne 0 ]; then
  echo "abidiff answers $status: the binary interface is not what abi/baseline says. README.md tells what is allowed;"
  echo "abi/renew.sh renews the baseline and writes the line in CHANGELOG.md that tells callers."
  exit 1
fi
echo "compatible with the baseline"
