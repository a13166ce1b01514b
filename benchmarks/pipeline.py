#!/usr/bin/python3
"""Measures whole runs of `rangezip mesh` by each backend, and compares the files that they write.

    pipeline.py [quick|full] [--data FOLDER] [--json FILE] [--revision TEXT]
    pipeline.py --table FILE

quick       a generated cloud of 200,000 points, and the bunny's scans where FOLDER has them
full        also the dragon, and each run three times: the best time counts
--data      has range/bunny, range/dragon_stand_merged.ply; default: $RANGEZIP_SHARED/data, else
            ../shared/data beside the repository
--json      stores the report
--revision  what the report says that the program was built from
--table     prints the table, as Markdown, of a report that was stored

The backends are those that `rangezip backends` finds working, without gl:egl:surfaceless where EGL
has a device. Each mesh must be, byte for byte, the one by cpu: ends with 1 if one is not. Needs
build/release/apps/rangezip/rangezip.
"""
import argparse
import datetime
import filecmp
import json
import math
import os
import subprocess
import sys
import tempfile
import time

from table import machine_line, print_sections, read, table

REPOSITORY = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
RANGEZIP = os.path.join(REPOSITORY, 'build/release/apps/rangezip/rangezip')
GENERATED_POINTS = 200_000


class Failure(Exception):
    """Ends the program; its text says why."""


def write_bumpy_sphere(path):
    """Points along a spiral from pole to pole, evenly spread; its radius goes up and down."""
    golden_angle = math.pi * (3 - math.sqrt(5))
    with open(path, 'w', encoding='utf-8') as file:
        for i in range(GENERATED_POINTS):
            z = 1 - (2 * i + 1) / GENERATED_POINTS
            turn = golden_angle * i
            radius = 1 + 0.1 * math.sin(5 * turn) * (1 - z * z) ** 2.5
            flat = radius * math.sqrt(1 - z * z)
            file.write(f'{flat * math.cos(turn):.6f} {flat * math.sin(turn):.6f} '
                       f'{radius * z:.6f}\n')


def list_inputs(data, is_full, folder, notes):
    """(name, path) of each input that is there."""
    generated = os.path.join(folder, 'bumpy_sphere.xyz')
    write_bumpy_sphere(generated)
    inputs = [(f'generated, {GENERATED_POINTS:,} points', generated)]
    named = [('bunny, 10 scans', 'range/bunny/bun.conf')]
    if is_full:
        named.append(('dragon, 469,193 points', 'range/dragon_stand_merged.ply'))
    for name, path in named:
        path = os.path.join(data, path)
        if os.path.exists(path):
            inputs.append((name, path))
        else:
            notes.append(f'{name}: not measured, there is no {os.path.relpath(path, REPOSITORY)}')
    return inputs


def list_backends(notes):
    """(name, text) of those that work, cpu first."""
    done = subprocess.run([RANGEZIP, 'backends'], stdout=subprocess.PIPE, text=True, check=True)
    working = []
    for line in done.stdout.splitlines():
        name, rest = line.split(maxsplit=1)
        if rest.startswith('works'):
            working.append((name, rest.removeprefix('works').strip()))
        else:
            notes.append(f'{name} {" ".join(rest.split())}')
    has_device = any(name.startswith('gl:egl:') and name != 'gl:egl:surfaceless'
                     for name, _ in working)
    return [backend for backend in working
            if not (has_device and backend[0] == 'gl:egl:surfaceless')]


def run(source, backend, mesh, cache):
    """Meshes once: what it took, from the system's accounting. Shaders are kept in `cache`: Mesa's
    software renderer also takes what others left, made for vectors of another width."""
    started = time.monotonic()
    process = subprocess.Popen([RANGEZIP, 'mesh', source, '-o', mesh, '--backend', backend,
                                '--quiet'], env=os.environ | {'MESA_SHADER_CACHE_DIR': cache})
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    wall = time.monotonic() - started
    if process.returncode != 0:
        raise Failure(f'{backend}: rangezip mesh {source} ended with {process.returncode}')
    return {'wall_seconds': wall, 'cpu_seconds': usage.ru_utime + usage.ru_stime,
            'peak_bytes': 1024 * usage.ru_maxrss}


def least(a, b):
    return {key: min(a[key], b[key]) for key in a}


def measure(inputs, backends, rounds, folder):
    """A row for each input and backend, measured in turn."""
    rows = []
    cache = os.path.join(folder, 'shaders')
    os.mkdir(cache)
    for name, source in inputs:
        meshes = [os.path.join(folder, f'{i}.ply') for i in range(len(backends))]
        best = [None] * len(backends)
        for _ in range(rounds):
            for i, (backend, _) in enumerate(backends):
                taken = run(source, backend, meshes[i], cache)
                best[i] = taken if best[i] is None else least(best[i], taken)
        for i, (backend, text) in enumerate(backends):
            rows.append({'input': name, 'backend': backend, 'renderer': text} | best[i] |
                        {'runs': rounds,
                         'identical': filecmp.cmp(meshes[0], meshes[i], shallow=False)})
            print(f'{name:28} {backend:12} {best[i]["wall_seconds"]:8.2f} s wall '
                  f'{best[i]["cpu_seconds"]:8.2f} s cpu  '
                  f'{"" if rows[-1]["identical"] else "ANOTHER MESH THAN BY " + backends[0][0]}',
                  file=sys.stderr, flush=True)
    return rows


def processor():
    with open('/proc/cpuinfo', encoding='utf-8') as file:
        for line in file:
            if line.startswith('model name'):
                return line.split(':', 1)[1].strip()
    return 'unknown'


def load():
    return round(os.getloadavg()[0], 2)


def make_report(arguments):
    now = datetime.datetime.now(datetime.timezone.utc)
    notes = []
    report = {'program': 'pipeline', 'date': now.strftime('%Y-%m-%d %H:%M UTC'),
              'revision': arguments.revision, 'processor': processor(),
              'threads': os.cpu_count(), 'extent': arguments.extent, 'load': [load()]}
    with tempfile.TemporaryDirectory(prefix='rangezip-pipeline-') as folder:
        inputs = list_inputs(arguments.data, arguments.extent == 'full', folder, notes)
        report['rows'] = measure(inputs, list_backends(notes),
                                 3 if arguments.extent == 'full' else 1, folder)
    report['load'].append(load())
    report['notes'] = notes
    return report


def store(path, report):
    """Beside its place first: no half of a report is left there."""
    with open(path + '.part', 'w', encoding='utf-8') as file:
        json.dump(report, file, indent=1)
        file.write('\n')
    os.replace(path + '.part', path)


def print_table(report):
    print(machine_line(report))
    cpu = {row['input']: row for row in report['rows'] if row['backend'] == 'cpu'}
    print_sections([table(
        ('`rangezip mesh`', 'backend', 'wall', 'cpu', 'peak', 'sooner than `cpu`', 'mesh file'),
        ((row['input'], f'`{row["backend"]}`', f'{row["wall_seconds"]:.2f} s',
          f'{row["cpu_seconds"]:.2f} s', f'{row["peak_bytes"] / 2**20:.0f} MB',
          f'{cpu[row["input"]]["wall_seconds"] / row["wall_seconds"]:.3g}',
          'the same bytes' if row['identical'] else 'OTHER BYTES') for row in report['rows']))])
    for backend, renderer in dict.fromkeys(
            (row['backend'], row['renderer']) for row in report['rows']):
        print(f'- {backend}: {renderer}')
    for note in report['notes']:
        print(f'- {note}')


def parse():
    shared = os.environ.get('RANGEZIP_SHARED', os.path.join(REPOSITORY, '../shared'))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('extent', nargs='?', default='quick', choices=('quick', 'full'))
    parser.add_argument('--data', metavar='FOLDER', default=os.path.join(shared, 'data'))
    parser.add_argument('--json', metavar='FILE')
    parser.add_argument('--revision', metavar='TEXT', default='unknown')
    parser.add_argument('--table', metavar='FILE', help='prints the table of a stored report')
    return parser.parse_args()


def main():
    arguments = parse()
    if arguments.table:
        print_table(read(arguments.table, 'pipeline'))
        return
    try:
        report = make_report(arguments)
        if arguments.json:
            store(arguments.json, report)
    except (Failure, OSError, subprocess.CalledProcessError) as error:
        sys.exit(f'pipeline.py: {error}')
    if not all(row['identical'] for row in report['rows']):
        sys.exit('pipeline.py: a mesh is not that by cpu')


if __name__ == '__main__':
    main()
