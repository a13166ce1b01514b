#!/usr/bin/env bash
# Installs what is missing, builds everything with the preset `dev`, runs every test.
# Usage: scripts/test.sh [PRESET]      (see CMakePresets.json; default dev)
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${1:-dev}
scripts/install-deps.sh
cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)"
