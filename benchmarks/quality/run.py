#!/usr/bin/python3
"""Meshes the reference inputs with `rangezip mesh` and prints what was reached as a Markdown table.

    run.py [--program PATH] [--shared DIR] [--out DIR] [--threads N] [--only NAME]... [--list]

See README.md beside this file. Exit code: 0 if every figure is reached, 1 if one is missed, 2 if
something needed is not there.
"""
import argparse
import json
import os
import subprocess
import sys
from dataclasses import dataclass, field

import numpy as np

import boundary_check
import foreign
import raw_scans
import shapes

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, '../..'))


@dataclass
class Bound:
    """A figure of the judgement and what it must be."""
    figure: str
    relation: str       # '==', '<=' or '>='
    limit: float
    percent: bool = False

    def holds(self, value):
        if value is None:
            return False
        return {'==': value == self.limit, '<=': value <= self.limit, '>=': value >= self.limit}[self.relation]

    def text(self, value):
        if value is None:
            return 'none'
        if self.percent:
            return '%.4g %%' % (100 * value)
        return '%.4g' % value if isinstance(value, float) else str(value)


@dataclass
class Sampled:
    """A cloud drawn from a mesh by shared/eval/sample.py."""
    mesh: str
    points: int
    seed: int
    noise: float = 0.0  # of the diagonal, in x, y and z

    def text(self):
        noise = ', noise %g %%' % (100 * self.noise) if self.noise else ''
        return '%s, %d points%s' % (self.mesh, self.points, noise)


@dataclass
class Scanned:
    """The merged raw scans of raw_scans.py of a mesh."""
    mesh: str
    seed: int
    scanner: raw_scans.Scanner

    def text(self):
        return '%s, %d raw scans, registered to %g %%' % (
            self.mesh, self.scanner.scans, 100 * self.scanner.shift)


@dataclass
class Foreign:
    """A file below shared/data of a type that the program does not read, converted by foreign.py."""
    file: str

    def text(self):
        return self.file

    def is_cloud(self):
        return self.file.endswith(('.las', '.las.gz', '.pcd'))


@dataclass
class Made:
    """A body of shapes.py and its cloud, lengths in the pixel side that is chosen for it."""
    shape: str

    def text(self):
        return self.shape


@dataclass
class Case:
    name: str
    source: object      # a path below shared/data, Sampled, Scanned, Foreign, or Made
    truth: str = None   # a path below shared/data
    cloud: bool = True  # judge against the input as a cloud
    options: list = field(default_factory=list)  # of rangezip mesh
    bounds: list = field(default_factory=list)


SOUND = [Bound('nonmanifold_edges', '==', 0), Bound('nonmanifold_vertices', '==', 0),
         Bound('self_intersecting_pairs', '==', 0), Bound('misoriented_edges', '==', 0),
         Bound('papered_share', '<=', 0.0001, True)]
CLEAN = [Bound('components', '==', 1)] + SOUND
CLOSED = [Bound('boundary_edges', '==', 0)]
# Of finished models. Not of coarsened meshes, whose triangles are long where the surface bends one way only
# (--decimate, and --triangles of less than a quarter of what the scans give), nor of what is too thin or close.
GOOD_ANGLES = [Bound('min_angle_p50', '>=', 50.0), Bound('min_angle_lt30', '<=', 0.005), Bound('min_angle_lt10', '==', 0.0)]


RIGHT_SIDE_OUT = [Bound('inverted_share', '<=', 0.0002, True)]


def cost(seconds, megabytes):
    return [Bound('cpu_seconds', '<=', seconds), Bound('peak_megabytes', '<=', megabytes)]


def made(shape, *bounds):
    return Case(shape, Made(shape), bounds=sum(bounds, SOUND))


def body(shape, genus, *bounds):
    """One closed body."""
    return made(shape, [Bound('components', '==', 1), Bound('genus', '==', genus)], CLOSED, GOOD_ANGLES, *bounds)


def at_triangles(name, mesh, seed, triangles):
    """As close to the truth as the truth itself with so many triangles."""
    return Case(name, Sampled(mesh, 400_000, seed), options=['--triangles', str(triangles)],
                bounds=CLEAN + CLOSED + [Bound('over_decimated', '<=', 1.05)])


def decimated(name, mesh, points, seed, tolerance, finish='full'):
    """At most 40 % of the triangles without --decimate, at the same root mean square (to 5 %): by edge collapses in the
    full finish, and by quad-trees over the patches of the scans with the others."""
    return Case(name, Sampled(mesh, points, seed), options=['--finish', finish, '--decimate', str(tolerance)],
                bounds=CLEAN + CLOSED + [Bound('faces_over_whole', '<=', 0.4), Bound('rms_over_whole', '<=', 1.05)])


def cad(name, file, *bounds):
    """The triangles of a model: the same surface again, by others that are as good as anywhere."""
    return Case(name, Foreign(file), bounds=sum(bounds, SOUND + CLOSED + GOOD_ANGLES + [
        Bound('accuracy_rms', '<=', 0.0001, True), Bound('completeness_rms', '<=', 0.0001, True)]))


def scene(name, file, *bounds):
    """A scan of many things from afar, which lie open where nothing was seen, and apart."""
    return Case(name, Foreign(file), bounds=sum(bounds, SOUND + [
        Bound('min_angle_lt10', '==', 0.0), Bound('cloud_within_05', '>=', 0.998)]))


def raw(name, mesh, seed, scanner, *bounds):
    """Merged raw scans: one clean component, with borders only where no scan has seen anything."""
    return Case(name, Scanned(mesh, seed, scanner),
                bounds=sum(bounds, CLEAN + GOOD_ANGLES + [Bound('cloud_within_05', '>=', 0.998)]))


CASES = [
    Case('bunny', 'range/bunny/bun.conf', bounds=CLEAN + GOOD_ANGLES + [Bound('cloud_within_05', '>=', 0.998)]),
    Case('dragon', 'range/dragon_stand_merged.ply',
         bounds=CLEAN + GOOD_ANGLES + [
             Bound('cloud_within_05', '>=', 0.998), Bound('points_beyond', '==', 0)]),
    Case('rocker-arm scan', 'cloud/rocker-arm_virtual_scan.xyz', truth='mesh/rocker-arm.obj', cloud=False,
         bounds=CLEAN + CLOSED + GOOD_ANGLES + [
             Bound('genus', '==', 1), Bound('accuracy_mean', '<=', 0.0003, True),
             Bound('accuracy_p95', '<=', 0.00085, True)]),
    Case('rocker-arm polygons', 'mesh/rocker-arm.obj', truth='mesh/rocker-arm.obj', cloud=False,
         bounds=CLEAN + CLOSED + GOOD_ANGLES + [
             Bound('genus', '==', 1), Bound('accuracy_mean', '<=', 0.0001, True)]),
    Case('fandisk polygons', 'mesh/fandisk.obj', truth='mesh/fandisk.obj', cloud=False,
         bounds=CLEAN + CLOSED + GOOD_ANGLES + [
             Bound('genus', '==', 0), Bound('accuracy_mean', '<=', 0.0001, True)]),
    Case('bracket polygons', 'cad/featuretype.STL', truth='cad/featuretype.STL', cloud=False,
         bounds=CLEAN + CLOSED + [Bound('genus', '==', 9), Bound('accuracy_rms', '<=', 0.0001, True),
                                  Bound('min_angle_lt30', '<=', 0.005)]),
    Case('bunny polygons', 'range/bunny/bun_zipper.ply', truth='range/bunny/bun_zipper.ply', cloud=False,
         bounds=CLEAN + GOOD_ANGLES + RIGHT_SIDE_OUT + [Bound('genus', '==', 0), Bound('boundary_loops', '==', 5),
                                                        Bound('accuracy_rms', '<=', 0.0001, True)]),
    # Twenty bodies that stand in each other, with open and non-manifold edges: one outside of all of it.
    Case('chair polygons', 'mesh/office_chair.obj', truth='mesh/office_chair.obj', cloud=False,
         bounds=CLEAN + [Bound('accuracy_rms', '<=', 0.0005, True)]),
    # Its holes are holes of the object, and stay; so does its genus. Many touch in a vertex, so that their number says little:
    # what is closed of them lies far from the truth, and tells in the accuracy.
    Case('elephant polygons', 'mesh/elephant-with-holes.off', truth='mesh/elephant-with-holes.off', cloud=False,
         bounds=CLEAN + GOOD_ANGLES + [
             Bound('genus', '==', 3), Bound('accuracy_rms', '<=', 0.0005, True), Bound('completeness_rms', '<=', 0.0002, True)]),
    cad('bracket NURBS', 'cad/featuretype.STEP', [Bound('components', '==', 1), Bound('genus', '==', 9)]),
    cad('screw NURBS', 'cad/screw.step', [Bound('components', '==', 1), Bound('genus', '==', 0)]),
    cad('link rods NURBS', 'cad/linkrods.step', [Bound('components', '==', 1), Bound('genus', '==', 2)]),
    cad('hammer NURBS', 'cad/hammer.iges', [Bound('components', '==', 2), Bound('genus', '==', 0)]),  # head and handle
    scene('depth image', 'cloud/table_scene_mug_stereo.pcd'),
    scene('urban', 'cloud/urban.las'),
    scene('stadium', 'cloud/autzen_stadium.las.gz'),
    Case('club', 'seed/club_sampled_16586.xyz', truth='seed/club_mesh.ply',
         bounds=CLEAN + GOOD_ANGLES + [Bound('long_loops', '==', 1), Bound('cloud_within_05', '>=', 0.998),
                                       Bound('points_beyond', '==', 0)]),
    Case('mannequin', 'seed/mannequin_sampled_12772.xyz', truth='seed/mannequin_mesh.off',
         bounds=CLEAN + GOOD_ANGLES + [Bound('long_loops', '==', 1), Bound('cloud_within_05', '>=', 0.998),
                                       Bound('points_beyond', '==', 0)]),
    # Figures from here on are those of the peers that ../shared/eval/peers.md names, or better.
    Case('igea 400 K, 60 K triangles', Sampled('mesh/igea.ply', 400_000, 3), options=['--triangles', '60000'],
         bounds=CLEAN + CLOSED + GOOD_ANGLES + [
             Bound('faces', '>=', 57_000), Bound('faces', '<=', 63_000),
             Bound('accuracy_rms', '<=', 0.000071, True), Bound('completeness_rms', '<=', 0.000075, True),
             Bound('normal_dev_mean', '<=', 3.4)]),
    Case('igea 400 K, noise 0.1 %', Sampled('mesh/igea.ply', 400_000, 4, 0.001), options=['--triangles', '60000'],
         bounds=CLEAN + CLOSED + GOOD_ANGLES + [
             Bound('faces', '>=', 57_000), Bound('faces', '<=', 63_000),
             Bound('accuracy_rms', '<=', 0.00028, True), Bound('completeness_rms', '<=', 0.00028, True),
             Bound('normal_dev_mean', '<=', 4.5)]),
    Case('igea 400 K, noise 0.25 %', Sampled('mesh/igea.ply', 400_000, 5, 0.0025),
         bounds=CLEAN + CLOSED + GOOD_ANGLES + [Bound('accuracy_rms', '<=', 0.00045, True)]),
    Case('fandisk 100 K', Sampled('mesh/fandisk.obj', 100_000, 1),
         bounds=CLEAN + CLOSED + GOOD_ANGLES + [Bound('accuracy_rms', '<=', 0.00005, True),
                                                Bound('normal_dev_p95', '<=', 2.0)]),
    Case('fandisk 100 K, noise 0.1 %', Sampled('mesh/fandisk.obj', 100_000, 2, 0.001),
         bounds=CLEAN + CLOSED + GOOD_ANGLES + [Bound('accuracy_rms', '<=', 0.0003, True),
                                                Bound('fscore_01', '>=', 0.98), Bound('normal_dev_p95', '<=', 12.0)]),
    decimated('fandisk 100 K, decimated', 'mesh/fandisk.obj', 100_000, 1, 0.007),
    decimated('fandisk 400 K, decimated', 'mesh/fandisk.obj', 400_000, 1, 0.006),
    decimated('fandisk 400 K, quad-trees', 'mesh/fandisk.obj', 400_000, 1, 0.08, finish='fast'),
    Case('igea 400 K', Sampled('mesh/igea.ply', 400_000, 3), bounds=CLEAN + CLOSED + GOOD_ANGLES + cost(6, 300)),
    Case('Laurana 400 K', Sampled('mesh/Laurana50k.ply', 400_000, 1), bounds=CLEAN + GOOD_ANGLES + cost(6, 300)),
    Case('igea 1.4 M', Sampled('mesh/igea.ply', 1_400_000, 5), bounds=CLEAN + CLOSED + GOOD_ANGLES + cost(20, 700)),
    Case('dragon 1.4 M', Sampled('range/dragon_vrip_res2.ply', 1_400_000, 6),
         bounds=CLEAN + GOOD_ANGLES + cost(20, 700)),
    raw('dragon raw, 1 M', 'range/dragon_vrip_res2.ply', 8, raw_scans.Scanner(scans=22, pixels=540)),
    raw('igea raw', 'mesh/igea.ply', 7, raw_scans.Scanner(), CLOSED, [Bound('genus', '==', 0)]),
    raw('igea raw, out of place', 'mesh/igea.ply', 10,
        raw_scans.Scanner(pixels=400, shift=0.001, turn=0.12, noise=0.0005, flying=0.4),
        CLOSED, [Bound('genus', '==', 0)]),
    at_triangles('igea, quadrics', 'mesh/igea.ply', 3, 60_000),
    at_triangles('rocker-arm, quadrics', 'mesh/rocker-arm.obj', 21, 10_000),
    at_triangles('fandisk, quadrics', 'mesh/fandisk.obj', 22, 6_000),
    at_triangles('mechpart, quadrics', 'mesh/mechpart_recon.ply', 23, 7_000),
    at_triangles('bracket, quadrics', 'cad/featuretype.STL', 24, 1_700),
    Case('cactus', 'seed/cactus.xyz', bounds=CLEAN),
    Case('distcap', 'seed/distcap.xyz', bounds=CLEAN + GOOD_ANGLES),
    # Bodies made by code (shapes.py): the topology, and what is thin or close from 2 pixel sides on.
    body('sphere', 0, RIGHT_SIDE_OUT), body('torus', 1, RIGHT_SIDE_OUT), body('trefoil', 1, RIGHT_SIDE_OUT),
    # Next to its sharp rim above, faces of one side are nearest to the other: 0.2 %.
    made('bell', [Bound('components', '==', 1), Bound('boundary_loops', '==', 1), Bound('cloud_within_05', '>=', 0.998),
                  Bound('inverted_share', '<=', 0.01, True)]),
    made('bowl', [Bound('components', '==', 1), Bound('boundary_loops', '==', 1)], RIGHT_SIDE_OUT),
    # Seen from both sides, open above and below; and with noise over a quarter of a pixel side.
    made('pipe', [Bound('components', '==', 1), Bound('boundary_loops', '==', 2)], RIGHT_SIDE_OUT),
    *(made(f'{thing} 0.1', [Bound('components', '==', 1), Bound('boundary_loops', '==', 2 if thing == 'pipe' else 1),
                            Bound('cloud_within_05', '>=', 0.998)]) for thing in ('bell', 'bowl', 'pipe')),
    made('plate 0.3'), made('plate 0.9'), body('plate 2', 0), body('plate 3', 0), body('plate 5', 0),
    made('shell 0.3'), made('shell 0.9'), body('shell 2', 0), body('shell 3', 0), body('shell 5', 0),
    body('cube', 0, RIGHT_SIDE_OUT),
    body('pocket 0.5', 0), body('pocket 1', 0), body('pocket 2', 0),
    made('spheres 0'), made('spheres 0.3'), made('spheres 0.8'),
    *(made(f'{two} {gap}', CLOSED, [Bound('components', '==', 2), Bound('euler', '==', 4)])
      for two, gaps in (('spheres', (2, 3)), ('slabs', (2, 3, 4)), ('bars', (2, 3, 4))) for gap in gaps),
    *(body(f'{deep} {width}', 9 if deep == 'drilled' else 0, [Bound('cloud_within_05', '>=', 0.998)])
      for deep in ('slot', 'cavity', 'drilled') for width in (2, 3, 6)),
    *(made(f'perforated {width}', [Bound('components', '==', 1), Bound('boundary_loops', '==', 10)], RIGHT_SIDE_OUT)
      for width in (6, 8, 16)),
    *(body(f'{sharp} {angle}', 0, [Bound('cloud_within_05', '>=', 0.998)])
      for sharp in ('lens', 'star') for angle in (25, 40)),
    made('lens 15'), made('star 15'),
    body('noisy 0.05', 1, RIGHT_SIDE_OUT), body('noisy 0.1', 1, RIGHT_SIDE_OUT), body('noisy 0.2', 1, RIGHT_SIDE_OUT),
    body('contours', 1),
    body('density', 0, [Bound('accuracy_rms', '<=', 0.0001, True)]),
    body('density-bumps', 0, [Bound('dense_over_sparse', '<=', 0.5), Bound('accuracy_rms', '<=', 0.00015, True)]),
    # Of a density that falls to a tenth: what an even cloud shows with walls of 4 h.
    *(body(f'vase {thickness}', 0, [Bound('cloud_within_05', '>=', 0.998)]) for thickness in (4, 6)),
    made('nested', CLOSED, GOOD_ANGLES, [Bound('components', '==', 3), Bound('genus', '==', 1),
                                         Bound('cloud_within_05', '>=', 0.998)]),
    made('balls', CLOSED, [Bound('components', '==', 5), Bound('genus', '==', 0)]),
    body('scans 10', 0, [Bound('cloud_within_05', '>=', 0.998), Bound('completeness_rms', '<=', 0.001, True)]),
    made('fingers', [Bound('components', '==', 1), Bound('false_handles', '==', 0)]),
]

# Judged in every case, also where nothing is demanded of them.
ALSO_SHOWN = ['faces', 'genus', 'boundary_loops', 'accuracy_mean', 'accuracy_p95', 'completeness_p95',
              'cloud_within_05', 'min_angle_lt10', 'cpu_seconds', 'peak_megabytes', 'long_loops',
              'pixel_size']

# Runs a command from a small process of its own: what is reported as the peak memory of a program
# includes that of the process that started it.
MEASURED = '''
import json, resource, subprocess, sys
code = subprocess.run(sys.argv[1:], stdout=sys.stderr).returncode
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
print(json.dumps({'cpu_seconds': usage.ru_utime + usage.ru_stime, 'peak_megabytes': usage.ru_maxrss / 1024}))
sys.exit(code)
'''


class Bench:
    def __init__(self, args):
        self.args = args
        self.data = os.path.join(args.shared, 'data')
        self.judge = os.path.join(args.shared, 'eval', 'mesh_quality.py')
        os.makedirs(args.out, exist_ok=True)

    def path(self, name, suffix):
        plain = name.replace(' ', '_')
        for character in '.,%':
            plain = plain.replace(character, '')
        return os.path.join(self.args.out, plain + suffix)

    def prepare(self, case):
        """The input file, and the truth and the cloud to judge by (or None)."""
        if isinstance(case.source, Sampled):
            cloud, truth = self.path(case.name, '_in.ply'), self.path(case.name, '_truth.ply')
            subprocess.run([sys.executable, os.path.join(self.args.shared, 'eval', 'sample.py'),
                            os.path.join(self.data, case.source.mesh), cloud, '--points',
                            str(case.source.points), '--seed', str(case.source.seed),
                            '--noise', str(case.source.noise), '--truth', truth],
                           check=True)
            return cloud, truth, cloud
        if isinstance(case.source, Scanned):
            cloud, truth = self.path(case.name, '_in.ply'), self.path(case.name, '_truth.ply')
            write_ply = sys.modules['sample'].write_ply
            vertices, faces = sys.modules['sample'].unit_mesh(os.path.join(self.data, case.source.mesh))
            write_ply(cloud, raw_scans.merged_scans(vertices, faces, case.source.scanner, case.source.seed))
            write_ply(truth, vertices, faces)
            return cloud, truth, cloud
        if isinstance(case.source, Foreign):
            return self.prepare_foreign(case, os.path.join(self.data, case.source.file))
        if isinstance(case.source, Made):
            cloud, truth = self.path(case.name, '_in.ply'), self.path(case.name, '_truth.ply')
            shape = shapes.make(case.source.shape)
            write_ply = sys.modules['sample'].write_ply
            write_ply(cloud, shape.points)
            write_ply(truth, shape.vertices, shape.faces)
            return cloud, truth, cloud
        source = os.path.join(self.data, case.source)
        truth = os.path.join(self.data, case.truth) if case.truth else None
        cloud = source if case.cloud else None
        if source.endswith('.conf'):
            cloud = self.path(case.name, '_cloud.npy')
            np.save(cloud, placed_scans(source))
        return source, truth, cloud

    def prepare_foreign(self, case, file):
        source = self.path(case.name, '_in.ply')
        if not case.source.is_cloud():
            sys.modules['sample'].write_ply(source, *foreign.mesh_of_cad(file))
            return source, source, None
        points, cloud = foreign.points_of(file), self.path(case.name, '_cloud.npy')
        foreign.write_points(source, points)
        np.save(cloud, points[np.isfinite(points).all(1)])
        return source, None, cloud

    def mesh(self, case, source):
        """Runs the program; its cost, its report, the mesh's path and the command as text."""
        out, report = self.path(case.name, '.ply'), self.path(case.name, '.json')
        command = [self.args.program, 'mesh', source, '-o', out, '--report', report, '--quiet']
        command += case.options
        if self.args.threads:
            command += ['--threads', str(self.args.threads)]
        measured = subprocess.run([sys.executable, '-c', MEASURED] + command, stdout=subprocess.PIPE, text=True)
        if measured.returncode != 0:
            raise RuntimeError('exit code %d' % measured.returncode)
        figures = json.loads(measured.stdout)
        with open(report) as file:
            return figures, json.load(file), out

    def over_whole(self, case, source, truth, figures):
        """Triangles and RMS distance to the truth, over those of the same run without --decimate."""
        at = case.options.index('--decimate')
        whole = Case(case.name + ', whole', case.source, options=case.options[:at] + case.options[at + 2:])
        _, _, out = self.mesh(whole, source)
        vertices, faces = read_any(out)
        judged = sys.modules['mesh_quality'].measure(vertices, faces, truth=read_any(truth), do_self=False)
        return {'faces_over_whole': figures['faces'] / judged['faces'],
                'rms_over_whole': figures['accuracy_rms'] / judged['accuracy_rms']}

    def figures(self, case):
        source, truth, cloud = self.prepare(case)
        figures, report, out = self.mesh(case, source)
        command = [sys.executable, self.judge, out]
        command += ['--truth', truth] if truth else []
        command += ['--cloud', cloud] if cloud else []
        judged = subprocess.run(command, check=True, capture_output=True, text=True)
        figures.update(json.loads(judged.stdout))
        vertices, faces = read_any(out)
        points = read_any(cloud)[0] if cloud else np.zeros((0, 3))
        figures.update(boundary_check.check(vertices, faces, points, report['pixel_size']))
        figures['pixel_size'] = report['pixel_size']
        figures['papered_share'] = report['papered']['area'] / area_of(vertices, faces)
        if truth:
            figures['inverted_share'] = min(figures['flipped_share'], 1 - figures['flipped_share'])
        if isinstance(case.source, Made):
            shape = shapes.make(case.source.shape)
            figures['false_handles'] = false_handles(figures['genus'], shape.genus)
            if shape.dense_side is not None:
                figures['dense_over_sparse'] = dense_over_sparse((vertices, faces), shape)
        if any(bound.figure == 'over_decimated' for bound in case.bounds):
            figures['over_decimated'] = over_decimated(figures, read_any(truth))
        if any(bound.figure == 'faces_over_whole' for bound in case.bounds):
            figures.update(self.over_whole(case, source, truth, figures))
        with open(self.path(case.name, '_figures.json'), 'w') as file:
            json.dump(figures, file, indent=1)
        return figures

    def row(self, case):
        """A line of the table per demanded figure, and one of the others; the number missed."""
        shown = ' '.join([case.source if isinstance(case.source, str) else case.source.text()] + case.options)
        try:
            figures = self.figures(case)
        except (RuntimeError, subprocess.CalledProcessError) as error:
            detail = getattr(error, 'stderr', None) or str(error)
            print('| %s | `%s` | runs | yes | %s | **no** |' % (case.name, shown, detail.strip()[-200:]))
            return 1
        missed = 0
        for bound in case.bounds:
            value = figures.get(bound.figure)
            missed += not bound.holds(value)
            limit = bound.text(bound.limit)
            print('| %s | `%s` | %s | %s %s | %s | %s |' % (
                case.name, shown, bound.figure, bound.relation, limit, bound.text(value),
                'yes' if bound.holds(value) else '**no**'))
        demanded = {bound.figure for bound in case.bounds}
        others = ', '.join('%s %s' % (name, Bound(name, '==', 0).text(figures[name])) for name in ALSO_SHOWN
                           if figures.get(name) is not None and name not in demanded)
        print('| %s | `%s` | others | | %s | |' % (case.name, shown, others), flush=True)
        return missed


def load_judge(shared):
    sys.path.insert(0, os.path.join(shared, 'eval'))
    __import__('mesh_quality')
    __import__('sample')


def read_any(path):
    return sys.modules['mesh_quality'].read_any(path)


def area_of(vertices, faces):
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def false_handles(genus, known):
    return None if genus is None else genus - known


def over_decimated(figures, truth):
    """RMS distance to the truth, over that of the truth decimated by quadrics to as many triangles."""
    import open3d
    mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(truth[0]),
                                        open3d.utility.Vector3iVector(truth[1]))
    fewer = mesh.simplify_quadric_decimation(figures['faces'])
    decimated = sys.modules['mesh_quality'].measure(np.asarray(fewer.vertices), np.asarray(fewer.triangles).astype(int),
                                                    truth=truth, do_self=False)
    return figures['accuracy_rms'] / max(decimated['accuracy_rms'], 1e-12)


def dense_over_sparse(mesh, shape):
    """RMS distance to the truth on the densely sampled side, over that on the other one."""
    surface = sys.modules['mesh_quality'].Surface
    places, _ = surface(*mesh, np.zeros(3), 1.0).sample(200_000, 1)
    distance, _ = surface(shape.vertices, shape.faces, np.zeros(3), 1.0).closest(places)
    is_dense = places @ shape.dense_side > 0
    return float(np.sqrt((distance[is_dense] ** 2).mean() / (distance[~is_dense] ** 2).mean()))


def placed_scans(conf):
    """The points of all scans of a Stanford .conf in the common frame: transpose(R(q)) p + t."""
    clouds = []
    for line in open(conf):
        word = line.split()
        if not word or word[0] != 'bmesh':
            continue
        points, _ = read_any(os.path.join(os.path.dirname(conf), word[1]))
        tx, ty, tz, x, y, z, w = map(float, word[2:9])
        norm = np.sqrt(x * x + y * y + z * z + w * w)
        x, y, z, w = x / norm, y / norm, z / norm, w / norm
        rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                             [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                             [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        clouds.append(points @ rotation + [tx, ty, tz])
    return np.concatenate(clouds)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=os.path.join(ROOT, 'build/release/apps/rangezip/rangezip'))
    parser.add_argument('--shared', default=boundary_check.DEFAULT_SHARED)
    parser.add_argument('--out', default=os.path.join(ROOT, 'build/quality'))
    parser.add_argument('--threads', type=int, default=0, help='default: all of the machine')
    parser.add_argument('--only', action='append', help='a part of a case\'s name')
    parser.add_argument('--list', action='store_true', help='print the names of the cases')
    args = parser.parse_args()
    chosen = [case for case in CASES if not args.only or any(part in case.name for part in args.only)]
    if not chosen:
        print('run.py: no case has such a name', file=sys.stderr)
        return 2
    if args.list:
        print('\n'.join(case.name for case in chosen))
        return 0
    for needed in (args.program, os.path.join(args.shared, 'eval', 'mesh_quality.py')):
        if not os.path.exists(needed):
            print('run.py: %s is not there' % needed, file=sys.stderr)
            return 2
    load_judge(args.shared)
    bench = Bench(args)
    print('`rangezip mesh INPUT -o OUT.ply`, with the options that stand beside the input\n')
    print('| case | input | figure | must be | is | reached |')
    print('|---|---|---|---|---|---|')
    missed = sum(bench.row(case) for case in chosen)
    print('\n%d figures missed' % missed)
    return 1 if missed else 0


if __name__ == '__main__':
    sys.exit(main())
