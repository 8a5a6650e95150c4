#!/usr/bin/env bash
# A source of the engine has changed: tests/one.sh SOURCE builds it and runs the first tests of its module (tests/modules.txt)
#
# It is meant to take up to 15 seconds on two cores, if only this source has changed since the last run. The first run compiles the
# engine in build/one, each source by itself and at -O1. Random cases are a quarter of the suite's. Exit code 2: no source of a module;
# 1: the build or a test failed.
set -euo pipefail
case "${1:-}" in
  '' | -h | --help)
    sed -n '2,6s/^# \{0,1\}//p' "$0"
    [ -n "${1:-}" ] || exit 2
    exit 0
    ;;
esac
source=$(realpath "$1")
cd "$(dirname "$0")/.."
root=$PWD
module=${source#"$root"/src/}
name=$(basename "${module%.*}")
module=${module%%/*}
programs=$(awk -v module="$module" '$1 == module { $1 = ""; print }' tests/modules.txt)
[ -f "$source" ] && [ -n "$programs" ] || { echo "one: '$1' is no source of a module that tests/modules.txt names" >&2; exit 2; }
if [ "$module" = capi ] && [ -e "tests/capi/${name}_test.c" ]; then programs+=" capi_${name}_test"; fi

jobs=$(nproc)
tree=build/one
[ -e "$tree/build.ninja" ] || cmake --preset one -G Ninja > /dev/null
cmake --build "$tree" -j "$jobs" --target $programs

# run PROGRAM: shows what it says only if it fails.
run() {
  local file said
  file=$(find "$tree/tests" -name "$1" -type f)
  said=$("$file" 2>&1) || { printf '%s\n%s failed\n' "$said" "$1"; return 1; }
  echo "$1 passed"
}
export tree DSW_EFFORT=${DSW_EFFORT:-1/4}
export -f run
printf '%s\n' $programs | sort -u | xargs -P "$jobs" -I{} bash -c 'run {}'
