#!/usr/bin/env bash
# Builds the preset `release`, runs raster_fuzz and stores its result under benchmarks/results,
# named by backend and machine: raster-fuzz-MACHINE.json of the CPU,
# raster-fuzz-gl-osmesa-compute-MACHINE.json of `--against gl:osmesa --strategy compute`.
# Usage: benchmarks/robustness/run.sh [OPTIONS OF raster_fuzz]     such as --pixels 1e9 --seed 1
set -euo pipefail
cd "$(dirname "$0")/../.."
source benchmarks/names.sh

scripts/install-deps.sh
cmake --preset release >/dev/null
cmake --build --preset release --target raster_fuzz -- --quiet

# value_of OPTION ARGUMENT...: "-VALUE" if the arguments hold OPTION VALUE, fit for a file's name.
value_of() {
  local option=$1
  shift
  while [ $# -gt 1 ]; do
    [ "$1" != "$option" ] || printf -- '-%s' "$2" | tr -cs '[:alnum:]_-' '-'
    shift
  done
}

mkdir -p benchmarks/results
result=benchmarks/results/raster-fuzz$(value_of --against "$@")$(value_of --strategy "$@")
result=$result-$(machine_name).json
build/release/benchmarks/raster_fuzz "$@" --revision "$(revision)" --json "$result"
echo "result    $result"
