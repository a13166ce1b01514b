#!/usr/bin/env bash
# Builds the preset `release`, runs session_fuzz and stores its result as
# benchmarks/results/sessions-MACHINE.json.
# Usage: benchmarks/robustness/sessions.sh [OPTIONS OF session_fuzz]     such as --sessions 10000
set -euo pipefail
cd "$(dirname "$0")/../.."
source benchmarks/names.sh

scripts/install-deps.sh
cmake --preset release >/dev/null
cmake --build --preset release --target session_fuzz -- --quiet

mkdir -p benchmarks/results
result=benchmarks/results/sessions-$(machine_name).json
build/release/benchmarks/session_fuzz "$@" --revision "$(revision)" --json "$result"
echo "result    $result"
