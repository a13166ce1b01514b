#!/usr/bin/python3
"""Meshes a cloud by Open3D, for comparison only: open3d_peer.py poisson|bpa|alpha IN.xyz OUT.ply

Parameters as in ../shared/eval/peers.md.
"""
import sys

import numpy as np
import open3d

NORMAL_NEIGHBOURS = 30
ORIENTATION_NEIGHBOURS = 15
POISSON_DEPTHS = [(200_000, 8), (1_000_000, 9), (3_000_000, 10)]


def with_normals(cloud):
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(NORMAL_NEIGHBOURS))
    cloud.orient_normals_consistent_tangent_plane(ORIENTATION_NEIGHBOURS)
    # The sign of the whole is not fixed by that: away from the middle on average.
    points, normals = np.asarray(cloud.points), np.asarray(cloud.normals)
    if np.einsum('ij,ij->i', points - points.mean(axis=0), normals).mean() < 0:
        cloud.normals = open3d.utility.Vector3dVector(-normals)
    return cloud


def main():
    method, source, target = sys.argv[1:]
    points = np.loadtxt(source)
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    if method == 'alpha':
        spacing = np.mean(cloud.compute_nearest_neighbor_distance())
        mesh = open3d.geometry.TriangleMesh.create_from_point_cloud_alpha_shape(cloud, 3 * spacing)
    elif method == 'bpa':
        spacing = np.mean(cloud.compute_nearest_neighbor_distance())
        radii = open3d.utility.DoubleVector([spacing, 2 * spacing, 4 * spacing])
        mesh = open3d.geometry.TriangleMesh.create_from_point_cloud_ball_pivoting(with_normals(cloud), radii)
    else:
        depth = next((depth for count, depth in POISSON_DEPTHS if len(points) <= count), 11)
        mesh, _ = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(with_normals(cloud), depth=depth)
    if not open3d.io.write_triangle_mesh(target, mesh):
        raise OSError('cannot write ' + target)


if __name__ == '__main__':
    main()
