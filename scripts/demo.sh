#!/usr/bin/env bash
# Meshes a scanned object on a fresh Debian 12: installs what is missing, builds the program,
# fetches the points, meshes them, draws the mesh.
#
# The object is the Stanford bunny, a clay figure scanned from ten sides [Turk, Levoy 1994]: of what
# Debian ships (package libcgal-demo, the data of CGAL's examples) the densest real scan of a whole
# object. The package holds it as a mesh; the demo takes its 37,706 vertices as the raw points and
# throws the faces away.
set -euo pipefail
cd "$(dirname "$0")/.."

out=out/demo
cloud=$out/bunny.xyz
mkdir -p "$out"

scripts/install-deps.sh
cmake --preset release
cmake --build --preset release --target rangezip

# Unpacked, not installed: the package would bring in all of CGAL's demos.
fetch_points() {
  local unpacked
  unpacked=$(mktemp -d)
  chmod 755 "$unpacked"  # apt downloads as a user of its own
  trap 'rm -rf "$unpacked"' RETURN
  (cd "$unpacked" && apt-get download -qq libcgal-demo)
  dpkg-deb -x "$unpacked"/libcgal-demo_*.deb "$unpacked"
  tar -xzf "$unpacked"/usr/share/doc/libcgal-dev/data.tar.gz -C "$unpacked" \
    data/meshes/bunny00.off
  # OFF: a line "OFF", a line of counts, blank lines, then one vertex a line.
  awk 'NR == 2 { left = $1 } NR > 2 && NF >= 3 && left-- > 0 { print $1, $2, $3 }' \
    "$unpacked"/data/meshes/bunny00.off >"$cloud.part"
  mv "$cloud.part" "$cloud"
}
[ -s "$cloud" ] || {
  echo "demo: fetching the points from Debian's package libcgal-demo (24 MB)"
  fetch_points
}

rangezip=build/release/apps/rangezip/rangezip
"$rangezip" mesh "$cloud" -o "$out/bunny.ply" --report "$out/report.json"
"$rangezip" render "$out/bunny.ply" -o "$out/bunny.png"
cat "$out/report.json"
echo "demo: the mesh is $out/bunny.ply, its picture $out/bunny.png"
