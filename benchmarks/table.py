#!/usr/bin/python3
"""Makes README.md's tables, as Markdown, of what raster_benchmark has measured.

    table.py RESULTS.json [--all]

RESULTS.json  a file that raster_benchmark --json wrote
--all         also every row of the file

First what is demanded: the figure beside its floor and its goal, and which of them it meets; then
the points beside the limits. A figure whose rows are not in the file is "not measured".
"""
import argparse
import json
import sys

TEN_MILLION = 10_000_000
AVX_512 = 'AVX3'  # as Highway calls it, with endings for its extensions


class Rows:
    """The rows of a file, found by what their names hold."""

    def __init__(self, report):
        self.rows = report['rows']
        self.widest = report['instructions'][0]

    def find(self, **name):
        """The row that has all of these values, or None."""
        for row in self.rows:
            if all(row.get(key) == value for key, value in name.items()):
                return row
        return None

    def points(self, **name):
        wanted = {'what': 'points', 'instructions': self.widest, 'order': 'random', 'size': 1024,
                  'point_size': 1, 'projection': 'parallel', 'count': TEN_MILLION}
        return self.find(**(wanted | name))

    def triangles(self, pixels):
        return self.find(what='triangles', instructions=self.widest, pixels=pixels, size=1024)

    def accumulate(self, order):
        return self.find(what='accumulate', instructions=self.widest, order=order, size=1024,
                         count=TEN_MILLION)

    def avx512_points(self, **name):
        """Points by the widest set, where that is AVX-512."""
        return self.points(**name) if self.widest.startswith(AVX_512) else None


def value(row, key='million_per_second'):
    return None if row is None else row.get(key)


def ratio(above, below, key='million_per_second'):
    if value(above, key) is None or value(below, key) is None:
        return None
    return above[key] / below[key]


def two_threads(rows, scene, key, turned):
    """Two threads by one (turned: one by two) of the best times."""
    pair = [rows.find(what='threads', scene=scene, threads=n) for n in (1, 2)]
    return ratio(*(pair if turned else pair[::-1]), key)


def targets(rows):
    """(what, figure, floor, goal, unit); the unit "<=" is a ratio of which less is better."""
    rate, share, times = ' M/s', ' %', ''
    straight = rows.points()
    lines = [('points of 1 pixel, random order, 1024 x 1024, AVX-512',
              value(rows.avx512_points()), 250, 500, rate),
             ('the same, part of the rate of reading their bytes',
              value(rows.avx512_points(), 'of_read_limit'), 0.1, 0.2, share),
             ('the same, AVX2', value(rows.points(instructions='AVX2')), 150, 250, rate),
             ('4096 x 4096 against 1024 x 1024', ratio(rows.points(size=4096), straight),
              0.6, 0.9, times),
             ('perspective against parallel',
              ratio(rows.points(projection='perspective'), straight), 0.65, 0.8, times)]
    for size, floor in ((2, 60), (3, 55), (5, 45)):
        lines.append((f'points of {size} pixels', value(rows.points(point_size=size)),
                      floor, 2 * floor, rate))
    for pixels, floor, goal in ((0.34, 100, 150), (1.4, 50, 80)):
        lines.append((f'triangles of {pixels} pixels', value(rows.triangles(pixels)),
                      floor, goal, rate))
    fill = value(rows.triangles(400.0), 'pixels_per_second')
    lines.append(('fill of triangles of 400 pixels', fill and fill / 1e9, 0.5, 1, ' Gpx/s'))
    for order, floor, goal in (('curve', 60, 120), ('random', 25, 60)):
        lines.append((f'`accumulate`, {order} order', value(rows.accumulate(order)),
                      floor, goal, rate))
    for scene in ('points', 'triangles', 'accumulate'):
        cpu = two_threads(rows, scene, 'cpu_seconds', turned=False)
        wall = two_threads(rows, scene, 'wall_seconds', turned=True)
        lines.append((f'two threads, {scene}: processor time against one', cpu, 1.1, 1.03, '<='))
        lines.append((f'two threads, {scene}: how much sooner', wall, 1.7, 1.95, times))
    return lines


def shown(number, unit):
    if unit == ' %':
        return f'{100 * number:.3g} %'
    if unit in ('', '<='):
        return f'{number:.3f}'
    return f'{number:.3g}{unit}' if number < 100 else f'{number:.0f}{unit}'


def bound_cell(figure, bound, unit):
    """A floor or a goal, and whether the figure reaches it."""
    if figure is None:
        return shown(bound, unit)
    is_met = figure <= bound if unit == '<=' else figure >= bound
    return f'{shown(bound, unit)}, {"met" if is_met else "missed"}'


def table(heads, lines):
    yield '| ' + ' | '.join(heads) + ' |'
    yield '|' + '---|' * len(heads)
    for line in lines:
        yield '| ' + ' | '.join(line) + ' |'


def target_table(rows):
    return table(('what', 'figure', 'floor', 'goal'), (
        (what, 'not measured' if figure is None else shown(figure, unit),
         bound_cell(figure, floor, unit), bound_cell(figure, goal, unit))
        for what, figure, floor, goal, unit in targets(rows)))


def instructions_of(row):
    """Their name, Highway's own explained."""
    name = row['instructions']
    return f'{name} (AVX-512)' if name.startswith(AVX_512) else name


def limit_table(rows):
    """Points of one pixel beside what no program beats that reads them."""
    reading = rows.find(what='reading', bytes=value(rows.points(), 'bytes'))
    if reading is None:
        return
    named = [('reading the bytes, the limit', reading),
             ('`memcpy` of the bytes', rows.find(what='memcpy', bytes=reading['bytes']))]
    named += [(f'random order, {instructions_of(row)}', row) for row in rows.rows
              if row == rows.points(instructions=row.get('instructions'))]
    named += [('row after row', rows.points(order='scan')),
              ('along a curve', rows.points(order='curve')),
              ('random order, in perspective', rows.points(projection='perspective'))]
    named += [(f'random order, {size} x {size}', rows.points(size=size))
              for size in (512, 2048, 4096)]
    yield from table(('10 M points of 1 pixel', 'M/s', 'of reading'), (
        (what, f'{TEN_MILLION / row["cpu_seconds"] / 1e6:.1f}',
         f'{100 * row["of_read_limit"]:.1f} %')
        for what, row in named if row is not None))


def row_table(rows):
    measured = ('cpu_seconds', 'wall_seconds', 'million_per_second', 'fragments',
                'pixels_per_second', 'runs', 'load', 'of_read_limit', 'bytes')

    def line(row):
        limit = row.get('of_read_limit')
        name = ', '.join(f'{key} {row[key]}' if not isinstance(row[key], str) else row[key]
                         for key in row if key not in measured or
                         (key == 'bytes' and row['what'] in ('reading', 'memcpy')))
        return (name, f'{row["million_per_second"]:.1f}', f'{1e3 * row["cpu_seconds"]:.3f}',
                f'{1e3 * row["wall_seconds"]:.3f}',
                f'{row["pixels_per_second"] / 1e9:.3f}' if 'pixels_per_second' in row else '-',
                f'{100 * limit:.1f} %' if limit is not None else '-')
    return table(('row', 'M/s', 'cpu, ms', 'wall, ms', 'Gpx/s', 'of reading'),
                 (line(row) for row in rows.rows))


def read(path, program):
    """The report of a program. Ends this one if there is none."""
    try:
        with open(path, encoding='utf-8') as file:
            report = json.load(file)
    except OSError as error:
        sys.exit(f'{path}: {error.strerror}')
    except json.JSONDecodeError as error:
        sys.exit(f'{path}: no JSON: {error}')
    if not isinstance(report, dict) or report.get('program') != program or 'rows' not in report:
        sys.exit(f'{path}: no results of {program}')
    return report


def machine_line(report):
    """Where, when and of what a report was measured."""
    load = ' to '.join(f'{load:.2f}' for load in report['load'])
    compiler = f'{report["compiler"]}; ' if 'compiler' in report else ''
    return (f'{report["processor"]}, {report["threads"]} threads, load {load}; {compiler}'
            f'revision {report["revision"]}; {report["date"]}.\n')


def print_sections(sections):
    """Tables, those without lines left out."""
    for section in map(list, sections):
        if section:
            print('\n'.join(section), end='\n\n')


def print_tables(report, has_all):
    rows = Rows(report)
    print(machine_line(report))
    print_sections([target_table(rows), limit_table(rows)] +
                   [row_table(rows)] * has_all)
    for note in report['notes']:
        print(f'- {note}')


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('results')
    parser.add_argument('--all', action='store_true', help='also every row of the file')
    arguments = parser.parse_args()
    print_tables(read(arguments.results, 'raster_benchmark'), arguments.all)


if __name__ == '__main__':
    main()
