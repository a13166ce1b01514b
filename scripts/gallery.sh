#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md and docs/pipeline.md in docs/gallery/, with the project's own
# program only (range images, which it writes as PFM, are copied into PNG).
#   scripts/gallery.sh [FIGURE]...     all, or some of: results 1 3 4 5 6 8 9 10 pipeline
#   scripts/gallery.sh readme          docs/images/bunny.png, of what scripts/demo.sh leaves in out/demo
# Needs a release build (made here if missing), the models in ../shared or RANGEZIP_SHARED, and for
# sampling them /usr/bin/python3 with numpy, scipy and open3d.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
shared=${RANGEZIP_SHARED:-$root/../shared}
data=$shared/data
rangezip=$root/build/release/apps/rangezip/rangezip
out=$root/docs/gallery
work=$root/build/gallery
mkdir -p "$out" "$work"

[ -d "$data" ] || { echo "gallery: the models are not in $shared" >&2; exit 2; }
if [ ! -x "$rangezip" ]; then
  (cd "$root" && cmake --preset release && cmake --build --preset release --target rangezip)
fi

# picture NAME MESH OPTION...
picture() {
  "$rangezip" render "$2" -o "$out/$1.png" --size 360,320 -q "${@:3}"
}

# both NAME MESH DIRECTION OPTION...: from DIRECTION and from the opposite side
both() {
  local back
  back=$(awk -F, '{ printf "%g,%g,%g", -$1, -$2, -$3 }' <<<"$3")
  picture "$1-front" "$2" --boundary --direction "$3" "${@:4}"
  picture "$1-back" "$2" --boundary --direction "$back" "${@:4}"
}

# sampled NAME MODEL POINTS OPTION...: a cloud drawn from a model, once
sampled() {
  [ -f "$work/$1.ply" ] ||
    /usr/bin/python3 "$shared/eval/sample.py" "$data/$2" "$work/$1.ply" --points "$3" "${@:4}"
}

# result NAME INPUT DIRECTION OPTION...: the whole run with its defaults, front and back
result() {
  "$rangezip" mesh "$2" -o "$work/$1.ply" -q
  both "$1" "$work/$1.ply" "$3" "${@:4}"
}

# edited OUT SESSION EXPRESSION: a session whose list of commands is what the expression makes of
# `c`; of("NAME") are the commands of another session in the work folder
edited() {
  /usr/bin/python3 -c '
import json, os, sys
session = json.load(open(sys.argv[1]))
of = lambda name: json.load(open(os.path.join(sys.argv[4], name + ".json")))["commands"]
c = session["commands"]
session["commands"] = eval(sys.argv[3])
json.dump(session, open(sys.argv[2], "w"))' "$2" "$1" "$3" "$work"
}

results() {
  result bunny "$data/range/bunny/bun.conf" 0.2,0.1,1
  result dragon "$data/range/dragon_stand_merged.ply" 0.1,0.1,1
  result rocker-arm-scan "$data/cloud/rocker-arm_virtual_scan.xyz" 1,0.3,0.2
  result rocker-arm-polygons "$data/mesh/rocker-arm.obj" 1,0.3,0.2
  result fandisk-polygons "$data/mesh/fandisk.obj" 1,0.5,0.6
  result club "$data/seed/club_sampled_16586.xyz" 0.2,0.1,1
  result mannequin "$data/seed/mannequin_sampled_12772.xyz" 0.5,1,0 --up 0,0,-1
  sampled igea-400k mesh/igea.ply 400000 --seed 3
  result igea "$work/igea-400k.ply" 0.3,0.1,1
  sampled laurana-400k mesh/Laurana50k.ply 400000
  result laurana "$work/laurana-400k.ply" 0.3,0.1,1
}

# A sharp edge across the pixel grid, across a finer one, and along the grid.
figure_1() {
  write_boxes
  local scan=("$work/block.obj" --method paper --direction 1,1,0 -q)
  local show=(--flat --edges --direction 1,0.5,0.4 --up 0,0,1 --zoom 0.5,0.45,2)
  "$rangezip" scan "${scan[@]}" -o "$work/1a.ply" --up 1,-1,3 --pixel-size 0.12
  "$rangezip" scan "${scan[@]}" -o "$work/1b.ply" --up 1,-1,3 --pixel-size 0.06
  "$rangezip" scan "${scan[@]}" -o "$work/1c.ply" --up 0,0,1 --pixel-size 0.12
  for step in a b c; do picture "figure-1$step" "$work/1$step.ply" "${show[@]}"; done
}

# dense_around OUT CLOUD X Y Z RADIUS: of a binary cloud of floats all points in a ball, and every 16th
# of the others
dense_around() {
  /usr/bin/python3 -c '
import sys
import numpy as np
head, data = open(sys.argv[2], "rb").read().split(b"end_header\n", 1)
points = np.frombuffer(data, "<f4").reshape(-1, 3)
place, radius = np.array(sys.argv[3:6], float), float(sys.argv[6])
kept = (np.linalg.norm(points - place, axis=1) < radius) | (np.arange(len(points)) % 16 == 0)
head = head.replace(b"vertex %d" % len(points), b"vertex %d" % kept.sum())
open(sys.argv[1], "wb").write(head + b"end_header\n" + points[kept].tobytes())' "$@"
}

# An eye and the mouth scanned finer than the rest; and a run that finds by itself where to.
figure_3() {
  sampled igea-400k mesh/igea.ply 400000 --seed 3
  local cloud=$work/igea-400k.ply view=(--direction 0,0,1 -q) show=(--edges --direction 0,0,1 --zoom 0.5,0.41,2.7)
  local fine=(--no-quality --size 400,400 --pixel-size 0.0024)
  "$rangezip" scan "$cloud" -o "$work/3a.ply" --session "$work/3a.json" "${view[@]}" --size 120,120 --pixel-size 0.008
  "$rangezip" scan "$cloud" --mask "$work/mask.png" --session "$work/3-eye.json" "${view[@]}" "${fine[@]}" \
    --region "205,180 252,180 258,200 252,225 205,225"
  "$rangezip" scan "$cloud" --mask "$work/mask.png" --session "$work/3-mouth.json" "${view[@]}" "${fine[@]}" \
    --region "168,124 236,124 236,156 168,156"
  edited "$work/3b.json" "$work/3a.json" \
    'c + of("3-eye") + of("3-mouth") + [{"command": "finish", "method": "fast", "pixel_size": 0.008}]'
  "$rangezip" play "$work/3b.json" -o "$work/3b.ply" -q
  picture figure-3a "$work/3a.ply" "${show[@]}"
  picture figure-3b "$work/3b.ply" "${show[@]}"
  sampled igea-1m mesh/igea.ply 1000000 --seed 3
  dense_around "$work/uneven.ply" "$work/igea-1m.ply" 0.0 -0.05 0.3 0.2
  "$rangezip" mesh "$work/uneven.ply" -o "$work/3c.ply" -q
  picture figure-3c "$work/3c.ply" --edges --direction 0.3,0.1,1 --zoom 0.5,0.45,1.6
}

# A scan of noisy points without and with the median filter. The largest gap of the depths lies between
# the outliers in front and the rest, so what shines through is removed locally instead.
figure_4() {
  local view=(--direction 1,0.1,0.1 --method paper --no-back-side --see-through -q)
  local show=(--flat --direction 1,0.1,0.1 --zoom 0.4,0.5,1.8)
  local cloud=$data/cloud/rocker-arm_virtual_scan.xyz
  "$rangezip" scan "$cloud" -o "$work/4a.ply" "${view[@]}" --no-median
  "$rangezip" scan "$cloud" -o "$work/4b.ply" "${view[@]}" --median --median-radius 2
  picture figure-4a "$work/4a.ply" "${show[@]}"
  picture figure-4b "$work/4b.ply" "${show[@]}"
}

# What a second scan takes by the quality of samples alone, and after erosion and two dilations.
figure_5() {
  sampled igea-400k mesh/igea.ply 400000 --seed 3
  local cloud=$work/igea-400k.ply paper=(--method paper --pixel-size 0.003 --point-size 2 -q)
  local second=(--into "$work/5.ply" --direction 1,0.1,0.6 "${paper[@]}")
  "$rangezip" scan "$cloud" -o "$work/5.ply" --direction 0,0,1 "${paper[@]}"
  "$rangezip" scan "$cloud" "${second[@]}" --erosions 0 --dilations 0 --mask "$out/figure-5a.png"
  "$rangezip" scan "$cloud" "${second[@]}" --erosions 1 --dilations 2 --mask "$out/figure-5b.png"
}

# The seam between two scans: the old mesh, the new patch, both stitched by zippering.
figure_6() {
  sampled igea-400k mesh/igea.ply 400000 --seed 3
  local cloud=$work/igea-400k.ply second=(--direction 1,0.1,0.2 --pixel-size 0.013 -q)
  local show=(--edges --boundary --direction 0.7,0.1,0.7)
  "$rangezip" scan "$cloud" -o "$work/6a.ply" --direction 0,0,1 --pixel-size 0.013 -q
  "$rangezip" scan "$cloud" -o "$work/6b.ply" "${second[@]}"
  "$rangezip" scan "$cloud" --into "$work/6a.ply" -o "$work/6c.ply" "${second[@]}" --stitch zipper
  for step in a b c; do picture "figure-6$step" "$work/6$step.ply" "${show[@]}"; done
  picture figure-6d "$work/6c.ply" "${show[@]}" --zoom 0.45,0.45,3
}

# The club, scan by scan.
figure_8() {
  local cloud=$data/seed/club_sampled_16586.xyz show=(--boundary --direction 0.5,0.2,1)
  "$rangezip" mesh "$cloud" -o "$work/8f.ply" --session "$work/8.json" -q
  picture figure-8a "$cloud" --points --point-size 1 "${show[@]}"
  local step scans
  for step in b:1 c:2 d:3; do
    scans=${step#*:}
    edited "$work/8-$scans.json" "$work/8.json" "c[:$scans]"
    "$rangezip" play "$work/8-$scans.json" -o "$work/8${step%:*}.ply" -q
  done
  edited "$work/8-raw.json" "$work/8.json" 'c[:-1]'
  "$rangezip" play "$work/8-raw.json" -o "$work/8e.ply" -q
  for step in b c d e f; do picture "figure-8$step" "$work/8$step.ply" "${show[@]}"; done
}

# 400 K noisy points, the stitched scans, and 33 K triangles after smoothing.
figure_9() {
  sampled igea-noisy mesh/igea.ply 400000 --noise 0.001 --seed 4
  local cloud=$work/igea-noisy.ply show=(--direction 0.4,0.1,1)
  "$rangezip" mesh "$cloud" -o "$work/9b.ply" --pixel-size 0.00678 --finish none --session "$work/9.json" -q
  edited "$work/9-smooth.json" "$work/9.json" \
    'c + [{"command": "finish"}, {"command": "smooth", "iterations": 1, "factor": 0.5}]'
  "$rangezip" play "$work/9-smooth.json" -o "$work/9c.ply" -q
  picture figure-9a "$cloud" --points --point-size 1 "${show[@]}"
  picture figure-9b "$work/9b.ply" --flat --boundary "${show[@]}"
  picture figure-9c "$work/9c.ply" --boundary "${show[@]}"
}

# Writes OBJ boxes: closed, and with a square opening in the top: open, a pocket, a hole right through.
write_boxes() {
  /usr/bin/python3 - "$work" <<'EOF'
import sys

def ring(half, z):
    return [(-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z)]

def write(name, rings, bottom, top):
    """Walls between consecutive rings; a lid at the first and the last ring if wanted."""
    with open('%s/%s.obj' % (sys.argv[1], name), 'w') as out:
        for corners in rings:
            for corner in corners:
                out.write('v %g %g %g\n' % corner)
        for r in range(len(rings) - 1):
            for i in range(4):
                j = (i + 1) % 4
                out.write('f %d %d %d %d\n' % tuple(1 + k for k in (4*r + i, 4*r + j, 4*r + 4 + j, 4*r + 4 + i)))
        last = 4 * len(rings)
        if bottom:
            out.write('f 4 3 2 1\n')
        if top:
            out.write('f %d %d %d %d\n' % (last - 3, last - 2, last - 1, last))

write('block', [ring(1, -1), ring(1, 1)], True, True)
write('open-box', [ring(1, -1), ring(1, 1)], True, False)
write('pocket', [ring(1, -1), ring(1, 1), ring(0.5, 1), ring(0.5, -0.5)], True, True)
write('through-hole', [ring(0.5, -1), ring(1, -1), ring(1, 1), ring(0.5, 1), ring(0.5, -1)], False, False)
EOF
}

# scan_all INPUT OUT SCAN...: scans, each "DIRECTION [CLIP]", stitched one after the other and finished
scan_all() {
  local input=$1 out=$2 number=0 list="" scan
  for scan in "${@:3}"; do
    local clip=()
    [ "$scan" = "${scan#* }" ] || clip=(--clip "${scan#* }")
    "$rangezip" scan "$input" --mask "$work/mask.png" --session "$work/10-$number.json" -q --pixel-size 0.04 \
      --direction "${scan%% *}" "${clip[@]}"
    list="$list of(\"10-$number\") +"
    number=$((number + 1))
  done
  edited "$work/10.json" "$work/10-0.json" "$list [{\"command\": \"finish\", \"pixel_size\": 0.04}]"
  "$rangezip" play "$work/10.json" -o "$out" -q
}

# Insides reached by clip planes: each cut lets the scanner see the far walls from within.
figure_10() {
  write_boxes
  local around=(1,1,0.7 -1,1,0.7 -1,-1,0.7 1,-1,0.7 1,0.8,-0.7 -0.8,1,-0.7 -1,-0.8,-0.7 0.8,-1,-0.7)
  local inside=("1,1,0.7 -1,-1,0,0" "-1,1,0.7 1,-1,0,0" "-1,-1,0.7 1,1,0,0" "1,-1,0.7 -1,1,0,0")
  scan_all "$work/open-box.obj" "$work/10a.ply" 1,1,-0.7 -1,1,-0.7 -1,-1,-0.7 1,-1,-0.7
  scan_all "$work/pocket.obj" "$work/10b.ply" "${around[@]}" "${inside[@]}"
  scan_all "$work/through-hole.obj" "$work/10c.ply" "${around[@]}" "${inside[@]}"
  for step in a b; do
    picture "figure-10$step" "$work/10$step.ply" --boundary --direction 0.5,0.6,0.9 --up 0,0,1
  done
  picture figure-10c "$work/10c.ply" --boundary --direction 0.15,0.25,0.9 --up 0,0,1
}

# grey_picture IN.pfm OUT.png: a range image; what is near is bright, empty pixels are white. The
# nearest and the farthest hundredth do not set the scale: they may be outliers.
grey_picture() {
  /usr/bin/python3 - "$1" "$2" <<'EOF'
import struct, sys, zlib
import numpy

with open(sys.argv[1], 'rb') as file:
    file.readline()
    width, height = map(int, file.readline().split())
    order = '<' if float(file.readline()) < 0 else '>'
    depth = numpy.frombuffer(file.read(), order + 'f4').reshape(height, width)[::-1]
seen = numpy.isfinite(depth)
near, far = numpy.percentile(depth[seen], (1, 99))
grey = numpy.full(depth.shape, 255, 'u1')
grey[seen] = (225 - 205 * numpy.clip((depth[seen] - near) / (far - near), 0, 1)).astype('u1')
rows = b''.join(b'\0' + row.tobytes() for row in grey)

def chunk(name, data):
    return struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))

header = struct.pack('>IIBBBBB', width, height, 8, 0, 0, 0, 0)
with open(sys.argv[2], 'wb') as file:
    file.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(rows, 9)) +
               chunk(b'IEND', b''))
EOF
}

# Steps of docs/pipeline.md: a range image as drawn and after all passes, its patch, and a place of the
# whole mesh after the fast finish and after the full one.
figure_pipeline() {
  local cloud=$data/range/dragon_stand_merged.ply view=(--direction 0,0,1 --size 360,230 -q)
  local raw=(--no-see-through --no-vote --no-plane-fit --no-fill-holes)
  "$rangezip" scan "$cloud" "${view[@]}" "${raw[@]}" --range-image "$work/drawn.pfm"
  "$rangezip" scan "$cloud" "${view[@]}" -o "$work/patch.ply" --range-image "$work/passed.pfm"
  grey_picture "$work/drawn.pfm" "$out/pipeline-drawn.png"
  grey_picture "$work/passed.pfm" "$out/pipeline-passed.png"
  picture pipeline-patch "$work/patch.ply" --boundary --direction 0,0,1

  local show=(--boundary --edges --direction 0.1,0.1,1 --zoom 0.62,0.2,5)
  "$rangezip" mesh "$cloud" -o "$work/finish-a.ply" --finish fast -q
  "$rangezip" mesh "$cloud" -o "$work/finish-b.ply" -q
  for step in a b; do picture "pipeline-finish-$step" "$work/finish-$step.ply" "${show[@]}"; done
}

# The README's picture: every tenth point of the demo's cloud, and beside it the mesh.
figure_readme() {
  local demo=$root/out/demo
  [ -s "$demo/bunny.ply" ] || { echo "gallery: run scripts/demo.sh first" >&2; exit 2; }
  awk 'NR % 10 == 0 { print $1 - 1.12, $2, $3 }' "$demo/bunny.xyz" >"$work/beside.xyz"
  "$rangezip" render "$demo/bunny.ply" "$work/beside.xyz" -o "$root/docs/images/bunny.png" --size 1000,470 -q \
    --direction 0.15,0.15,1
}

for figure in "${@:-results 1 3 4 5 6 8 9 10 pipeline}"; do
  for one in $figure; do
    echo "gallery: $one"
    case $one in
      results) results ;;
      *) "figure_$one" ;;
    esac
  done
done
