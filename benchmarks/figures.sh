#!/usr/bin/env bash
# Prints README.md's table of figures, one line a row as it is measured: meshes each input with no option
# but -o, judges the result with rangezip-compare.
# Usage: benchmarks/figures.sh [FOLDER [ROW]...]   FOLDER has range/bunny, range/dragon_stand_merged.ply,
#        cloud/, mesh/, seed/; default $RANGEZIP_SHARED/data, else ../shared/data. Without ROW: all rows.
# Rows whose input is missing are left out and named at the end. Needs the package `time`.
set -euo pipefail
cd "$(dirname "$0")/.."

data=${1:-${RANGEZIP_SHARED:-../shared}/data}
wanted=("${@:2}")
out=out/figures
mkdir -p "$out"

cmake --preset release >/dev/null
cmake --build --preset release --target rangezip rangezip-compare -- --quiet
rangezip=build/release/apps/rangezip/rangezip
compare=build/release/apps/rangezip-compare/rangezip-compare
missing=()

# field SECTION KEY FILE: a number of rangezip-compare's report.
field() {
  sed -n "/\"$1\": {/,/}/s/.*\"$2\": \\([^,]*\\),*\$/\\1/p" "$3"
}

percent() {
  awk -v share="$1" 'BEGIN { if (share == "") print "-"; else printf "%.4f", 100 * share }'
}

# is_wanted NAME: whether the row was asked for.
is_wanted() {
  local name
  [ "${#wanted[@]}" -gt 0 ] || return 0
  for name in "${wanted[@]}"; do
    [ "$name" != "$1" ] || return 0
  done
  return 1
}

# row NAME INPUT TRUTH CLOUD: the last two may be -.
row() {
  local name=$1 input=$2 truth=$3 cloud=$4 arguments=()
  is_wanted "$name" || return 0
  if [ ! -e "$input" ]; then
    missing+=("$name: $input")
    return
  fi
  local mesh=$out/$name.ply json=$out/$name.json
  /usr/bin/time -o "$out/$name.time" -f '%U %S %M' "$rangezip" mesh "$input" -o "$mesh" --quiet ||
    echo "$name: rangezip ended with exit code $?" >&2
  [ "$truth" = - ] || arguments+=(--truth "$truth")
  [ "$cloud" = - ] || arguments+=(--cloud "$cloud")
  "$compare" mesh "$mesh" "${arguments[@]}" --json "$json" >"$out/$name.txt" || true
  local cpu peak
  cpu=$(awk '{ printf "%.1f", $1 + $2 }' "$out/$name.time")
  peak=$(awk '{ printf "%.0f", $3 / 1024 }' "$out/$name.time")
  echo "| $name | $cpu s | $peak MB | $(field mesh faces "$json") | $(field mesh components "$json")" \
    "| $(field mesh boundary_loops "$json") | $(field mesh euler "$json")" \
    "| $(field mesh nonmanifold_edges "$json") / $(field mesh self_intersections "$json")" \
    "| $(percent "$(field accuracy mean "$json")") / $(percent "$(field accuracy p95 "$json")")" \
    "| $(percent "$(field cloud within_0.5_percent "$json")") |"
}

# sampled NAME MESH POINTS: a row for a cloud sampled from a mesh.
sampled() {
  is_wanted "$1" || return 0
  [ ! -e "$2" ] || "$compare" sample "$2" -o "$out/$1.xyz" --points "$3"
  row "$1" "$out/$1.xyz" "$2" "$out/$1.xyz"
}

echo "| input | cpu | peak | triangles | components | boundary loops | Euler number" \
  "| non-manifold edges / self-intersections | mesh to truth, mean / p95 in %" \
  "| % of the cloud within 0.5 % |"
echo "|---|---|---|---|---|---|---|---|---|---|"
row bunny "$data/range/bunny/bun.conf" - "$data/range/bunny/bun.conf"
row dragon_stand "$data/range/dragon_stand_merged.ply" - "$data/range/dragon_stand_merged.ply"
row rocker-arm_scan "$data/cloud/rocker-arm_virtual_scan.xyz" "$data/mesh/rocker-arm.obj" -
row rocker-arm_polygons "$data/mesh/rocker-arm.obj" "$data/mesh/rocker-arm.obj" -
row fandisk_polygons "$data/mesh/fandisk.obj" "$data/mesh/fandisk.obj" -
row club "$data/seed/club_sampled_16586.xyz" - "$data/seed/club_sampled_16586.xyz"
row mannequin "$data/seed/mannequin_sampled_12772.xyz" - "$data/seed/mannequin_sampled_12772.xyz"
sampled igea_400K "$data/mesh/igea.ply" 400000
sampled igea_1.4M "$data/mesh/igea.ply" 1400000

for line in "${missing[@]}"; do
  echo "left out, its input is missing: $line" >&2
done
