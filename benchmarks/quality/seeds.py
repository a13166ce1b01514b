#!/usr/bin/python3
"""Meshes bodies made by code from several clouds each, and prints for how many of them the mesh is right.

    seeds.py [--program PATH] [--shared DIR] [--out DIR] [--seeds N] [--jobs N] [--only NAME]...

Where walls are as close as the resolution, whether a mesh is right is a matter of how the points
happen to lie: one cloud, as in run.py, tells little. See README.md beside this file. Exit code: 0 if
all meshes are right, 1 if one is not, 2 if something needed is not there.
"""
import argparse
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import boundary_check
import run
import shapes

LEAST_COVERAGE = 0.998
# Components and genus of closed bodies.
BODIES = {'torus': (1, 1), 'cube': (1, 0), **{f'{thin} {t}': (1, 0) for thin in ('plate', 'shell') for t in (2, 3)},
          **{f'pocket {depth}': (1, 0) for depth in (0.5, 1, 2)},
          **{f'{two} {gap}': (2, 0) for two in ('slabs', 'bars') for gap in (2, 3, 4)},
          **{f'{deep} {width}': (1, 0) for deep in ('slot', 'cavity') for width in (2, 3, 6)},
          **{f'drilled {width}': (1, shapes.DRILLED) for width in (2, 3, 6)},
          **{f'{sharp} {angle}': (1, 0) for sharp in ('lens', 'star') for angle in (25, 40)}}


def meshed(base, points, args):
    """(components, genus, boundary loops, coverage) of the mesh of a cloud. @param base of the names of files"""
    sys.modules['sample'].write_ply(base + '_in.ply', points)
    subprocess.run([args.program, 'mesh', base + '_in.ply', '-o', base + '.ply', '--report', base + '.json', '--quiet',
                    '--threads', '1'], check=True)
    topology = sys.modules['mesh_quality'].topology(*run.read_any(base + '.ply'))[0]
    components, loops = topology['components'], topology['boundary_loops']
    with open(base + '.json') as file:
        coverage = json.load(file)['coverage']
    return components, (2 * components - topology['euler'] - loops) // 2, loops, coverage


def of_seed(name, seed, args):
    """meshed() of one cloud of a body."""
    base = os.path.join(args.out, '%s %d' % (name, seed)).replace(' ', '_')
    return meshed(base, shapes.make(name, seed).points, args)


def faults(body, reached):
    """What of meshed() is not as it must be. @param body its components and genus"""
    components, genus, loops, coverage = reached
    found = ['%d components' % components] if components != body[0] else []
    found += ['genus %d' % genus] if genus != body[1] else []
    found += ['%d loops' % loops] if loops else []
    found += ['coverage %.3f' % coverage] if coverage < LEAST_COVERAGE else []
    return found


def row(name, results):
    """@return whether all are right"""
    components, genus = BODIES[name]
    wrong = {seed: faults(BODIES[name], reached) for seed, reached in results.items()}
    wrong = {seed: found for seed, found in wrong.items() if found}
    told = '; '.join('%d: %s' % (seed, ', '.join(found)) for seed, found in wrong.items())
    print('| %s | %d, %d | %d of %d | %s |' % (name, components, genus, len(results) - len(wrong), len(results), told),
          flush=True)
    return not wrong


def are_there(args, name):
    """Whether what a script needs is; else it is told. @param name the script's"""
    for needed in (args.program, os.path.join(args.shared, 'eval', 'mesh_quality.py')):
        if not os.path.exists(needed):
            print('%s: %s is not there' % (name, needed), file=sys.stderr)
            return False
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=os.path.join(run.ROOT, 'build/release/apps/rangezip/rangezip'))
    parser.add_argument('--shared', default=boundary_check.DEFAULT_SHARED)
    parser.add_argument('--out', default=os.path.join(run.ROOT, 'build/quality/seeds'))
    parser.add_argument('--seeds', type=int, default=10, help='clouds of each body')
    parser.add_argument('--jobs', type=int, default=os.cpu_count(), help='meshed at a time')
    parser.add_argument('--only', action='append', help="a part of a body's name")
    args = parser.parse_args()
    chosen = [name for name in BODIES if not args.only or any(part in name for part in args.only)]
    if not chosen or args.seeds < 1:
        print('seeds.py: nothing is chosen', file=sys.stderr)
        return 2
    if not are_there(args, 'seeds.py'):
        return 2
    os.makedirs(args.out, exist_ok=True)
    run.load_judge(args.shared)
    seeds = range(1, args.seeds + 1)
    print('| body | components, genus | right | seeds of the others |')
    print('|---|---|---|---|')
    all_right = True
    for name in chosen:
        with ThreadPoolExecutor(args.jobs) as pool:
            results = dict(zip(seeds, pool.map(lambda seed: of_seed(name, seed, args), seeds)))
        all_right = row(name, results) and all_right
    return 0 if all_right else 1


if __name__ == '__main__':
    sys.exit(main())
