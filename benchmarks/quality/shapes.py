"""Bodies whose right answer is known: a truth as triangles, and a cloud drawn from it by seed.

Lengths are in h, the pixel side that `rangezip mesh` chooses for the cloud: a body takes as many
points as make it so (points_for()). Every truth is turned by the same odd rotation, so that nothing
lies along an axis. Closed truths are watertight and look outward.
"""
from dataclasses import dataclass

import numpy as np

# What core/plan/spacing.cpp makes of random points: pixel sides per mean spacing, for bodies under
# and over 250 pixels across, and the 75 % quantile's share in it.
PIXELS_PER_SPACING = 1.3
PIXELS_PER_SPACING_LARGE = 2.2
QUANTILE = 1.03
PIXELS_ACROSS = 250.0


@dataclass
class Shape:
    vertices: np.ndarray
    faces: np.ndarray
    points: np.ndarray
    genus: int = 0
    dense_side: np.ndarray = None   # normal of the plane through the origin before which points are 16:1 denser

    @property
    def diagonal(self):
        return np.linalg.norm(np.ptp(self.vertices, axis=0))


# ---------------------------------------------------------------- truths

def revolved(radius, height, closed, segments=400):
    """A surface of revolution about z; where the profile's radius is 0 it becomes one vertex."""
    angle = 2 * np.pi * np.arange(segments) / segments
    ring = np.c_[np.cos(angle), np.sin(angle)]
    rows, vertices = [], []
    for r, z in zip(radius, height):
        count = sum(len(v) for v in vertices)
        rows.append(np.full(segments, count) if r == 0 else count + np.arange(segments))
        vertices.append(np.array([[0, 0, z]]) if r == 0 else np.c_[r * ring, np.full(segments, z)])
    faces = []
    for i in range(len(rows) if closed else len(rows) - 1):
        a, d = rows[i], rows[(i + 1) % len(rows)]
        b, c = np.roll(a, -1), np.roll(d, -1)
        faces += [np.c_[a, b, c], np.c_[a, c, d]]
    return np.concatenate(vertices), without_collapsed(np.concatenate(faces))


def bell(waist=43.0, rim=84.0, height=78.0, steps=200):
    """A bell with a waist, closed above and open below: its upper half shows from outside, its lower one from inside."""
    z = np.linspace(0, height, steps)
    radius = waist + (rim - waist) * (2 * z / height - 1) ** 2
    top = np.linspace(rim, 0, steps)[1:]
    return revolved(np.r_[radius, top], np.r_[z, np.full(len(top), height)], closed=False)


def vase(thickness, height=110.0, steps=150):
    """A vase with a wall of one thickness, open above: its inside is seen through the mouth only."""
    z = np.linspace(0, height, steps)
    outer = 42 + 10 * np.sin(z / 22)
    inside = z[z > thickness][::-1]
    inner = 42 + 10 * np.sin(inside / 22) - thickness
    return revolved(np.r_[0, outer, inner, 0], np.r_[0, z, inside, inside[-1]], closed=False)


def without_collapsed(faces):
    return faces[(faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])]


def arc(radius, start, end, steps):
    """Radius and height of a circle's points; angles from the -z axis."""
    angle = np.linspace(start, end, steps + 1)
    across = radius * np.sin(angle)
    across[np.abs(across) < 1e-9 * radius] = 0
    return across, -radius * np.cos(angle)


def sphere(radius):
    return revolved(*arc(radius, 0, np.pi, 200), closed=False)


def bumpy_sphere(radius, height, waves):
    """A sphere with smooth waves of that height: detail that a coarse mesh loses."""
    vertices, faces = revolved(*arc(radius, 0, np.pi, 600), closed=False, segments=1200)
    direction = vertices / radius
    wave = np.prod(np.sin(waves * direction + [0.3, 1.1, 2.3]), axis=1)
    return vertices * (1 + height / radius * wave)[:, None], faces


def torus(large, small):
    angle = 2 * np.pi * np.arange(200) / 200
    return revolved(large + small * np.sin(angle), -small * np.cos(angle), closed=True)


def shell(radius, thickness):
    """Half of a sphere of that thickness, with a flat rim."""
    outer, inner = arc(radius, np.pi / 2, np.pi, 100), arc(radius - thickness, np.pi, np.pi / 2, 100)
    return revolved(np.r_[outer[0], inner[0]], np.r_[outer[1], inner[1]], closed=True)


def trefoil(scale, radius, around=1200, across=120):
    """A tube along a trefoil knot."""
    t = 2 * np.pi * np.arange(around) / around
    curve = scale * np.c_[np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)]
    tangent = np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    # The curve never runs along z, so this frame closes.
    side = np.cross(tangent, [0, 0, 1.0])
    side /= np.linalg.norm(side, axis=1)[:, None]
    up = np.cross(side, tangent)
    s = 2 * np.pi * np.arange(across) / across
    offset = np.cos(s)[None, :, None] * side[:, None] + np.sin(s)[None, :, None] * up[:, None]
    vertices = (curve[:, None] + radius * offset).reshape(-1, 3)
    index = np.arange(around * across).reshape(around, across)
    a, b = index, np.roll(index, -1, axis=0)
    c, d = np.roll(b, -1, axis=1), np.roll(a, -1, axis=1)
    return vertices, np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]).reshape(-1, 3)


def lens(radius, degrees):
    """Two caps of spheres that meet in a sharp rim of that angle."""
    half = np.radians(degrees / 2)
    across, height = arc(radius / np.sin(half), 0, half, 100)
    height = height - height[-1]    # a cap below the plane of the rim
    return revolved(np.r_[across, across[-2::-1]], np.r_[height, -height[-2::-1]], closed=False)


def star(radius, degrees, tips=5, height=60.0):
    """A prism over a star whose tips have that angle."""
    part, half = np.pi / tips, np.radians(degrees / 2)
    inner = radius * np.tan(half) / (np.sin(part) + np.tan(half) * np.cos(part))
    angle = part * np.arange(2 * tips)
    reach = np.where(np.arange(2 * tips) % 2 == 0, radius, inner)
    outline = np.c_[reach * np.cos(angle), reach * np.sin(angle)]
    count = len(outline)
    rings = [np.c_[outline, np.full(count, z)] for z in (-height / 2, height / 2)]
    vertices = np.concatenate(rings + [[[0, 0, -height / 2], [0, 0, height / 2]]])
    a = np.arange(count)
    b = (a + 1) % count
    low, high = np.full(count, 2 * count), np.full(count, 2 * count + 1)
    return vertices, np.concatenate([np.c_[a, b, b + count], np.c_[a, b + count, a + count],
                                     np.c_[b, a, low], np.c_[a + count, b + count, high]])


class Blocks:
    """A union of boxes, as the faces between full and empty cells of a grid with the boxes' planes.

    Boxes must not touch along an edge or in a corner only."""

    def __init__(self):
        self.boxes = []

    def add(self, low, high):
        self.boxes.append((np.asarray(low, float), np.asarray(high, float), True))
        return self

    def cut(self, low, high):
        self.boxes.append((np.asarray(low, float), np.asarray(high, float), False))
        return self

    def surface(self):
        planes = [np.unique(np.round([end[axis] for box in self.boxes for end in box[:2]], 9)) for axis in range(3)]
        full = np.zeros([len(p) + 1 for p in planes], bool)     # with an empty cell around
        for low, high, solid in self.boxes:
            begin = [np.searchsorted(p, np.round(x, 9)) + 1 for p, x in zip(planes, low)]
            end = [np.searchsorted(p, np.round(x, 9)) + 1 for p, x in zip(planes, high)]
            full[begin[0]:end[0], begin[1]:end[1], begin[2]:end[2]] = solid
        quads = []
        for axis in range(3):
            u, v = np.eye(3, dtype=int)[(axis + 1) % 3], np.eye(3, dtype=int)[(axis + 2) % 3]
            step = np.diff(full.astype(int), axis=axis)
            for sign in (1, -1):        # the body begins, or ends, along the axis
                corner = np.argwhere(step == sign)
                corner[:, (axis + 1) % 3] -= 1
                corner[:, (axis + 2) % 3] -= 1
                quad = np.stack([corner, corner + u, corner + u + v, corner + v], axis=1)
                quads.append(quad[:, ::-1] if sign > 0 else quad)
        quads = np.concatenate(quads)
        places, index = np.unique(quads.reshape(-1, 3), axis=0, return_inverse=True)
        index = index.reshape(-1, 4)
        vertices = np.stack([planes[axis][places[:, axis]] for axis in range(3)], axis=1)
        return vertices, np.concatenate([index[:, [0, 1, 2]], index[:, [0, 2, 3]]])


def box(x, y, z):
    return Blocks().add([-x / 2, -y / 2, -z / 2], [x / 2, y / 2, z / 2]).surface()


def pocket(depth_by_width, width=24.0):
    """A block with a square pocket in its top."""
    depth = depth_by_width * width
    return (Blocks().add([-36, -36, -depth - 24], [36, 36, 0])
            .cut([-width / 2, -width / 2, -depth], [width / 2, width / 2, 0])).surface()


FINGER_SIZES = [1.0, 1.5, 2.0, 2.5, 3.0]
FINGER_WINDOWS = 5


def fingers_and_folds(length=233.0, width=48.0, height=5.0):
    """A slab with square fingers on its top and folds below; gaps as wide as what they part, by FINGER_SIZES.

    Windows through a fold of the last size, with as much above and below them as that, make the genus
    FINGER_WINDOWS. Long enough that the pixel is 2.2 spacings of the points; 400 K of them make it 1."""
    body = Blocks().add([0, 0, 0], [length, width, 6])
    strip = length / len(FINGER_SIZES)
    for i, size in enumerate(FINGER_SIZES):
        depth = height if size < FINGER_SIZES[-1] else 3 * size
        count = int((strip - size) / (2 * size))
        for k in range(count):
            x = i * strip + size + 2 * size * k
            body.add([x, 2, -depth], [x + size, width - 2, 0])
            for m in range(int((width - size) / (2 * size))):
                y = size + 2 * size * m
                body.add([x, y, 6], [x + size, y + size, 6 + height])
            if size == FINGER_SIZES[-1]:
                for window in range(FINGER_WINDOWS if k == count - 1 else 0):
                    y = width * (window + 1) / (FINGER_WINDOWS + 1)
                    body.cut([x, y, -2 * size], [x + size, y + 4, -size])
    return body.surface()


def joined(first, second):
    return np.r_[first[0], second[0]], np.r_[first[1], second[1] + len(first[0])]


# ---------------------------------------------------------------- clouds

def areas(vertices, faces):
    return np.linalg.norm(np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]],
                                   vertices[faces[:, 2]] - vertices[faces[:, 0]]), axis=1) / 2


def scattered(vertices, faces, count, rng, weight=None):
    """Random places on the faces, evenly or as `weight` says for each face, and the face of each."""
    share = np.cumsum(areas(vertices, faces) * (1 if weight is None else weight))
    chosen = np.minimum(np.searchsorted(share, rng.random(count) * share[-1], side='right'), len(faces) - 1)
    r1, r2 = np.sqrt(rng.random(count)), rng.random(count)
    a, b, c = (vertices[faces[chosen][:, i]] for i in range(3))
    return a * (1 - r1)[:, None] + b * (r1 * (1 - r2))[:, None] + c * (r1 * r2)[:, None], chosen


def sample(vertices, faces, count, seed, weight=None):
    """Points as those of scattered(), by seed."""
    return scattered(vertices, faces, count, np.random.Generator(np.random.PCG64(seed)), weight)[0]


def points_for(vertices, faces):
    """As many points as make the chosen pixel side 1."""
    across = np.linalg.norm(np.ptp(vertices @ turn().T, axis=0))
    per_spacing = QUANTILE * (PIXELS_PER_SPACING if across < PIXELS_ACROSS else PIXELS_PER_SPACING_LARGE)
    return int(areas(vertices, faces).sum() * per_spacing ** 2)


def turn():
    """A rotation along none of whose axes anything lies."""
    x, y, z, w = np.array([0.21, -0.34, 0.17, 0.9]) / np.linalg.norm([0.21, -0.34, 0.17, 0.9])
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def drawn(surface, seed, genus=0, noise=0.0, count=None):
    """A cloud over the whole surface; noise as a share of the diagonal."""
    vertices, faces = surface[0] @ turn().T, surface[1]
    points = sample(vertices, faces, count or points_for(*surface), seed)
    if noise:
        diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
        points = points + np.random.Generator(np.random.PCG64(seed + 1000)).normal(0, noise * diagonal, points.shape)
    return Shape(vertices, faces, points, genus)


def two_densities(surface, count, seed, ratio=16.0):
    """So many times as many points to the area where x > 0, before the turn."""
    vertices, faces = surface
    right = vertices[faces].mean(axis=1)[:, 0] > 0
    points = sample(vertices, faces, count, seed, np.where(right, ratio, 1.0))
    return Shape(vertices @ turn().T, faces, points @ turn().T, dense_side=turn()[:, 0])


def falling_density(surface, ratio, seed, genus=0):
    """The points of an even cloud, but from one side to the other of a density that falls by so much, evenly."""
    vertices, faces = surface
    vertices = vertices @ turn().T
    x = vertices[faces].mean(axis=1)[:, 0]
    weight = ratio ** ((x - x.min()) / np.ptp(x))
    return Shape(vertices, faces, sample(vertices, faces, points_for(vertices, faces), seed, weight), genus)


def contours(surface, step, along, seed, genus=0):
    """Points on level lines only, `step` apart, dense along them by `along`."""
    vertices, faces = surface
    height = vertices[faces][:, :, 2]
    points = []
    for level in np.arange(vertices[:, 2].min() + step / 2, vertices[:, 2].max(), step):
        crossing = (height.min(axis=1) < level) & (height.max(axis=1) > level)
        ends = []
        for i, k in ((0, 1), (1, 2), (2, 0)):
            a, b = vertices[faces[crossing][:, i]], vertices[faces[crossing][:, k]]
            with np.errstate(divide='ignore', invalid='ignore'):
                t = (level - a[:, 2]) / (b[:, 2] - a[:, 2])
            ends.append(np.where(((t >= 0) & (t < 1))[:, None], a + t[:, None] * (b - a), np.nan))
        ends = np.array(ends)
        found = ~np.isnan(ends[:, :, 0])
        order = np.argsort(~found, axis=0, kind='stable')[:2]
        pair = np.take_along_axis(ends, order[:, :, None], axis=0)
        length = np.linalg.norm(pair[1] - pair[0], axis=1)
        use = np.flatnonzero(np.isfinite(length) & (length > 0))
        total = np.cumsum(length[use])
        rng = np.random.Generator(np.random.PCG64(seed + len(points)))
        count = int(total[-1] / along)
        place = (np.arange(count) + rng.random(count)) * total[-1] / count
        segment = use[np.minimum(np.searchsorted(total, place, side='right'), len(use) - 1)]
        points.append(pair[0][segment] + rng.random(count)[:, None] * (pair[1] - pair[0])[segment])
    return Shape(vertices @ turn().T, faces, np.concatenate(points) @ turn().T, genus)


# ---------------------------------------------------------------- by name

def two_spheres(gap, radius=30.0):
    left, right = sphere(radius), sphere(radius)
    reach = radius + gap / 2
    return joined((left[0] - [reach, 0, 0], left[1]), (right[0] + [reach, 0, 0], right[1]))


def nested():
    """A hollow ball with a ring in it: no straight line from outside reaches the wall inside, nor the ring."""
    hollow = sphere(40)
    return joined(joined(sphere(60), (hollow[0], hollow[1][:, ::-1])), torus(18, 8))


def balls(diameters=(5, 6, 8, 12)):
    """Balls around a large one."""
    surface = sphere(50)
    for i, diameter in enumerate(diameters):
        angle = 2 * np.pi * i / len(diameters)
        ball = sphere(diameter / 2)
        surface = joined(surface, (ball[0] + 65 * np.array([np.cos(angle), np.sin(angle), 0]), ball[1]))
    return surface


def slabs(gap, side=30.0, thickness=6.0):
    """Two square slabs, one over the other."""
    half = side / 2
    return (Blocks().add([-half, -half, -thickness - gap / 2], [half, half, -gap / 2])
            .add([-half, -half, gap / 2], [half, half, thickness + gap / 2])).surface()


def bars(gap):
    """Two crossing bars, one over the other."""
    return (Blocks().add([-40, -5, -10 - gap / 2], [40, 5, -gap / 2])
            .add([-5, -40, gap / 2], [5, 40, 10 + gap / 2])).surface()


def slot(width, depth=30.0):
    """A block with a slot through its whole length."""
    return (Blocks().add([-36, -36, -60], [36, 36, 0]).cut([-width / 2, -36, -depth], [width / 2, 36, 0])).surface()


def cavity(neck, side=30.0, depth=30.0, lip=6.0):
    """A block with a cavity behind a square mouth."""
    return (Blocks().add([-36, -36, -60], [36, 36, 0])
            .cut([-side / 2, -side / 2, -lip - depth], [side / 2, side / 2, -lip])
            .cut([-neck / 2, -neck / 2, -lip], [neck / 2, neck / 2, 0])).surface()


DRILLED = 9


def drilled(width, thickness=8.0):
    """A plate with square holes that lead through."""
    plate = Blocks().add([-60, -60, 0], [60, 60, thickness])
    for x in (-36, 0, 36):
        for y in (-36, 0, 36):
            plate.cut([x - width / 2, y - width / 2, 0], [x + width / 2, y + width / 2, thickness])
    return plate.surface()


def perforated(width, side=160.0, step=0.25):
    """A wavy sheet with nine round holes: an open surface."""
    count = int(side / step) + 1
    x, y = np.meshgrid(np.linspace(-side / 2, side / 2, count), np.linspace(-side / 2, side / 2, count), indexing='ij')
    vertices = np.c_[x.ravel(), y.ravel(), (4 * np.sin(x / 20) * np.cos(y / 16)).ravel()]
    index = np.arange(count * count).reshape(count, count)
    a, b, c, d = (index[s, t].ravel() for s, t in ((slice(-1), slice(-1)), (slice(1, None), slice(-1)),
                                                   (slice(1, None), slice(1, None)), (slice(-1), slice(1, None))))
    faces = np.concatenate([np.c_[a, b, c], np.c_[a, c, d]])
    middle = vertices[faces][:, :, :2].mean(axis=1)
    for center in [(u, v) for u in (-45, 0, 45) for v in (-45, 0, 45)]:
        keep = np.linalg.norm(middle - center, axis=1) > width / 2
        faces, middle = faces[keep], middle[keep]
    used, faces = np.unique(faces, return_inverse=True)
    return vertices[used], faces.reshape(-1, 3)


def make(name, seed=None):
    """The shape of that name, or of `name value`; its cloud is drawn by the seed, or by one of its own."""
    def cloud(surface, own_seed, **options):
        return drawn(surface, own_seed if seed is None else seed, **options)

    kind, _, value = name.partition(' ')
    size = float(value) if value else 0.0
    makers = {
        'sphere': lambda: cloud(sphere(60), 1),
        'torus': lambda: cloud(torus(50, 20), 2, genus=1),
        'trefoil': lambda: cloud(trefoil(24, 9), 3, genus=1),
        'bell': lambda: cloud(bell(), 23, noise=size / 100),
        'bowl': lambda: cloud(revolved(*arc(60, np.pi / 2, np.pi, 100), closed=False), 4, noise=size / 100),
        'pipe': lambda: cloud(revolved(np.full(100, 60.0), np.linspace(0, 60, 100), closed=False), 25, noise=size / 100),
        'plate': lambda: cloud(box(100, 80, size), 5),
        'shell': lambda: cloud(shell(50, size), 6),
        'cube': lambda: cloud(box(80, 80, 80), 7),
        'pocket': lambda: cloud(pocket(size), 8),
        'spheres': lambda: cloud(two_spheres(size), 9),
        'slabs': lambda: cloud(slabs(size), 15),
        'bars': lambda: cloud(bars(size), 16),
        'slot': lambda: cloud(slot(size), 17),
        'cavity': lambda: cloud(cavity(size), 18),
        'drilled': lambda: cloud(drilled(size), 19, genus=DRILLED),
        'perforated': lambda: cloud(perforated(size), 20),
        'lens': lambda: cloud(lens(60, size), 21),
        'star': lambda: cloud(star(60, size), 22),
        'noisy': lambda: cloud(torus(50, 20), 10, genus=1, noise=size / 100),
        'contours': lambda: contours(torus(50, 20), 3.0, 0.5, 11, genus=1),
        'density': lambda: two_densities(box(100, 100, 100), 200_000, 12),
        'density-bumps': lambda: two_densities(bumpy_sphere(60, 6, 6), 200_000, 13),
        'vase': lambda: falling_density(vase(size), 10.0, 26 if seed is None else seed),
        'nested': lambda: cloud(nested(), 27, genus=1),
        'balls': lambda: cloud(balls(), 28),
        'scans': lambda: two_densities(bumpy_sphere(60, 6, 6), 300_000, 29, size ** 2),
        'fingers': lambda: cloud(fingers_and_folds(), 14, genus=FINGER_WINDOWS, count=400_000),
    }
    return makers[kind]()


NAMES = (['sphere', 'torus', 'trefoil'] + [f'{thing}{noise}' for thing in ('bell', 'bowl', 'pipe') for noise in ('', ' 0.1')] +
         ['plate %g' % t for t in (0.3, 0.9, 2, 3, 5)] +
         ['shell %g' % t for t in (0.3, 0.9, 2, 3, 5)] + ['cube'] + ['pocket %g' % d for d in (0.5, 1, 2)] +
         ['spheres %g' % g for g in (0, 0.3, 0.8, 2, 3)] +
         [f'{two} {gap}' for two in ('slabs', 'bars') for gap in (2, 3, 4)] +
         [f'{deep} {width}' for deep in ('slot', 'cavity', 'drilled') for width in (2, 3, 6)] +
         [f'perforated {width}' for width in (6, 8, 16)] +
         [f'{sharp} {angle}' for sharp in ('lens', 'star') for angle in (15, 25, 40)] +
         ['noisy %g' % n for n in (0.05, 0.1, 0.2)] +
         ['contours', 'density', 'density-bumps', 'vase 4', 'vase 6', 'nested', 'balls', 'scans 10', 'fingers'])
