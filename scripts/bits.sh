#!/usr/bin/env bash
# Shows that the rasterizer's bits do not depend on the compiler or on optimisation: builds the
# tests of core/raster with GCC and Clang, without optimisation (Debug) and with all of it
# (Release), each in build/bits-COMPILER-TYPE, and holds the drawings of each against the hashes of
# tests/core/raster/bits.txt.
# Usage: scripts/bits.sh
set -euo pipefail
cd "$(dirname "$0")/.."

for compiler in g++ clang++; do
  for type in Debug Release; do
    folder=build/bits-$compiler-$type
    # Whatever flags the environment asks for: Debug is to have no -O, Release the highest.
    cmake -S . -B "$folder" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE="$type" \
      -DCMAKE_CXX_FLAGS= -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DCMAKE_CXX_FLAGS_RELEASE='-O3 -DNDEBUG' \
      -DRANGEZIP_STRICT=ON -DRANGEZIP_WITH_GL=OFF -DRANGEZIP_BUILD_APPS=OFF \
      -DRANGEZIP_BUILD_COMPARE=OFF -DRANGEZIP_TEST_INSTALL=OFF >/dev/null 2>&1
    cmake --build "$folder" --target test_core_raster -- --quiet
    echo "-- $compiler, $type"
    "$folder/tests/core/raster/test_core_raster" '[bits]'
  done
done
