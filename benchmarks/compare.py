#!/usr/bin/python3
"""Compares how fast two revisions draw, on this machine, in turn.

    compare.py BASE HEAD [--only WHAT]... [--runs N] [--own] [--jobs N] [--json FILE]

BASE, HEAD  revisions of git; "." or "WORKTREE": the working tree with what is not committed
--only      a part of raster_benchmark: points, triangles, accumulate, threads; default: all
--runs      rounds of BASE, HEAD, default 3: the best of each row counts
--own       each revision is measured by its own benchmark; default: both by the benchmark of HEAD,
            so that both draw the same scenes
--jobs      of the build; default: as many as ninja takes
--json      stores all runs

Builds the preset `release` in temporary folders, which it removes, with ccache where it is
installed. A row is called faster or slower where it changes by more than the spreads of the runs of
both revisions together, and by more than 5 %. The rows `reading` and `memcpy` do not depend on the
revision: what they change by is the machine's doing.
"""
import argparse
import contextlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile

REPOSITORY = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LEAST_CHANGE = 0.05
BENCHMARK = 'build/release/benchmarks/raster_benchmark'
# What a row measures; the rest says which row it is.
MEASURED = {'million_per_second', 'cpu_seconds', 'wall_seconds', 'fragments', 'pixels_per_second',
            'runs', 'load', 'of_read_limit'}


class Failure(Exception):
    """Ends the program; its text says why."""


def run(command, what, **options):
    """Runs a command; if it fails, what it wrote becomes the error."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False, **options)
    if done.returncode != 0:
        tail = '\n'.join(done.stdout.splitlines()[-30:])
        raise Failure(f'{what} failed with exit code {done.returncode}:\n{tail}')
    return done.stdout


def git(*arguments):
    return run(['git', '-C', REPOSITORY, *arguments], f'git {arguments[0]}').strip()


def is_working_tree(revision):
    return revision in ('.', 'WORKTREE')


def commit_of(revision):
    """The commit that a revision names; None: the working tree."""
    if is_working_tree(revision):
        return None
    try:
        return git('rev-parse', '--verify', '--quiet', '--end-of-options', revision + '^{commit}')
    except Failure:
        raise Failure(f'{revision} is no revision of {REPOSITORY}') from None


def label_of(revision, commit):
    return 'working tree' if commit is None else f'{revision} ({commit[:9]})'


def copy_working_tree(folder):
    """The files of the working tree that git has or would take."""
    names = git('ls-files', '-z', '--cached', '--others', '--exclude-standard').split('\0')
    for name in filter(None, names):
        source, target = os.path.join(REPOSITORY, name), os.path.join(folder, name)
        if os.path.lexists(source):  # else it was deleted
            os.makedirs(os.path.dirname(target), exist_ok=True)
            shutil.copy2(source, target, follow_symlinks=False)


@contextlib.contextmanager
def checkout(commit, folder):
    """The files of a commit or of the working tree in `folder`; a git worktree does not stay."""
    if commit is None:
        copy_working_tree(folder)
        yield
        return
    git('worktree', 'add', '--detach', folder, commit)
    try:
        yield
    finally:
        git('worktree', 'remove', '--force', folder)


def build(folder, label, whose, jobs):
    environment = dict(os.environ)
    configure = ['cmake', '--preset', 'release']
    if shutil.which('ccache'):
        # The same file in another folder is the same file.
        environment.update(CCACHE_BASEDIR=folder, CCACHE_NOHASHDIR='1')
        configure.append('-DCMAKE_CXX_COMPILER_LAUNCHER=ccache')
    command = ['cmake', '--build', '--preset', 'release', '--target', 'raster_benchmark']
    if jobs:
        command.append(f'-j{jobs}')
    print(f'{label}: building {whose} benchmark', file=sys.stderr, flush=True)
    run(configure, f'{label}: configuring', cwd=folder, env=environment)
    run(command, f'{label}: building {whose} benchmark', cwd=folder, env=environment)


def take_benchmarks(of_folder, to_folder):
    target = os.path.join(to_folder, 'benchmarks')
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(os.path.join(of_folder, 'benchmarks'), target)


def key_of(row):
    return '  '.join(str(value) if isinstance(value, str) else f'{name} {value}'
                     for name, value in row.items() if name not in MEASURED)


def measure(folder, label, only):
    """Million items a second of each row of one run."""
    results = os.path.join(folder, 'compare.json')
    options = [option for part in only for option in ('--only', part)]
    run([os.path.join(folder, BENCHMARK), 'quick', *options, '--json', results],
        f'{label}: raster_benchmark', cwd=folder)
    with open(results, encoding='utf-8') as file:
        report = json.load(file)
    # Before there were notes of the machine, the file was the list of rows.
    rows = report if isinstance(report, list) else report['rows']
    rates = {}
    for row in rows:
        rates[key_of(row)] = row['million_per_second']
        if 'threads' in row:  # what threads are for
            rates[key_of(row) + '  by wall time'] = (
                row['million_per_second'] * row['cpu_seconds'] / row['wall_seconds'])
    return rates


def rates_of(runs, key):
    return [run_[key] for run_ in runs if key in run_]


def spread(rates):
    """How far the runs lie apart, as a part of the best."""
    return 1 - min(rates) / max(rates) if rates else 0.0


def compare(key, base_runs, head_runs):
    """One row of the table as a dictionary."""
    base, head = rates_of(base_runs, key), rates_of(head_runs, key)
    row = {'row': key, 'base': max(base, default=None), 'head': max(head, default=None),
           'base_spread': spread(base), 'head_spread': spread(head)}
    if not base or not head:
        return row | {'ratio': None, 'verdict': 'head only' if head else 'base only'}
    ratio = row['head'] / row['base']
    noise = max(row['base_spread'] + row['head_spread'], LEAST_CHANGE)
    verdict = 'faster' if ratio > 1 + noise else 'slower' if ratio < 1 - noise else ''
    return row | {'ratio': ratio, 'verdict': verdict}


def print_table(rows, base_label, head_label):
    def rate(value):
        return '-' if value is None else f'{value:.1f}' if value >= 10 else f'{value:.3f}'

    width = max(len(row['row']) for row in rows)
    print(f'base: {base_label}; head: {head_label}; million items a second of processor time '
          '(threads: of wall time too), the best run; in brackets the spread of the runs\n')
    print(f'{"row":{width}} {"base":>18} {"head":>18} {"ratio":>7}')
    for row in rows:
        cells = [f'{rate(row[side]):>10} ({100 * row[side + "_spread"]:4.1f} %)'
                 for side in ('base', 'head')]
        ratio = '-' if row['ratio'] is None else f'{row["ratio"]:.3f}'
        line = f'{row["row"]:{width}} {cells[0]:>18} {cells[1]:>18} {ratio:>7}'
        print(f'{line}  {row["verdict"]}'.rstrip())


def store(path, report):
    with open(path, 'w', encoding='utf-8') as file:
        json.dump(report, file, indent=1)
        file.write('\n')


def compare_revisions(arguments):
    names = (arguments.base, arguments.head)
    commits = [commit_of(name) for name in names]
    labels = [label_of(name, commit) for name, commit in zip(names, commits)]
    with contextlib.ExitStack() as stack:
        work = stack.enter_context(tempfile.TemporaryDirectory(prefix='rangezip-compare-'))
        folders = [os.path.join(work, side) for side in ('base', 'head')]
        for commit, folder in zip(commits, folders):
            stack.enter_context(checkout(commit, folder))
        whose = ['its own', 'its own']
        if not arguments.own:
            take_benchmarks(folders[1], folders[0])
            whose[0] = "HEAD's (--own: its own)"
        for folder, label, benchmark in zip(folders, labels, whose):
            build(folder, label, benchmark, arguments.jobs)
        runs = [[], []]
        for round_ in range(arguments.runs):
            print(f'round {round_ + 1} of {arguments.runs}', file=sys.stderr, flush=True)
            for side, (folder, label) in enumerate(zip(folders, labels)):
                runs[side].append(measure(folder, label, arguments.only))
    keys = list(dict.fromkeys(key for run_ in runs[0] + runs[1] for key in run_))
    rows = [compare(key, *runs) for key in keys]
    print_table(rows, *labels)
    if arguments.runs == 1:
        print(f'\none run has no spread: a change below {LEAST_CHANGE:.0%} counts as noise')
    if arguments.json:
        store(arguments.json, {'base': labels[0], 'head': labels[1], 'commits': commits,
                               'rows': rows, 'base_runs': runs[0], 'head_runs': runs[1]})


def positive(text):
    number = int(text)
    if number < 1:
        raise ValueError
    return number


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('base', metavar='BASE', help='a revision of git, "." or "WORKTREE"')
    parser.add_argument('head', metavar='HEAD', help='likewise')
    parser.add_argument('--only', metavar='WHAT', action='append', default=[],
                        choices=('points', 'triangles', 'accumulate', 'threads'),
                        help='points, triangles, accumulate, threads; default: all')
    parser.add_argument('--runs', metavar='N', type=positive, default=3, help='default: 3')
    parser.add_argument('--own', action='store_true',
                        help='measure each revision by its own benchmark, not both by that of HEAD')
    parser.add_argument('--jobs', metavar='N', type=positive, help='of the build')
    parser.add_argument('--json', metavar='FILE', help='stores all runs')
    return parser.parse_args()


def main():
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # tidies up as after Ctrl-C
    try:
        compare_revisions(parse())
    except (Failure, OSError) as error:
        sys.exit(f'compare.py: {error}')
    except KeyboardInterrupt:
        sys.exit('compare.py: interrupted')


if __name__ == '__main__':
    main()
