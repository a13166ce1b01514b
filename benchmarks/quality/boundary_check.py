#!/usr/bin/python3
"""Judges the boundary of a mesh by the cloud that it was made from; prints one JSON line.

    boundary_check.py MESH CLOUD --h H [--shared DIR]

A boundary edge is right where the data ends. It is wrong where the cloud goes on: a cloud point
whose nearest point of the mesh lies on a boundary edge, and which lies beyond that edge, outward in
the plane of its face, by at most H (the side of a pixel).

loops, long_loops           all boundary loops; those longer than 10 H
points_beyond               cloud points beyond a boundary edge by more than a thousandth of H
points_beyond_quarter, _half  by more than H/4, H/2
worst                       the farthest such point, in H
"""
import argparse
import json
import os
import sys

import numpy as np
import open3d
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

HERE = os.path.dirname(os.path.abspath(__file__))
DEFAULT_SHARED = os.environ.get('RANGEZIP_SHARED', os.path.join(HERE, '../../../shared'))
LONG_LOOP = 10.0        # pixel sides
NEGLIGIBLE = 1e-3       # pixel sides: the nearest point is found in single precision


def boundary_edges(faces, vertex_count):
    """Start, end and face of each edge that has no face on its other side."""
    start, end = faces[:, [0, 1, 2]].ravel(), faces[:, [1, 2, 0]].ravel()
    key, opposite = start * np.int64(vertex_count) + end, end * np.int64(vertex_count) + start
    alone = ~np.isin(key, opposite)
    return start[alone], end[alone], np.flatnonzero(alone) // 3


def loop_lengths(vertices, start, end):
    if not len(start):
        return np.zeros(0)
    used, index = np.unique(np.r_[start, end], return_inverse=True)
    links = sparse.coo_matrix((np.ones(len(start)), (index[:len(start)], index[len(start):])),
                              shape=(len(used), len(used)))
    count, label = connected_components(links, directed=False)
    return np.bincount(label[index[:len(start)]], minlength=count,
                       weights=np.linalg.norm(vertices[end] - vertices[start], axis=1))


def nearest_on_mesh(vertices, faces, points):
    """Distance to the mesh per point, in chunks to bound the memory."""
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(open3d.core.Tensor(vertices.astype(np.float32)),
                        open3d.core.Tensor(faces.astype(np.uint32)))
    distances = [np.zeros(0)]
    for begin in range(0, len(points), 200000):
        query = open3d.core.Tensor(points[begin:begin + 200000].astype(np.float32))
        distances.append(scene.compute_distance(query).numpy())
    return np.concatenate(distances)


def beyond(vertices, faces, edges, points, h):
    """Per cloud point, how far it lies beyond a boundary edge that is its nearest place of the mesh."""
    start, end, face = edges
    a, b = vertices[start], vertices[end]
    along = b - a
    length = np.linalg.norm(along, axis=1)
    corners = vertices[faces[face]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outward = np.cross(along, normal)
    outward /= np.maximum(np.linalg.norm(outward, axis=1), 1e-300)[:, None]

    nearest = nearest_on_mesh(vertices, faces, points)
    candidates = np.flatnonzero((nearest > NEGLIGIBLE * h) & (nearest <= h))
    # Edges near a candidate: sample each edge at most h / 2 apart and ask for all within 1.3 h.
    steps = np.maximum(1, np.ceil(length / (0.5 * h)).astype(int)) + 1
    owner = np.repeat(np.arange(len(a)), steps)
    share = np.concatenate([np.linspace(0, 1, n) for n in steps])
    tree = cKDTree(a[owner] + share[:, None] * along[owner])
    result = np.zeros(len(points))
    for i, found in zip(candidates, tree.query_ball_point(points[candidates], 1.3 * h)):
        edge = np.unique(owner[found])
        if not len(edge):
            continue
        t = np.einsum('ij,ij->i', points[i] - a[edge], along[edge]) / length[edge] ** 2
        foot = a[edge] + np.clip(t, 0, 1)[:, None] * along[edge]
        offset = points[i] - foot
        distance = np.linalg.norm(offset, axis=1)
        on_edge = distance <= nearest[i] + NEGLIGIBLE * h
        over = np.einsum('ij,ij->i', offset, outward[edge])
        # Above the sheet beside an edge is not beyond it; at a corner, beyond one edge is enough.
        if on_edge.any():
            result[i] = max(0.0, over[on_edge].max())
    return result


def check(vertices, faces, cloud, h):
    center = vertices.mean(axis=0)
    scale = 1.0 / np.ptp(vertices, axis=0).max()    # single precision is relative to the unit box
    vertices, cloud, h = (vertices - center) * scale, (cloud - center) * scale, h * scale
    edges = boundary_edges(faces, len(vertices))
    lengths = loop_lengths(vertices, edges[0], edges[1])
    over = beyond(vertices, faces, edges, cloud, h) / h if len(lengths) and len(cloud) else np.zeros(1)
    return {'loops': len(lengths), 'long_loops': int((lengths > LONG_LOOP * h).sum()),
            'points_beyond': int((over > NEGLIGIBLE).sum()),
            'points_beyond_quarter': int((over > 0.25).sum()),
            'points_beyond_half': int((over > 0.5).sum()), 'worst': float(over.max())}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('mesh')
    parser.add_argument('cloud')
    parser.add_argument('--h', type=float, required=True, help='side of a pixel, model units')
    parser.add_argument('--shared', default=DEFAULT_SHARED)
    args = parser.parse_args()
    sys.path.insert(0, os.path.join(args.shared, 'eval'))
    import mesh_quality
    vertices, faces = mesh_quality.read_any(args.mesh)
    cloud, _ = mesh_quality.read_any(args.cloud)
    print(json.dumps(check(vertices, faces, cloud, args.h)))


if __name__ == '__main__':
    main()
