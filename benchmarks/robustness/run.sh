#!/usr/bin/env bash
# Builds the preset `release`, runs raster_fuzz and stores its result under benchmarks/results,
# named by the machine as scripts/bench.sh does.
# Usage: benchmarks/robustness/run.sh [OPTIONS OF raster_fuzz]     such as --pixels 1e9 --seed 1
set -euo pipefail
cd "$(dirname "$0")/../.."
source benchmarks/names.sh

scripts/install-deps.sh
cmake --preset release >/dev/null
cmake --build --preset release --target raster_fuzz -- --quiet

mkdir -p benchmarks/results
result=benchmarks/results/raster-fuzz-$(machine_name).json
build/release/benchmarks/raster_fuzz "$@" --revision "$(revision)" --json "$result"
echo "result    $result"
