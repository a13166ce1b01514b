#!/usr/bin/env bash
# Meshes a scanned object on a fresh Debian 12: installs what is missing, builds the programs, makes
# the point cloud, meshes it, draws the mesh and judges it.
#
# The object is the Stanford bunny, a clay figure scanned from ten sides [Turk, Levoy 1994]: of what
# Debian ships (package libcgal-demo, the data of CGAL's examples) the finest scan of a whole object.
# The package holds it as a mesh whose vertices were thinned out where it is flat, as no scanner
# does; so the demo spreads 200,000 points evenly over it, and forgets the faces. As the surface is
# known, the distance of the result to it is measured, too.
set -euo pipefail
cd "$(dirname "$0")/.."

out=out/demo
scanned=$out/bunny_scanned.off
cloud=$out/bunny.xyz
mkdir -p "$out"

scripts/install-deps.sh
cmake --preset release
cmake --build --preset release --target rangezip rangezip-compare

rangezip=build/release/apps/rangezip/rangezip
compare=build/release/apps/rangezip-compare/rangezip-compare

# Unpacked, not installed: the package would bring in all of CGAL's demos.
fetch_scan() {
  local unpacked
  unpacked=$(mktemp -d)
  trap 'rm -rf "$unpacked"' RETURN
  (cd "$unpacked" && apt-get download -qq -o APT::Sandbox::User=root libcgal-demo)
  dpkg-deb -x "$unpacked"/libcgal-demo_*.deb "$unpacked"
  tar -xzf "$unpacked"/usr/share/doc/libcgal-dev/data.tar.gz -C "$unpacked" \
    data/meshes/bunny00.off
  cp "$unpacked"/data/meshes/bunny00.off "$scanned.part"
  mv "$scanned.part" "$scanned"
}
if [ ! -s "$scanned" ]; then
  echo "demo: fetching the scan from Debian's package libcgal-demo (24 MB)"
  fetch_scan
fi
"$compare" sample "$scanned" -o "$cloud" --points 200000

"$rangezip" mesh "$cloud" -o "$out/bunny.ply" --report "$out/report.json"
"$rangezip" render "$out/bunny.ply" -o "$out/bunny.png" --quiet
"$compare" mesh "$out/bunny.ply" --truth "$scanned" --cloud "$cloud"
echo "demo: the mesh is $out/bunny.ply, its picture $out/bunny.png, the whole report $out/report.json"
