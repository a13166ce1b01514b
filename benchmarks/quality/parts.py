#!/usr/bin/python3
"""Meshes machine parts made at random, and prints for how many of them the mesh is right.

    parts.py [--program PATH] [--shared DIR] [--out DIR] [--first SEED] [--parts N] [--points N] [--noise SHARE] [--jobs N]

Blocks with bosses, ribs, slots, and bores that go through or end blind: bodies that nobody has tuned anything for. Those
with walls or gaps narrower than two pixel sides, which no scan resolves, are left out. See README.md beside this file.
Exit code: 0 if all meshes are right, 1 if one is not, 2 if something needed is not there.
"""
import argparse
import math
import os
import sys
from concurrent.futures import ThreadPoolExecutor

import gmsh
import numpy as np
import open3d

import boundary_check
import run
import seeds
import shapes

PIXEL_PER_SPACING = 1.3  # of clouds of so few points: core/plan/spacing.h
NARROW = 2.1             # pixel sides
NARROW_SHARE = 0.0005    # of the surface: where surfaces meet at an angle
PLACES = 20_000


def cylinder(at, axis, length, radius):
    along = np.zeros(3)
    along[axis] = length
    return 3, gmsh.model.occ.addCylinder(*at, *along, radius)


def boss(size, rng):
    axis, above = int(rng.integers(3)), rng.random() < 0.5
    at = size * rng.uniform(0.25, 0.75, 3)
    at[axis] = size[axis] - 0.01 if above else 0.01
    length = rng.uniform(0.08, 0.3) * (1 if above else -1)
    return cylinder(at, axis, length, rng.uniform(0.06, 0.2) * np.delete(size, axis).min())


def rib(size, rng):
    axis = int(rng.integers(3))
    across, along = (axis + 1) % 3, (axis + 2) % 3
    at, extent = np.zeros(3), np.zeros(3)
    at[axis], extent[axis] = size[axis] - 0.01, rng.uniform(0.05, 0.2)
    at[across], extent[across] = rng.uniform(0.2, 0.7) * size[across], rng.uniform(0.03, 0.08)
    at[along], extent[along] = 0.1 * size[along], 0.8 * size[along]
    return 3, gmsh.model.occ.addBox(*at, *extent)


def bore(size, rng):
    """From either side, blind, or through all."""
    axis, goes_through, from_above = int(rng.integers(3)), rng.random() < 0.4, rng.random() < 0.5
    at = size * rng.uniform(0.12, 0.88, 3)
    radius = math.exp(rng.uniform(math.log(0.015), math.log(0.12)))
    outside = 0.35
    if goes_through:
        at[axis] = -outside
        return cylinder(at, axis, size[axis] + 2 * outside, radius)
    at[axis] = size[axis] + outside if from_above else -outside
    length = outside + rng.uniform(0.15, 0.8) * size[axis]
    return cylinder(at, axis, -length if from_above else length, radius)


def slot(size, rng):
    axis = int(rng.integers(3))
    at = size * rng.uniform(-0.1, 0.7, 3)
    extent = size * np.exp(rng.uniform(math.log(0.05), math.log(0.5), 3))
    at[axis], extent[axis] = size[axis] * (1 - rng.uniform(0.05, 0.5)), 2.0
    return 3, gmsh.model.occ.addBox(*at, *extent)


def drawn_part(rng):
    """The largest body of what is left of a block, as a gmsh model."""
    size = np.array([1.0, rng.uniform(0.5, 1), rng.uniform(0.3, 0.9)])
    body = [(3, gmsh.model.occ.addBox(0, 0, 0, *size))]
    added = [boss(size, rng) for _ in range(rng.integers(0, 3))]
    if rng.random() < 0.5:
        added.append(rib(size, rng))
    if added:
        body, _ = gmsh.model.occ.fuse(body, added)
    cut = [bore(size, rng) for _ in range(rng.integers(2, 7))] + [slot(size, rng) for _ in range(rng.integers(0, 3))]
    body, _ = gmsh.model.occ.cut(body, cut)
    gmsh.model.occ.synchronize()
    bodies = sorted(body, key=lambda b: gmsh.model.occ.getMass(*b))
    gmsh.model.occ.remove(bodies[:-1], recursive=True)
    gmsh.model.occ.synchronize()


def part(seed):
    """(vertices, faces) of a part, closed and oriented, with a bounding-box diagonal of one."""
    gmsh.initialize()
    try:
        gmsh.option.setNumber('General.Terminal', 0)
        gmsh.option.setNumber('Mesh.MeshSizeFromCurvature', 24)
        gmsh.option.setNumber('Mesh.MeshSizeMax', 0.2)
        drawn_part(np.random.default_rng(seed))
        gmsh.model.mesh.generate(2)
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        _, corners = gmsh.model.mesh.getElementsByType(2)
    finally:
        gmsh.finalize()
    place = np.zeros(int(tags.max()) + 1, int)
    place[tags] = np.arange(len(tags))
    mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(coordinates.reshape(-1, 3)),
                                        open3d.utility.Vector3iVector(place[corners].reshape(-1, 3)))
    mesh.remove_unreferenced_vertices()
    if not (mesh.is_edge_manifold(allow_boundary_edges=False) and mesh.orient_triangles()):
        raise RuntimeError('part %d is no closed body' % seed)
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    if np.einsum('ij,ij->', a, np.cross(b, c)) < 0:
        faces = faces[:, ::-1]
    extent = np.ptp(vertices, axis=0)
    return (vertices - vertices.min(0) - extent / 2) / np.linalg.norm(extent), faces


def narrow_share(vertices, faces, limit):
    """Of the surface, where a wall or a gap is narrower than a limit: from places half of it inside and outside the
    nearest surface is then another one, that looks the other way."""
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(open3d.core.Tensor(vertices.astype(np.float32)), open3d.core.Tensor(faces.astype(np.uint32)))
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]

    def nearest(places):
        found = scene.compute_closest_points(open3d.core.Tensor(places.astype(np.float32)))
        return found['points'].numpy(), normals[found['primitive_ids'].numpy()]

    on, looks = nearest(sys.modules['sample'].sample(vertices, faces, PLACES, 3))
    shares = []
    for side in (-1, 1):
        is_narrow = np.zeros(len(on), bool)
        for step in np.arange(0.125, 1.001, 0.125) * limit / 2:
            away = on + side * step * looks
            other, other_looks = nearest(away)
            distance = np.linalg.norm(other - away, axis=1)
            is_narrow |= ((distance < step * 0.99) & (step + distance < limit) &
                          (np.einsum('ij,ij->i', other_looks, looks) < -0.5))
        shares.append(is_narrow.mean())
    return max(shares)


def resolvable_parts(first, count, points):
    """(seed, vertices, faces) of the first `count` parts without narrow walls or gaps."""
    seed = first
    while count > 0:
        vertices, faces = part(seed)
        pixel = PIXEL_PER_SPACING * math.sqrt(shapes.areas(vertices, faces).sum() / points)
        if narrow_share(vertices, faces, NARROW * pixel) < NARROW_SHARE:
            count -= 1
            yield seed, vertices, faces
        seed += 1


def judged(seed, vertices, faces, args):
    """(what the part is, what is wrong with its mesh)"""
    points = sys.modules['sample'].sample(vertices, faces, args.points, seed)
    if args.noise:
        points = points + np.random.default_rng(seed).normal(0, args.noise, points.shape)
    truth = sys.modules['mesh_quality'].topology(vertices, faces)[0]
    body = truth['components'], (2 * truth['components'] - truth['euler']) // 2
    return body, seeds.faults(body, seeds.meshed(os.path.join(args.out, 'part_%d' % seed), points, args))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', default=os.path.join(run.ROOT, 'build/release/apps/rangezip/rangezip'))
    parser.add_argument('--shared', default=boundary_check.DEFAULT_SHARED)
    parser.add_argument('--out', default=os.path.join(run.ROOT, 'build/quality/parts'))
    parser.add_argument('--first', type=int, default=1, help='seed')
    parser.add_argument('--parts', type=int, default=40)
    parser.add_argument('--points', type=int, default=100_000)
    parser.add_argument('--noise', type=float, default=0.0, help='standard deviation, of the diagonal')
    parser.add_argument('--jobs', type=int, default=os.cpu_count(), help='meshed at a time')
    args = parser.parse_args()
    if not seeds.are_there(args, 'parts.py'):
        return 2
    os.makedirs(args.out, exist_ok=True)
    run.load_judge(args.shared)
    print('| part | components, genus | wrong |')
    print('|---|---|---|')
    right = 0
    with ThreadPoolExecutor(args.jobs) as pool:
        parts = list(resolvable_parts(args.first, args.parts, args.points))
        for (seed, _, _), (body, wrong) in zip(parts, pool.map(lambda one: judged(*one, args), parts)):
            print('| %d | %d, %d | %s |' % (seed, *body, ', '.join(wrong)), flush=True)
            right += not wrong
    print('\n%d of %d right' % (right, args.parts))
    return 0 if right == args.parts else 1


if __name__ == '__main__':
    sys.exit(main())
