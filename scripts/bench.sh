#!/usr/bin/env bash
# Builds the preset `release`, runs the benchmarks of speed, stores their results as
# benchmarks/results/<what>-<machine>.json (<what>-full for full), and prints README.md's tables of
# them; what the benchmarks say meanwhile goes to the error stream. quick takes about five minutes
# and 1 GB on a quiet machine, full hours.
#   WHAT: raster (the CPU rasterizer), io, backends (OpenGL beside the CPU), pipeline (whole runs by
#   each backend); default: all
#   --readme: also puts the tables into README.md, in the place of those there; quick only
# Usage: scripts/bench.sh [quick|full] [--readme] [WHAT]...
set -euo pipefail
cd "$(dirname "$0")/.."
source benchmarks/names.sh

extent=quick
readme=
wanted=()
for argument in "$@"; do
  case $argument in
    quick | full) extent=$argument ;;
    --readme) readme=yes ;;
    raster | io | backends | pipeline) wanted+=("$argument") ;;
    *)
      echo "usage: scripts/bench.sh [quick|full] [--readme] [raster|io|backends|pipeline]..." >&2
      exit 1
      ;;
  esac
done
[ -n "${wanted[*]}" ] || wanted=(raster io backends pipeline)
[ "$extent" = quick ] || [ -z "$readme" ] || {
  echo "bench.sh: README.md has the tables of quick" >&2
  exit 1
}

scripts/install-deps.sh >&2
cmake --preset release >/dev/null
cmake --build --preset release --target raster_benchmark io_benchmark backend_benchmark rangezip \
  -- --quiet >&2

revision=$(revision) # before results are stored, which change the working tree
results=benchmarks/results
mkdir -p "$results"

# store WHAT COMMAND [ARGUMENT...]: runs a benchmark, stores what it says, prints where.
store() {
  local file
  file=$results/$1-$(machine_name).json
  "${@:2}" --revision "$revision" --json "$file" >&2
  echo "stored in $file" >&2
  echo "$file"
}

suffix=
[ "$extent" = quick ] || suffix=-full
programs=build/release/benchmarks
stored=()
for what in "${wanted[@]}"; do
  case $what in
    raster) file=$(store "raster$suffix" "$programs/raster_benchmark" "$extent") ;;
    io) file=$(store io "$programs/io_benchmark") ;;
    backends) file=$(store "backends$suffix" "$programs/backend_benchmark" "$extent") ;;
    pipeline) file=$(store "pipeline$suffix" benchmarks/pipeline.py "$extent") ;;
  esac
  [ "$what" = io ] || stored+=("$file")
done
[ ${#stored[@]} -eq 0 ] || benchmarks/readme.py ${readme:+--write} "${stored[@]}"
