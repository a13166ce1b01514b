#!/usr/bin/python3
"""Prints README.md's tables of stored results; can put them there.

    readme.py [--write] RESULTS.json...

RESULTS.json  of raster_benchmark, backend_benchmark or pipeline.py, as scripts/bench.sh stores them
--write       also puts the tables into README.md, in the place of those there

README.md has a block for each of these programs, between the lines <!-- begin PROGRAM --> and
<!-- end PROGRAM -->: where the results are stored, then what the program's table script prints.
What stands around the blocks is written by hand.
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


def program_of(path):
    try:
        with open(path, encoding='utf-8') as file:
            program = json.load(file).get('program')
    except (OSError, AttributeError, json.JSONDecodeError) as error:
        sys.exit(f'readme.py: {path}: {error}')
    if program not in TABLES:
        sys.exit(f'readme.py: {path}: no results of {", ".join(TABLES)}')
    return program


def block_of(program, path):
    script, *options = TABLES[program]
    done = subprocess.run([os.path.join(HERE, script), *options, path], stdout=subprocess.PIPE,
                          text=True, check=False)
    if done.returncode != 0:
        sys.exit(f'readme.py: {script} ended with {done.returncode}')
    link = os.path.relpath(path, REPOSITORY)
    return f'Stored as [{link}]({link}): {done.stdout.rstrip()}'


def replaced(text, program, block):
    begin, end = (f'<!-- {word} {program} -->\n' for word in ('begin', 'end'))
    if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
        sys.exit(f'readme.py: README.md has no block from {begin.strip()} to {end.strip()}')
    return text[:text.index(begin)] + begin + block + '\n' + text[text.index(end):]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('results', nargs='+')
    parser.add_argument('--write', action='store_true', help='also puts the tables into README.md')
    arguments = parser.parse_args()
    programs = [program_of(path) for path in arguments.results]
    blocks = [block_of(*both) for both in zip(programs, map(os.path.abspath, arguments.results))]
    print('\n\n'.join(blocks))
    if not arguments.write:
        return
    with open(README, encoding='utf-8') as file:
        text = file.read()
    for program, block in zip(programs, blocks):
        text = replaced(text, program, block)
    with open(README + '.part', 'w', encoding='utf-8') as file:
        file.write(text)
    os.replace(README + '.part', README)


if __name__ == '__main__':
    main()
