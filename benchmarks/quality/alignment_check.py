#!/usr/bin/python3
"""What aligning the pixel grid with a feature line does to the normals of one scan.

    alignment_check.py [--program PATH] [--shared DIR] [--out DIR] [--pixel-size H]

Spreads 400,000 points over the cube [-1, 1]^3, scans it from over an edge with `rangezip scan`, without and with
`--align`, and judges both meshes against the cube by ../shared/eval/mesh_quality.py. Clip planes cut away all but the two
faces at the edge, without their rims: pixels at the outline of a cloud see two faces however the grid lies. Prints a
Markdown table; exit code 0 if the 95 % quantile of the normals' error is at most a third after alignment.
"""
import argparse
import json
import os
import subprocess
import sys

import numpy as np

import boundary_check

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..'))
POINTS, SEED = 400_000, 1
VIEW = ['--direction', '0,1,0.9', '--up', '0.4,1,0.7']
RIMS = ['--clip=1,0,0,0.9', '--clip=-1,0,0,0.9', '--clip=0,1,0,0.8', '--clip=0,0,1,0.8']
CORNERS = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
FACES = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]


def cube_points():
    rng = np.random.default_rng(SEED)
    face, points = rng.integers(0, 6, POINTS), rng.uniform(-1, 1, (POINTS, 3))
    points[np.arange(POINTS), face // 2] = np.where(face % 2, 1.0, -1.0)
    return points


def figures(args, cloud, truth, options, name):
    out = os.path.join(args.out, name)
    subprocess.run([args.program, 'scan', cloud, '-o', out, '--quiet', '--pixel-size', str(args.pixel_size)] + VIEW +
                   RIMS + options, check=True, stdout=subprocess.DEVNULL)
    judge = os.path.join(args.shared, 'eval', 'mesh_quality.py')
    judged = subprocess.run([sys.executable, judge, out, '--truth', truth], check=True, capture_output=True, text=True)
    return json.loads(judged.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=os.path.join(ROOT, 'build/release/apps/rangezip/rangezip'))
    parser.add_argument('--shared', default=boundary_check.DEFAULT_SHARED)
    parser.add_argument('--out', default=os.path.join(ROOT, 'build/quality'))
    parser.add_argument('--pixel-size', type=float, default=0.05)
    args = parser.parse_args()
    os.makedirs(args.out, exist_ok=True)
    cloud, truth = os.path.join(args.out, 'cube.xyz'), os.path.join(args.out, 'cube.obj')
    np.savetxt(cloud, cube_points(), fmt='%.9g')
    with open(truth, 'w') as file:
        file.writelines('v %d %d %d\n' % corner for corner in CORNERS)
        file.writelines('f %d %d %d %d\n' % face for face in FACES)
    plain = figures(args, cloud, truth, [], 'cube_plain.ply')
    aligned = figures(args, cloud, truth, ['--align'], 'cube_aligned.ply')
    print('| error of the normals, degrees | as it comes | aligned |\n|---|---|---|')
    for figure in ('normal_dev_mean', 'normal_dev_p95'):
        print('| %s | %.3f | %.3f |' % (figure, plain[figure], aligned[figure]))
    return 0 if 3.0 * aligned['normal_dev_p95'] <= plain['normal_dev_p95'] else 1


if __name__ == '__main__':
    sys.exit(main())
