#!/bin/sh
# Installs the peers that Debian packages, builds the small programs that call them, and prints the
# table of peers.py, to which all arguments go. As root, or where the packages are there already.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build="$here/../../build/quality/peers"
packages="g++ pkg-config python3-numpy python3-scipy python3-open3d libcgal-dev libeigen3-dev libgmp-dev libmpfr-dev libpcl-dev"

# shellcheck disable=SC2086 # a list of names
installed=$(dpkg-query -W -f '${db:Status-Status}\n' $packages 2>/dev/null | grep -cx installed || true)
# shellcheck disable=SC2086
if [ "$installed" -lt "$(echo $packages | wc -w)" ]; then
  apt-get update
  apt-get install -y --no-install-recommends $packages
fi

mkdir -p "$build"
is_old() { # whether program $1 is not there or older than its sources
  [ ! -x "$build/$1" ] || [ "$here/peers/$1.cpp" -nt "$build/$1" ] || [ "$here/peers/plain_files.h" -nt "$build/$1" ]
}
if is_old cgal_peer; then
  g++ -std=c++17 -O2 -DCGAL_EIGEN3_ENABLED -I/usr/include/eigen3 "$here/peers/cgal_peer.cpp" -o "$build/cgal_peer" -lgmp -lmpfr
fi
if is_old pcl_peer; then
  # Some releases of PCL name their modules by version.
  module() { pkg-config --list-all | awk -v name="^pcl_$1" '$1 ~ name { print $1; exit }'; }
  modules="$(module surface) $(module features) $(module kdtree) $(module search) $(module common)"
  # shellcheck disable=SC2046,SC2086 # flags and names
  g++ -std=c++17 -O2 $(pkg-config --cflags $modules | sed 's/-I/-isystem /g') "$here/peers/pcl_peer.cpp" -o "$build/pcl_peer" \
    $(pkg-config --libs $modules)
fi
exec /usr/bin/python3 "$here/peers.py" --peers "$build" "$@"
