#!/usr/bin/python3
"""Prints README.md's tables of stored results; can put them there.

    readme.py [--write] RESULTS.json...

RESULTS.json  of raster_benchmark, backend_benchmark or pipeline.py, as scripts/bench.sh stores them
--write       also puts the tables into README.md, in the place of those there

README.md has a block for each of these programs, between the lines <!-- begin PROGRAM --> and
<!-- end PROGRAM -->: where the results are stored, then what the program's table script prints. Of
backend_benchmark and of pipeline there is a second one, PROGRAM_gpu, for results with a GPU. What
stands around the blocks is written by hand.
"""
import argparse
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
REPOSITORY = os.path.dirname(HERE)
README = os.path.join(REPOSITORY, 'README.md')
TABLES = {'raster_benchmark': ['table.py'], 'backend_benchmark': ['backend_table.py'],
          'pipeline': ['pipeline.py', '--table']}


def has_gpu(report):
    """Whether something was drawn by other than the processor and Mesa's software renderer."""
    if 'contexts' in report:
        return any(not context['is_software'] for context in report['contexts'])
    renderers = [row.get('renderer', 'cpu') for row in report['rows']]
    return any(not name.startswith('cpu') and 'llvmpipe' not in name for name in renderers)


def block_name(path):
    """PROGRAM or PROGRAM_gpu."""
    try:
        with open(path, encoding='utf-8') as file:
            report = json.load(file)
        program = report.get('program')
    except (OSError, AttributeError, json.JSONDecodeError) as error:
        sys.exit(f'readme.py: {path}: {error}')
    if program not in TABLES:
        sys.exit(f'readme.py: {path}: no results of {", ".join(TABLES)}')
    return f'{program}_gpu' if has_gpu(report) else program


def block_of(name, path):
    script, *options = TABLES[name.removesuffix('_gpu')]
    done = subprocess.run([os.path.join(HERE, script), *options, path], stdout=subprocess.PIPE,
                          text=True, check=False)
    if done.returncode != 0:
        sys.exit(f'readme.py: {script} ended with {done.returncode}')
    link = os.path.relpath(path, REPOSITORY)
    return f'Stored as [{link}]({link}): {done.stdout.rstrip()}'


def replaced(text, name, block):
    begin, end = (f'<!-- {word} {name} -->\n' for word in ('begin', 'end'))
    if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
        sys.exit(f'readme.py: README.md has no block from {begin.strip()} to {end.strip()}')
    return text[:text.index(begin)] + begin + block + '\n' + text[text.index(end):]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('results', nargs='+')
    parser.add_argument('--write', action='store_true', help='also puts the tables into README.md')
    arguments = parser.parse_args()
    names = [block_name(path) for path in arguments.results]
    blocks = [block_of(*both) for both in zip(names, map(os.path.abspath, arguments.results))]
    print('\n\n'.join(blocks))
    if not arguments.write:
        return
    with open(README, encoding='utf-8') as file:
        text = file.read()
    for name, block in zip(names, blocks):
        text = replaced(text, name, block)
    with open(README + '.part', 'w', encoding='utf-8') as file:
        file.write(text)
    os.replace(README + '.part', README)


if __name__ == '__main__':
    main()
