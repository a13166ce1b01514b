#!/usr/bin/env bash
# Builds the preset `release`, runs the benchmarks of speed, stores their results as
# benchmarks/results/<what>-<machine>.json (raster-full for full), and prints README.md's tables of the CPU rasterizer;
# what the benchmarks say meanwhile goes to the error stream. quick takes two minutes and 1 GB,
# full half an hour and 4 GB.
# Usage: scripts/bench.sh [quick|full]
set -euo pipefail
cd "$(dirname "$0")/.."
source benchmarks/names.sh

extent=${1:-quick}
[ "$extent" = quick ] || [ "$extent" = full ] || {
  echo "usage: scripts/bench.sh [quick|full]" >&2
  exit 1
}
scripts/install-deps.sh >&2
cmake --preset release >/dev/null
cmake --build --preset release --target raster_benchmark io_benchmark -- --quiet >&2

results=benchmarks/results
mkdir -p "$results"

# measure WHAT NAME [ARGUMENT...]: runs WHAT_benchmark, stores what it says as NAME.
measure() {
  local file
  file=$results/$2-$(machine_name).json
  "build/release/benchmarks/$1_benchmark" "${@:3}" --revision "$(revision)" --json "$file" >&2
  echo "stored in $file" >&2
}

name=raster
[ "$extent" = quick ] || name=raster-full
measure raster "$name" "$extent"
measure io io
benchmarks/table.py "$results/$name-$(machine_name).json"
