#!/usr/bin/python3
"""Holds OpenGL against the CPU on real data: in every pixel of drawings, and in files of meshes.

    data.py [--backend NAME]... [FOLDER]

--backend  of OpenGL, as `rangezip --backend` takes it; default: gl:osmesa and gl:egl
FOLDER     of the data; default: $RANGEZIP_SHARED/data, else ../shared/data

Every file of FOLDER that can be read is drawn from 26 directions, 512 x 512 and 2048 x 2048 pixels,
with each backend, by each strategy, and judged by `rangezip-compare draw`: `compute` and
`fixed_function` must not differ from the CPU in any pixel, and of the differences of `native` none
may be unexplained. Then each input of MESHES goes through `rangezip mesh` with each backend, and
the files must be the same, byte for byte.

Builds the preset `release`, prints a line for each file and stores
benchmarks/results/equality-MACHINE.json. What cannot be read or is missing is named. Exit code 1 if
something differs that must not.
"""
import argparse
import collections
import concurrent.futures
import datetime
import hashlib
import json
import os
import subprocess
import sys
import time

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
APPS = os.path.join(REPOSITORY, 'build/release/apps')
COMPARE = os.path.join(APPS, 'rangezip-compare/rangezip-compare')
RANGEZIP = os.path.join(APPS, 'rangezip/rangezip')
SCRATCH = os.path.join(REPOSITORY, 'out/equality')

DEFAULT_BACKENDS = ['gl:osmesa', 'gl:egl']
STRATEGIES = ['compute', 'fixed_function', 'native']
VIEWS = 26
SIDES = [512, 2048]  # of the square images, in pixels
MESHES = ['range/bunny/bun.conf', 'range/dragon_stand_merged.ply',
          'cloud/rocker-arm_virtual_scan.xyz', 'mesh/rocker-arm.obj', 'mesh/fandisk.obj']
BAD_INPUT = 2  # exit code of rangezip-compare


class Failure(Exception):
    """Ends the program; its text says why."""


def run(*command):
    done = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Failure(f'{" ".join(command)}: exit code {done.returncode}\n{done.stderr}')
    return done.stdout.strip()


def from_names(function):
    """What a function of benchmarks/names.sh says."""
    return run('bash', '-c', f'source benchmarks/names.sh && {function}')


def load_json(path):
    with open(path, encoding='utf-8') as file:
        return json.load(file)


def scratch_path(name, ending):
    return os.path.join(SCRATCH, name.replace('/', '_') + ending)


def data_files(folder):
    """The files below the folder, the largest first, as names within it."""
    paths = [os.path.join(place, name) for place, _, names in os.walk(folder) for name in names]
    paths.sort(key=lambda path: (-os.path.getsize(path), path))
    return [os.path.relpath(path, folder) for path in paths]


def causes_of(total):
    """How many pixels differ for each cause, of a total of rangezip-compare."""
    causes = collections.Counter()
    for counts in total['different'].values():
        causes.update(counts)
    return {cause: count for cause, count in causes.items() if count > 0}


def judgement_of(candidate):
    total = candidate['total']
    judgement = {'identical': total['identical'],
                 'differing': total['pixels'] - total['identical']}
    if not candidate['exact']:
        judgement |= {'unexplained': total['unexplained'], 'causes': causes_of(total),
                      'largest_depth_step': total['largest_depth_step']}
    return judgement


def drawing_of(name, side, report):
    """What goes to the result of a report of rangezip-compare, and the drivers."""
    candidates = report['candidates']
    total = candidates[0]['total']
    drawing = {'file': name, 'side': side, 'views': len(report['views']),
               'pixels': total['pixels'], 'covered': total['covered'],
               'by': {each['name']: judgement_of(each) for each in candidates}}
    return drawing, {each['name']: each['renderer'] for each in candidates}


def draw(folder, backends, name, side):
    """Draws one file at one size. Returns what goes to the result, or the reason why it cannot be
    read, and the drivers."""
    report_path = scratch_path(name, f'-{side}.json')
    if os.path.exists(report_path):
        os.remove(report_path)  # of an earlier run
    done = subprocess.run(
        [COMPARE, 'draw', os.path.join(folder, name), '--views', str(VIEWS),
         '--size', f'{side},{side}', '--backends', ','.join(['cpu', *backends]),
         '--strategy', ','.join(STRATEGIES), '--json', report_path],
        capture_output=True, text=True, check=False)
    if done.returncode == BAD_INPUT:
        reason = done.stderr.strip().split(f'{name}: ', 1)[-1]
        return {'file': name, 'reason': reason}, {}
    if not os.path.exists(report_path):
        raise Failure(f'{name}: exit code {done.returncode}: {done.stderr.strip()}')
    return drawing_of(name, side, load_json(report_path))


def is_good(drawing):
    """Whether something was drawn, and nothing differs that must not."""
    return drawing['covered'] > 0 and all(
        judgement.get('unexplained', judgement['differing']) == 0
        for judgement in drawing['by'].values())


def line_of(drawing):
    judgements = drawing['by'].values()
    exact = [j['differing'] for j in judgements if 'unexplained' not in j]
    native = [j for j in judgements if 'unexplained' in j]
    cells = [drawing['file'], drawing['side'], drawing['pixels'], drawing['covered'],
             ', '.join(map(str, exact)), ', '.join(str(j['differing']) for j in native),
             ', '.join(str(j['unexplained']) for j in native)]
    return '| ' + ' | '.join(map(str, cells)) + ' |'


def draw_all(folder, backends):
    """Every file at every size, small ones first, as many at a time as there are processors."""
    drawings, skipped, drivers = [], [], {}
    tasks = [(name, side) for side in SIDES for name in data_files(folder)]
    print('| file | side | pixels | covered | exact strategies: differing | native: differing | '
          'unexplained |\n|---|---|---|---|---|---|---|', flush=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for drawing, used in pool.map(lambda task: draw(folder, backends, *task), tasks):
            if 'reason' not in drawing:
                drawings.append(drawing)
                drivers |= used
                print(line_of(drawing), flush=True)
            elif drawing not in skipped:
                skipped.append(drawing)
                print(f'| {drawing["file"]} | cannot be read: {drawing["reason"]} |', flush=True)
    if not drawings:
        raise Failure(f'{folder} has no file that can be read')
    return drawings, skipped, drivers


def totals_of(drawings):
    """The sums over all drawings, by strategy."""
    totals = {}
    for drawing in drawings:
        for name, judgement in drawing['by'].items():
            total = totals.setdefault(name, collections.Counter())
            total.update({'views': drawing['views'], 'pixels': drawing['pixels'],
                          'covered': drawing['covered'], 'differing': judgement['differing']})
            if 'unexplained' in judgement:
                total.update({'unexplained': judgement['unexplained']} | judgement['causes'])
    return totals


def mesh_file(folder, name, backend):
    """Hash, bytes and seconds of the mesh that a backend makes."""
    path = scratch_path(name, f'-{backend.replace(":", "-")}.ply')
    start = time.monotonic()
    run(RANGEZIP, 'mesh', os.path.join(folder, name), '-o', path, '--quiet', '--backend', backend)
    seconds = time.monotonic() - start
    with open(path, 'rb') as file:
        content = file.read()
    return {'sha256': hashlib.sha256(content).hexdigest(), 'bytes': len(content),
            'seconds': round(seconds, 1)}


def mesh_all(folder, backends):
    """Every input of MESHES with every backend. Returns what came out, and what is missing."""
    meshes, missing = [], []
    print('| input of rangezip mesh | bytes | seconds: cpu, ' + ', '.join(backends) +
          ' | files |\n|---|---|---|---|', flush=True)
    for name in MESHES:
        if not os.path.exists(os.path.join(folder, name)):
            missing.append({'file': name, 'reason': 'is missing'})
            print(f'| {name} | is missing |', flush=True)
            continue
        by = {backend: mesh_file(folder, name, backend) for backend in ['cpu', *backends]}
        meshes.append({'input': name, 'identical': len({m['sha256'] for m in by.values()}) == 1,
                       'by': by})
        print(f'| {name} | {by["cpu"]["bytes"]} | ' +
              ', '.join(str(mesh['seconds']) for mesh in by.values()) +
              f' | {"identical" if meshes[-1]["identical"] else "DIFFERENT"} |', flush=True)
    return meshes, missing


def store(result):
    path = f'benchmarks/results/equality-{from_names("machine_name")}.json'
    whole = os.path.join(REPOSITORY, path)
    with open(whole + '.new', 'w', encoding='utf-8') as file:
        file.write(json.dumps(result, indent=1) + '\n')
    os.replace(whole + '.new', whole)
    print(f'result    {path}')


def check(folder, backends):
    """Returns whether nothing differs that must not."""
    run('cmake', '--preset', 'release')
    run('cmake', '--build', '--preset', 'release', '--target', 'rangezip', 'rangezip-compare')
    os.makedirs(SCRATCH, exist_ok=True)
    start = time.monotonic()
    result = {'program': 'robustness/data.py',
              'date': datetime.datetime.now(datetime.timezone.utc).strftime('%Y-%m-%d %H:%M UTC'),
              'revision': from_names('revision'), 'machine': from_names('machine_name')}
    drawings, skipped, drivers = draw_all(folder, backends)
    meshes, missing = mesh_all(folder, backends)
    totals = totals_of(drawings)
    all_good = all(map(is_good, drawings)) and all(mesh['identical'] for mesh in meshes)
    store(result | {'seconds': round(time.monotonic() - start), 'good': all_good,
                    'drivers': drivers, 'totals': totals, 'drawings': drawings,
                    'skipped': skipped + missing, 'meshes': meshes})
    for name, total in totals.items():
        print(f'{name}: ' + ', '.join(f'{count} {what}' for what, count in total.items()))
    print('nothing differs that must not' if all_good else 'DIFFERENT')
    return all_good


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    shared = os.environ.get('RANGEZIP_SHARED', os.path.join(REPOSITORY, '../shared'))
    parser.add_argument('folder', metavar='FOLDER', nargs='?', default=os.path.join(shared, 'data'))
    parser.add_argument('--backend', action='append', metavar='NAME')
    arguments = parser.parse_args()
    folder = os.path.abspath(arguments.folder)
    try:
        return 0 if check(folder, arguments.backend or DEFAULT_BACKENDS) else 1
    except Failure as failure:
        print(f'data.py: {failure}', file=sys.stderr)
        return 2


if __name__ == '__main__':
    sys.exit(main())
