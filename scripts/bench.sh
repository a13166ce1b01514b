#!/usr/bin/env bash
# Builds the preset `release`, runs the benchmarks of speed, stores their results under
# benchmarks/results, named by the machine, and prints them.
# Usage: scripts/bench.sh [quick|full]
set -euo pipefail
cd "$(dirname "$0")/.."

extent=${1:-quick}
[ "$extent" = quick ] || [ "$extent" = full ] || {
  echo "usage: scripts/bench.sh [quick|full]" >&2
  exit 1
}
scripts/install-deps.sh
cmake --preset release >/dev/null
cmake --build --preset release --target raster_benchmark io_benchmark -- --quiet

model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1)
machine=$(printf '%s-%s-threads' "${model:-unknown}" "$(nproc)" | tr -cs '[:alnum:]-' '-')
mkdir -p benchmarks/results
echo "machine   ${model:-unknown}, $(nproc) threads, load $(cut -d' ' -f1 /proc/loadavg)"
build/release/benchmarks/raster_benchmark "$extent" --json "benchmarks/results/raster-$machine.json"
build/release/benchmarks/io_benchmark | tee "benchmarks/results/io-$machine.txt"
echo "results   benchmarks/results/{raster,io}-$machine.*"
