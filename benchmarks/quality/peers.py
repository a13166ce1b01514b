#!/usr/bin/python3
"""Meshes clouds of run.py with rangezip and with its peers, and prints one Markdown table a cloud.

    peers.py --peers DIR [--program PATH] [--shared DIR] [--out DIR] [--only NAME]... [--timeout S]

Called by peers.sh, which builds what DIR holds. Every mesh is judged by the same program; processor
time is that of the whole run, normals and reading included.
"""
import argparse
import json
import os
import subprocess
import sys

import numpy as np

import boundary_check
import run

CASES = ['igea 400 K', 'igea 400 K, noise 0.1 %', 'fandisk 100 K', 'torus', 'plate 2', 'shell 3', 'spheres 2',
         'pocket 2', 'noisy 0.2', 'density-bumps', 'fingers']
SHOWN = ['cpu_seconds', 'peak_megabytes', 'faces', 'components', 'boundary_edges', 'nonmanifold_edges',
         'misoriented_edges', 'self_intersecting_pairs', 'genus', 'accuracy_rms', 'accuracy_max', 'completeness_rms',
         'completeness_max', 'normal_dev_mean', 'min_angle_lt30']
PERCENT = ('accuracy', 'completeness', 'min_angle_lt30')


def peer_commands(folder):
    open3d = [sys.executable, os.path.join(run.HERE, 'peers', 'open3d_peer.py')]
    cgal = os.path.join(folder, 'cgal_peer')
    return {'open3d poisson': open3d + ['poisson'], 'open3d ball pivoting': open3d + ['bpa'],
            'open3d alpha shape': open3d + ['alpha'], 'cgal advancing front': [cgal, 'af'],
            'cgal smooth, advancing front': [cgal, 'smooth-af'],
            'pcl greedy projection': [os.path.join(folder, 'pcl_peer')]}


def measured(command, timeout):
    """Cost of a command, or why there is none."""
    wrapped = ['timeout', str(timeout), sys.executable, '-c', run.MEASURED] + command
    # Threads that wait in a loop would count as work.
    done = subprocess.run(wrapped, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                          env=dict(os.environ, OMP_WAIT_POLICY='passive'))
    if done.returncode == 124:
        raise RuntimeError('over %d s' % timeout)
    if done.returncode != 0:
        raise RuntimeError('exit code %d' % done.returncode)
    return json.loads(done.stdout)


def text_of(name, value):
    if value is None:
        return '-'
    if name.startswith(PERCENT):
        return '%.4g %%' % (100 * value)
    return '%.4g' % value if isinstance(value, float) else str(value)


def rows(bench, case, commands, timeout):
    source, truth, cloud = bench.prepare(case)
    plain = bench.path(case.name, '_peers.xyz')
    np.savetxt(plain, run.read_any(cloud)[0], fmt='%.9g')
    ours = bench.path(case.name, '_rangezip.ply')
    runs = {'rangezip': ([bench.args.program, 'mesh', source, '-o', ours, '--quiet'] + case.options, ours)}
    for name, command in commands.items():
        out = bench.path('%s %s' % (case.name, name), '.ply' if name.startswith('open3d') else '.off')
        runs[name] = (command + [plain, out], out)
    for name, (command, out) in runs.items():
        try:
            figures = measured(command, timeout)
            judged = subprocess.run([sys.executable, bench.judge, out, '--truth', truth], check=True,
                                    capture_output=True, text=True)
            figures.update(json.loads(judged.stdout))
            yield name, [text_of(figure, figures.get(figure)) for figure in SHOWN]
        except (RuntimeError, subprocess.CalledProcessError) as error:
            yield name, [str(error).replace('|', ' ')[-60:]] + [''] * (len(SHOWN) - 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--peers', required=True, help='the folder with cgal_peer and pcl_peer')
    parser.add_argument('--program', default=os.path.join(run.ROOT, 'build/release/apps/rangezip/rangezip'))
    parser.add_argument('--shared', default=boundary_check.DEFAULT_SHARED)
    parser.add_argument('--out', default=os.path.join(run.ROOT, 'build/quality'))
    parser.add_argument('--only', action='append', help='the name of a case of run.py that has a truth')
    parser.add_argument('--timeout', type=int, default=600, help='seconds for each run')
    args = parser.parse_args()
    run.load_judge(args.shared)
    bench = run.Bench(args)
    for case in run.CASES:
        if case.name not in (args.only or CASES):
            continue
        print('\n### %s\n\n| peer | %s |\n|---%s|' % (case.name, ' | '.join(SHOWN), '|---' * len(SHOWN)))
        for name, texts in rows(bench, case, peer_commands(args.peers), args.timeout):
            print('| %s | %s |' % (name, ' | '.join(texts)), flush=True)
    return 0


if __name__ == '__main__':
    sys.exit(main())
