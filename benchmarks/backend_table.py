#!/usr/bin/python3
"""Makes README.md's tables of the backends, as Markdown, of what backend_benchmark has measured.

    backend_table.py RESULTS.json [--all]

RESULTS.json  a file that backend_benchmark --json wrote
--all         also the phases of every scene

First what is demanded beside what was seen; then, for each OpenGL context, items a second of every
backend; and what upload, drawing and read-back take. Times of a software renderer that draws on
the calling thread are processor time, all others wall time. What was not measured says so.
"""
import argparse

from table import machine_line, print_sections, read, table

MILLION = 1_000_000
STRATEGIES = ('native', 'fixed_function', 'compute')
SCENE = ('scene', 'order', 'point_size', 'pixels', 'size', 'count')


def holds(row, name):
    return all(row.get(key) == value for key, value in name.items())


def scene_of(row):
    return {key: row[key] for key in SCENE if key in row}


def points(**name):
    """The name of a scene of points."""
    return {'scene': 'points', 'order': 'random', 'point_size': 1, 'size': 1024} | name


def seconds(row, part=None):
    """What a run took, or a part of it, by the clock that counts."""
    times = row if part is None else row['parts'][part]
    return times['wall_seconds' if row.get('rate_by') == 'wall' else 'cpu_seconds']


class Results:
    def __init__(self, report):
        self.rows = report['rows']
        self.contexts = report['contexts']
        self.threads = report['threads']

    def find(self, **name):
        """Of the rows that have all of these values the one with the most items, or None."""
        found = [row for row in self.rows if holds(row, name)]
        return max(found, key=lambda row: row.get('count', 0), default=None)

    def drawing(self, context, by, content='resident', **scene):
        return self.find(what='drawing', context=context['context'], by=by, content=content,
                         **scene)

    def cpu(self, threads, **scene):
        return self.find(what='drawing', by='cpu', threads=threads, **scene)

    def copied_bytes_per_second(self, context):
        """By the driver or by a kernel, whichever is faster."""
        rates = [row['million_per_second'] * 1e6 for row in self.rows
                 if holds(row, {'what': 'device copy', 'context': context['context']})]
        return max(rates, default=None)

    def scenes(self, context):
        """The names of the scenes that a context drew, in their order."""
        scenes = [scene_of(row) for row in self.rows if row.get('context') == context['context']
                  and row['what'] == 'drawing']
        return [scene for i, scene in enumerate(scenes) if scene not in scenes[:i]]


def text_of(scene):
    size = scene.get('point_size') or scene['pixels']
    order = f', {scene["order"]} order' if 'order' in scene else ''
    count = f'{scene["count"]:,} ' if 'count' in scene else ''
    return (f'{count}{scene["scene"]} of {size:g} pixel{"s" * (size != 1)}{order}, '
            f'{scene["size"]} x {scene["size"]}')


# What is demanded.

def drawing_ratio(above, below):
    """Of the times of drawing alone; None where one was not measured."""
    return above and below and seconds(above, 'draw') / seconds(below, 'draw')


def ratio_lines(results, context):
    """Of a software renderer: (what, figure, demanded, whether it is met)."""
    def line(what, figure, bound, is_at_most):
        seen = 'not measured' if not figure else f'{figure:.2f}'
        met = figure and (figure <= bound if is_at_most else figure >= bound)
        demanded = f'{"<=" if is_at_most else ">="} {bound:.1f}'
        return what, seen, demanded if not figure else f'{demanded}, {"met" if met else "missed"}'

    name = context['context']
    scenes = [points(count=MILLION), points(count=MILLION, order='scan'),
              points(count=MILLION, point_size=3)]
    scenes += [{'scene': 'triangles', 'pixels': pixels, 'size': 512} for pixels in (0.34, 1.4)]
    for scene in scenes:
        fixed, native = (results.drawing(context, by, **scene)
                         for by in ('fixed_function', 'native'))
        what = text_of(scene_of(fixed) if fixed else scene)
        yield line(f'{name}: time of `fixed_function` by that of `native`, {what}',
                   drawing_ratio(fixed, native), 1.1 if scene['scene'] == 'points' else 1.6, True)
    scene = points(count=MILLION)
    yield line(f'{name}: times that `compute` is faster than `native`, {text_of(scene)}',
               drawing_ratio(results.drawing(context, 'native', **scene),
                             results.drawing(context, 'compute', **scene)), 5.0, False)


def gpu_lines(results):
    """The resident points of 1 pixel by `compute`, drawing alone."""
    what = 'resident points of 1 pixel, random order, 2048 x 2048, by `compute`'
    share = 'the same, part of the rate at which the device copies their bytes'
    lines = []
    for context in results.contexts:
        if context['is_software']:
            continue
        row = results.drawing(context, 'compute', **points(size=2048))
        copied = results.copied_bytes_per_second(context)
        if row is None or copied is None:
            lines.append((f'{context["context"]}: {what}', 'not measured', '>= 20 G/s'))
            continue
        time = seconds(row, 'draw')
        rate, part = row['count'] / time, row['bytes'] / time / copied
        lines += [(f'{context["context"]}: {what} ({row["count"]:,})', f'{rate / 1e9:.3g} G/s',
                   f'>= 20 G/s, {"met" if rate >= 20e9 else "missed"}'),
                  (f'{context["context"]}: {share}', f'{100 * part:.3g} %',
                   f'goal 50 %, {"met" if part >= 0.5 else "missed"}')]
    return lines


def demanded_table(results):
    lines = [line for context in results.contexts if context['is_software']
             for line in ratio_lines(results, context)]
    return table(('what', 'seen', 'demanded'), lines + gpu_lines(results))


# What was seen.

def rate_cell(row):
    if row is None:
        return '-'
    rate = row['count'] / seconds(row) / 1e6
    return f'{rate:.3g}' if rate < 100 else f'{rate:.0f}'


def times_cell(row, than):
    return '-' if row is None or than is None else \
        f'{row["count"] / seconds(row) * seconds(than) / than["count"]:.3g}'


def rate_table(results, context):
    threads = results.threads
    heads = [f'{context["context"]}, M/s', 'CPU, 1 thread']
    heads += [f'CPU, {threads} threads'] * (threads > 1)
    heads += [f'`{by}`' for by in STRATEGIES]
    heads += [f'`compute` : CPU, {threads} thread{"s" * (threads > 1)}', '`compute` : `native`']
    lines = []
    for scene in results.scenes(context):
        cpu = [results.cpu(n, **scene) for n in sorted({1, threads})]
        native, fixed, compute = (results.drawing(context, by, **scene) for by in STRATEGIES)
        lines.append([text_of(scene)] + [rate_cell(row) for row in (*cpu, native, fixed, compute)]
                     + [times_cell(compute, cpu[-1]), times_cell(compute, native)])
    return table(heads, lines)


def phase_table(results, context, has_all):
    heads = (f'{context["context"]}, nothing kept, ms', 'strategy', 'upload', 'drawing',
             'read-back', 'the whole call', 'with the scene kept')
    scenes = results.scenes(context)
    if not has_all:  # the first of each kind
        kinds = [scene['scene'] for scene in scenes]
        scenes = [scene for i, scene in enumerate(scenes) if scene['scene'] not in kinds[:i]]
    lines = []
    for scene in scenes:
        for by in STRATEGIES:
            row = results.drawing(context, by, 'one-shot', **scene)
            kept = results.drawing(context, by, **scene)
            if row is None or kept is None:
                continue
            times = [seconds(row, part) for part in ('upload', 'draw', 'read')]
            lines.append([text_of(scene), f'`{by}`'] +
                         [f'{1e3 * time:.1f}' for time in (*times, seconds(row), seconds(kept))])
    return table(heads, lines)


def limit_line(results):
    reading, copying = (results.find(what=what) for what in ('reading', 'memcpy'))
    if reading is None or copying is None:
        return []
    return [f'- one core reads {reading["million_per_second"] / 1e3:.3g} GB/s of memory and copies '
            f'{copying["million_per_second"] / 1e3:.3g} GB/s']


def context_line(results, context):
    copied = results.copied_bytes_per_second(context)
    copies = '' if copied is None else \
        f'; copies {float(f"{copied / 1e9:.3g}"):g} GB/s from one buffer of the device to another'
    return f'- {context["context"]}: {context["renderer"]}, OpenGL {context["version"]}{copies}'


def print_tables(report, has_all):
    results = Results(report)
    print(machine_line(report))
    sections = [demanded_table(results)]
    sections += [rate_table(results, context) for context in results.contexts]
    sections += [phase_table(results, context, has_all) for context in results.contexts]
    print_sections(sections)
    notes = [context_line(results, context) for context in results.contexts] + limit_line(results)
    if any(context['is_software'] for context in results.contexts):
        mesa = report['LP_NUM_THREADS']
        where = 'on the calling thread' if mesa == '0' else f'with {mesa} threads'
        notes.append(f'- Mesa\'s software renderer draws {where} (LP_NUM_THREADS={mesa})')
    print('\n'.join(notes + [f'- {note}' for note in report['notes']]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('results')
    parser.add_argument('--all', action='store_true', help='also the phases of every scene')
    arguments = parser.parse_args()
    print_tables(read(arguments.results, 'backend_benchmark'), arguments.all)


if __name__ == '__main__':
    main()
