"""Files of types that the program does not read, as points or triangles: LAS and PCD clouds, STEP and IGES models.

LAS is read here; PCD by Open3D, STEP and IGES by Gmsh (Debian packages python3-open3d and python3-gmsh).
"""
import contextlib
import gzip
import os
import struct
import sys

import numpy as np

SIDES_PER_TURN = 60       # of a CAD model's triangles, along a full circle
LONGEST_SIDE = 1.0 / 100  # of the diagonal


def points_of(path):
    """The points of a .las, .las.gz or .pcd file, float64; those of a depth image may be NaN."""
    return points_of_pcd(path) if path.endswith('.pcd') else points_of_las(path)


def points_of_las(path):
    """[ASPRS, LAS specification 1.2]: header, then records that begin with three 32-bit integers."""
    with (gzip.open if path.endswith('.gz') else open)(path, 'rb') as file:
        data = file.read()
    if data[:4] != b'LASF':
        raise ValueError(path + ' does not begin with LASF')
    first, = struct.unpack_from('<I', data, 96)
    length, count = struct.unpack_from('<HI', data, 105)
    scale = np.array(struct.unpack_from('<3d', data, 131))
    offset = np.array(struct.unpack_from('<3d', data, 155))
    records = np.frombuffer(data, np.uint8, count * length, first).reshape(count, length)
    return records[:, :12].copy().view('<i4') * scale + offset


def points_of_pcd(path):
    import open3d
    return np.asarray(open3d.io.read_point_cloud(path).points)


def write_points(path, points):
    """PLY with double coordinates: maps lie far from their origin."""
    head = 'ply\nformat binary_little_endian 1.0\nelement vertex %d\n' % len(points)
    head += ''.join('property double %s\n' % axis for axis in 'xyz') + 'end_header\n'
    with open(path, 'wb') as out:
        out.write(head.encode())
        out.write(np.ascontiguousarray(points, dtype='<f8').tobytes())


@contextlib.contextmanager
def output_to_errors():
    """What libraries print, such as OpenCASCADE's readers, is no part of the table."""
    sys.stdout.flush()
    output = os.dup(1)
    os.dup2(2, 1)
    try:
        yield
    finally:
        os.dup2(output, 1)
        os.close(output)


def mesh_of_cad(path):
    """The vertices and triangles of all faces, so small that they follow what is curved."""
    with output_to_errors():
        return triangulated(path)


def triangulated(path):
    import gmsh
    gmsh.initialize()
    try:
        gmsh.option.setNumber('General.Terminal', 0)
        gmsh.model.occ.importShapes(path)
        gmsh.model.occ.synchronize()
        box = np.array(gmsh.model.getBoundingBox(-1, -1))
        gmsh.option.setNumber('Mesh.MeshSizeFromCurvature', SIDES_PER_TURN)
        gmsh.option.setNumber('Mesh.MeshSizeMax', LONGEST_SIDE * np.linalg.norm(box[3:] - box[:3]))
        gmsh.model.mesh.generate(2)
        tags, places, _ = gmsh.model.mesh.getNodes()
        index = np.zeros(int(tags.max()) + 1, np.int64)
        index[tags.astype(np.int64)] = np.arange(len(tags))
        _, faces = gmsh.model.mesh.getElementsByType(2)  # triangles
        return places.reshape(-1, 3), index[faces.astype(np.int64)].reshape(-1, 3)
    finally:
        gmsh.finalize()
