#!/usr/bin/env bash
# Installs what building and testing rangezip needs on Debian 12, as root or with sudo. Does
# nothing, quickly, when all of it is there.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config      # the build
  clang clang-format clang-tidy         # the second compiler; .ci/run
  libclang-rt-14-dev                    # Clang's sanitizers
  libglm-dev libopenmesh-dev            # core: vectors, half-edge meshes
  libtbb-dev                            # core: parallel loops
  zlib1g-dev libpng-dev                 # core: .gz input, PNG output
  nlohmann-json3-dev                    # core: session files and reports
  libhwy-dev                            # raster_cpu: portable SIMD
  libosmesa6 libosmesa6-dev             # raster_gl: software OpenGL and its headers
  libegl1 libegl-dev libgl-dev          # raster_gl: OpenGL on a GPU without a display
  libgl1-mesa-dri                       # raster_gl: Mesa's drivers behind EGL
  mesa-vulkan-drivers                   # tests: the software driver that has 64-bit atomics
  libcgal-dev libgmp-dev libmpfr-dev    # compare: the independent judge
  libcli11-dev libspdlog-dev libfmt-dev # apps
  catch2 libbenchmark-dev time          # tests, benchmarks
)

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "install-deps: all ${#packages[@]} packages are there"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "install-deps: needs root or sudo to install: ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "install-deps: installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}"
