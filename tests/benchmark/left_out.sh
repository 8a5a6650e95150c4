#!/usr/bin/env bash
# What is left out: tests/benchmark/left_out.sh [--quick] [FOLDER]
#
# Measures what a scene pays for each level, feature and flag, on and off, and how large the library is with and without its optional
# part. Writes left_out.csv, library_size.csv and left_out.json to FOLDER (build/report if not given). Installs what is missing
# (Debian 12, as root) and builds a release in build/bench.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
here=$root/tests/benchmark
tree=$root/build/bench
folder=$root/build/report
steps=400
for argument in "$@"; do
  case $argument in
    --quick) steps=60 ;;
    -h | --help)
      sed -n '2,6s/^# \{0,1\}//p' "$0"
      exit 0
      ;;
    -*)
      echo "left_out: unknown argument $argument" >&2
      exit 2
      ;;
    *) folder=$argument ;;
  esac
done

missing=()
command -v c++ > /dev/null || missing+=(g++)
for tool in cmake:cmake make:make pkg-config:pkg-config strip:binutils python3:python3; do
  command -v "${tool%%:*}" > /dev/null || missing+=("${tool##*:}")
done
# The tree is that of run.sh, so its peers have to be there, too.
for header in embree3/rtcore.h:libembree-dev bullet/btBulletCollisionCommon.h:libbullet-dev CGAL/version.h:libcgal-dev box2d/box2d.h:libbox2d-dev \
  gmpxx.h:libgmp-dev nlohmann/json.hpp:nlohmann-json3-dev CLI/CLI.hpp:libcli11-dev gtest/gtest.h:libgtest-dev \
  eigen3/Eigen/Core:libeigen3-dev ccd/ccd.h:libccd-dev; do
  found=
  for place in /usr/include /usr/local/include /usr/include/*-linux-gnu; do
    if [ -e "$place/${header%%:*}" ]; then found=1; fi
  done
  [ -n "$found" ] || missing+=("${header##*:}")
done
if [ ${#missing[@]} -gt 0 ]; then
  [ "$(id -u)" = 0 ] || { echo "left_out: please install ${missing[*]}" >&2; exit 1; }
  echo "installing ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends "${missing[@]}" > /dev/null
fi

mkdir -p "$tree" "$folder"
cmake -S "$root" -B "$tree" -DCMAKE_BUILD_TYPE=Release -DDSW_BUILD_BENCH=ON -DDSW_BUILD_TESTS=ON \
  -DDSW_BUILD_EXAMPLES=OFF -DDSW_WITH_LIBCCD=ON > "$tree-configure.log" || { cat "$tree-configure.log" >&2; exit 1; }
cmake --build "$tree" -j "$(nproc)" --target dartsweep_left_out dartsweep_left_out_core > "$tree-build.log" ||
  { tail -n 20 "$tree-build.log" >&2; exit 1; }

bench=$tree/tests/benchmark
"$bench/dartsweep_left_out" --steps "$steps" --csv "$folder/left_out.csv" --json "$tree/left_out.json"
for build in dartsweep_left_out dartsweep_left_out_core; do  # each alone, so that both are measured alike
  "$bench/$build" --steps "$steps" --libccd-only --csv "$tree/libccd.csv" --json "$tree/libccd.json"
  tail -n 1 "$tree/libccd.csv" >> "$folder/left_out.csv"
done
python3 "$here/library_size.py" "$folder" "$tree/left_out.json" \
  "not built:$bench/libdartsweep_core.so" "built:$tree/src/libdartsweep.so"
echo "wrote $folder/left_out.csv, library_size.csv and left_out.json"
