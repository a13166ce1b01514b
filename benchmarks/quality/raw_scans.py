"""Range scans of a body as a scanner on a turntable gives them, merged into one cloud.

Each scan is a grid of depths as a camera sees it. What its light, beside the camera, does not reach is missing, and so are
places that look away. Depths have noise, pixels at edges may lie between front and back, and every scan is a little out of its
place, as registration leaves it. So layers of several scans lie over each other, some 0.1 % of the diagonal apart, and what
no scan has seen is missing.
"""
from dataclasses import dataclass

import numpy as np

import shapes


@dataclass
class Scanner:
    scans: int = 20
    pixels: int = 330           # along the diagonal of the body
    light_angle: float = 20.0   # degrees, between camera and light
    steepest: float = 75.0      # degrees: places turned away more give no depth
    noise: float = 0.0003       # of the diagonal, in depth
    flying: float = 0.1         # of the pixels at an edge: between front and back
    shift: float = 0.0003       # of the diagonal: registration, standard deviation along each axis
    turn: float = 0.04          # degrees: the same of rotations


SAMPLES_PER_PIXEL = 12
JUMP = 3.0  # pixels: a larger step in depth is an edge


def merged_scans(vertices, faces, scanner, seed):
    """The points of all scans, for a body with a diagonal of 1."""
    rng = np.random.Generator(np.random.PCG64(seed))
    places, normals = surface_samples(vertices, faces, samples_needed(vertices, faces, scanner), rng)
    clouds = [one_scan(places, normals, view, scanner, rng) for view in views(scanner)]
    return np.concatenate(clouds)


def samples_needed(vertices, faces, scanner):
    return int(shapes.areas(vertices, faces).sum() * scanner.pixels ** 2 * SAMPLES_PER_PIXEL)


def surface_samples(vertices, faces, count, rng):
    """Uniform random places and their unit normals."""
    places, chosen = shapes.scattered(vertices, faces, count, rng)
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    cross = np.cross(b - a, c - a)
    normals = cross / np.maximum(np.linalg.norm(cross, axis=1), 1e-30)[:, None]
    return places, normals[chosen]


def views(scanner):
    """Azimuth and elevation in degrees: three quarters on a turntable, the others from higher and lower."""
    around = scanner.scans * 3 // 4
    others = scanner.scans - around
    return ([(360.0 * i / around, 12.0) for i in range(around)] +
            [(360.0 * i / others + 20.0, 55.0 if i % 2 else -45.0) for i in range(others)])


def camera(azimuth, elevation):
    """Rows: right, up, and towards the camera."""
    a, e = np.radians(azimuth), np.radians(elevation)
    towards = np.array([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)])
    right = np.array([np.cos(a), 0.0, -np.sin(a)])
    return np.array([right, np.cross(towards, right), towards])


def nearest_of_pixels(places, frame, pixels):
    """For each pixel of the image its nearest sample, and the pixel of each sample; depth grows towards the camera."""
    seen = places @ frame.T
    cells = np.floor((seen[:, :2] + 1.0) * pixels).astype(np.int64)
    pixel = cells[:, 1] * (2 * pixels) + cells[:, 0]
    order = np.lexsort((-seen[:, 2], pixel))
    first = np.r_[True, np.diff(pixel[order]) != 0]
    return order[first], pixel, seen[:, 2]


def is_lit(places, frame, pixels):
    """Whether nothing lies between a sample and the light."""
    nearest, pixel, depth = nearest_of_pixels(places, frame, pixels)
    limit = np.full(4 * pixels * pixels, -np.inf)
    limit[pixel[nearest]] = depth[nearest]
    return depth >= limit[pixel] - 2.0 / pixels


def one_scan(places, normals, view, scanner, rng):
    frame = camera(*view)
    light = camera(view[0] + scanner.light_angle, view[1])
    nearest, pixel, _ = nearest_of_pixels(places, frame, scanner.pixels)
    image = np.full(4 * scanner.pixels ** 2, np.nan)
    seen = places[nearest] @ frame.T
    image[pixel[nearest]] = seen[:, 2]
    steepest = np.cos(np.radians(scanner.steepest))
    kept = is_lit(places, light, scanner.pixels)[nearest]
    kept &= (normals[nearest] @ frame[2] > steepest) & (normals[nearest] @ light[2] > steepest)
    depth = seen[:, 2] + rng.normal(0, scanner.noise, len(seen))
    behind = image[np.minimum(pixel[nearest] + 1, len(image) - 1)]
    is_edge = np.abs(behind - seen[:, 2]) > JUMP / scanner.pixels
    flies = is_edge & (rng.random(len(seen)) < scanner.flying)
    depth[flies] += rng.random(flies.sum()) * (behind[flies] - depth[flies])
    points = np.c_[seen[:, :2], depth][kept] @ frame
    return misplaced(points, scanner, rng)


def misplaced(points, scanner, rng):
    """As registration leaves a scan: turned about its middle and shifted a little."""
    x, y, z = rng.normal(0, np.radians(scanner.turn), 3)
    turn = np.eye(3) + np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])  # of small angles
    middle = points.mean(0)
    return (points - middle) @ turn.T + middle + rng.normal(0, scanner.shift, 3)
