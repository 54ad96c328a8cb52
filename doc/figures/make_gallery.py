#!/usr/bin/env python3
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of the first screen of the manual, one for each kind of map.

    doc/figures/make_gallery.py PROGRAMS MESHES [NAME...]

PROGRAMS is the folder of the compiled examples, MESHES that of CGAL's meshes; with names, only these
pictures are drawn. Each goes to doc/Conformal_equivalence/fig/gallery_NAME.png: the surface with the pattern
that the map gives it on the left, the image of the map on the right. What is drawn was computed by the
program flatten_mesh (charts: by the example of that name) and is read from the OBJ files that it writes.
Python's own library suffices.
"""

import math
import os
import struct
import subprocess
import sys
import tempfile
import zlib

WIDTH, HEIGHT = 240, 250   # of one half of a picture
SAMPLES = 2                # across each pixel, in both directions
BLUE, CREAM, ORANGE, RED, GREY = (62, 96, 148), (246, 240, 224), (226, 120, 20), (190, 20, 30), (90, 90, 90)


# ------------------------------------------------------------------ meshes ----

class Surface:
    """Vertices, texture coordinates (u, v, w), and triangles of corners (vertex, texture vertex)."""

    def __init__(self, path):
        self.points, self.uv, self.triangles = [], [], []
        with open(path) as file:
            for line in file:
                words = line.split()
                if not words:
                    continue
                if words[0] == 'v':
                    self.points.append(tuple(map(float, words[1:4])))
                elif words[0] == 'vt':
                    u = list(map(float, words[1:]))
                    w = u[2] if len(u) > 2 else 1.
                    self.uv.append((u[0], u[1], w))
                elif words[0] == 'f':
                    corners = []
                    for word in words[1:]:
                        ids = word.split('/')
                        t = int(ids[1]) - 1 if len(ids) > 1 and ids[1] else None
                        corners.append((int(ids[0]) - 1, t))
                    for i in range(1, len(corners) - 1):
                        self.triangles.append((corners[0], corners[i], corners[i + 1]))

    def seams(self):
        """Pairs of texture vertices: sides of edges of which the two sides lie apart in the layout."""
        sides = {}
        for t in self.triangles:
            for (a, s), (b, e) in zip(t, t[1:] + t[:1]):
                sides[a, b] = (s, e)
        return [side for (a, b), side in sides.items()
                if (b, a) in sides and sides[b, a] != (side[1], side[0])]

    def seam_edges(self):
        """The same edges on the surface, as pairs of vertices."""
        sides = {}
        for t in self.triangles:
            for (a, s), (b, e) in zip(t, t[1:] + t[:1]):
                sides[a, b] = (s, e)
        return [(a, b) for (a, b), side in sides.items()
                if a < b and (b, a) in sides and sides[b, a] != (side[1], side[0])]


def read_off(path):
    """Points and triangles (of vertices) of a file of triangles."""
    with open(path) as file:
        words = [w for line in file for w in line.split('#')[0].split()]
    surface, at = Surface.__new__(Surface), 4
    surface.points, surface.uv, surface.triangles = [], [], []
    for _ in range(int(words[1])):
        surface.points.append(tuple(map(float, words[at:at + 3])))
        at += 3
    for _ in range(int(words[2])):
        surface.triangles.append(tuple(map(int, words[at + 1:at + 4])))
        at += 1 + int(words[at])
    return surface


def rotation(yaw, pitch, roll):
    """The matrix that turns about the axes y, x and z, in this order, by degrees."""
    def about(axis, degrees):
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        i, j = [(1, 2), (2, 0), (0, 1)][axis]
        m = [[float(r == k) for k in range(3)] for r in range(3)]
        m[i][i], m[i][j], m[j][i], m[j][j] = c, -s, s, c
        return m

    def times(a, b):
        return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    return times(about(2, roll), times(about(0, pitch), about(1, yaw)))


# ------------------------------------------------------------------ canvas ----

class Canvas:
    def __init__(self, width, height):
        self.width, self.height = width * SAMPLES, height * SAMPLES
        self.color = [(255, 255, 255)] * (self.width * self.height)
        self.depth = [-1e300] * (self.width * self.height)

    def triangle(self, p, attributes, shade):
        """Fills the triangle of the points (x, y, z); shade gets the interpolated attributes."""
        (x0, y0, z0), (x1, y1, z1), (x2, y2, z2) = p
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        if area == 0:
            return
        a0, a1, a2 = attributes
        for j in range(max(0, math.ceil(min(y0, y1, y2))), min(self.height - 1, math.floor(max(y0, y1, y2))) + 1):
            for i in range(max(0, math.ceil(min(x0, x1, x2))), min(self.width - 1, math.floor(max(x0, x1, x2))) + 1):
                b1 = ((i - x0) * (y2 - y0) - (x2 - x0) * (j - y0)) / area
                b2 = ((x1 - x0) * (j - y0) - (i - x0) * (y1 - y0)) / area
                b0 = 1 - b1 - b2
                if b0 < -1e-9 or b1 < -1e-9 or b2 < -1e-9:
                    continue
                z, k = b0 * z0 + b1 * z1 + b2 * z2, j * self.width + i
                if z > self.depth[k]:
                    self.depth[k] = z
                    self.color[k] = shade([b0 * r + b1 * s + b2 * t for r, s, t in zip(a0, a1, a2)])

    def line(self, p, q, color, radius, lift=0.):
        steps = int(max(abs(q[0] - p[0]), abs(q[1] - p[1]))) + 1
        for k in range(steps + 1):
            t = k / steps
            self.dot([p[i] + t * (q[i] - p[i]) for i in range(3)], color, radius, lift)

    def dot(self, p, color, radius, lift=0.):
        for j in range(max(0, math.ceil(p[1] - radius)), min(self.height - 1, math.floor(p[1] + radius)) + 1):
            for i in range(max(0, math.ceil(p[0] - radius)), min(self.width - 1, math.floor(p[0] + radius)) + 1):
                if (i - p[0]) ** 2 + (j - p[1]) ** 2 <= radius * radius:
                    k = j * self.width + i
                    if p[2] + lift >= self.depth[k]:
                        self.color[k] = color

    def pixels(self):
        """Rows of pixels, each the mean of its samples."""
        rows = []
        for j in range(0, self.height, SAMPLES):
            row = []
            for i in range(0, self.width, SAMPLES):
                samples = [self.color[(j + b) * self.width + i + a] for a in range(SAMPLES) for b in range(SAMPLES)]
                row.append(tuple(sum(s[c] for s in samples) // len(samples) for c in range(3)))
            rows.append(row)
        return rows


def write_png(path, rows):
    """With a palette of 256 colours: the most frequent ones, after rounding to five bits."""
    def rounded(color):
        return tuple(min(255, (c + 4) // 8 * 8) for c in color)

    count = {}
    for row in rows:
        for color in row:
            count[rounded(color)] = count.get(rounded(color), 0) + 1
    palette = sorted(count, key=lambda c: (-count[c], c))[:256]
    index = {c: i for i, c in enumerate(palette)}
    for c in count:
        if c not in index:
            index[c] = min(range(len(palette)), key=lambda i: sum((a - b) ** 2 for a, b in zip(c, palette[i])))
    raw = b''.join(b'\0' + bytes(index[rounded(c)] for c in row) for row in rows)

    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    with open(path, 'wb') as file:
        file.write(b'\x89PNG\r\n\x1a\n'
                   + chunk(b'IHDR', struct.pack('>IIBBBBB', len(rows[0]), len(rows), 8, 3, 0, 0, 0))
                   + chunk(b'PLTE', b''.join(bytes(c) for c in palette))
                   + chunk(b'IDAT', zlib.compress(raw, 9)) + chunk(b'IEND', b''))


def beside(left, right):
    return [a + b for a, b in zip(left.pixels(), right.pixels())]


# ----------------------------------------------------------------- patterns ----

def lit(color, brightness):
    return tuple(max(0, min(255, int(c * brightness))) for c in color)


def checker(cell, colors=(CREAM, BLUE), shift=0.):
    """A checkerboard in the plane, with squares of this side."""
    def pattern(u, v):
        return colors[(math.floor(u / cell + shift) + math.floor(v / cell + shift)) % 2]
    return pattern


def graticule(step):
    """Of directions: squares between the parallels and meridians of the axis z."""
    def pattern(x, y, z):
        latitude = math.degrees(math.atan2(z, math.hypot(x, y))) + 90
        longitude = math.degrees(math.atan2(y, x)) + 180
        return (CREAM, BLUE)[(math.floor(latitude / step) + math.floor(longitude / step)) % 2]
    return pattern


# ------------------------------------------------------------------ drawing ----

def fit(points, margin=10., window=None):
    """The motion and scale that bring (x, y, z) into one half of a picture, y upwards; or a window, in parts of the whole."""
    low = [min(p[i] for p in points) for i in range(2)]
    high = [max(p[i] for p in points) for i in range(2)]
    if window:
        extent = [high[i] - low[i] for i in range(2)]
        low, high = ([low[i] + extent[i] * window[k][i] for i in range(2)] for k in range(2))
    scale = SAMPLES * min((WIDTH - 2 * margin) / (high[0] - low[0]), (HEIGHT - 2 * margin) / (high[1] - low[1]))
    middle = [(low[i] + high[i]) / 2 for i in range(2)]

    def place(p):
        return (SAMPLES * WIDTH / 2 + scale * (p[0] - middle[0]),
                SAMPLES * HEIGHT / 2 - scale * (p[1] - middle[1]), scale * p[2])
    return place, scale


def draw_surface(surface, view, color_of, attributes_of, seams=(), dots=(), wires=False, window=None):
    """The surface from the direction of z after the rotation `view`, with light from the upper left."""
    m = rotation(*view)
    turned = [[sum(m[i][k] * p[k] for k in range(3)) for i in range(3)] for p in surface.points]
    place, scale = fit(turned, window=window)
    screen = [place(p) for p in turned]
    canvas = Canvas(WIDTH, HEIGHT)

    normals = [[0., 0., 0.] for _ in turned]
    for t in surface.triangles:
        a, b, c = (turned[corner[0]] for corner in t)
        u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for corner in t:
            for i in range(3):
                normals[corner[0]][i] += n[i]
    light = (-0.35, 0.45, 0.82)

    def brightness(n):
        length = math.sqrt(sum(x * x for x in n)) or 1.
        s = sum(a * b for a, b in zip(n, light)) / length
        return 0.45 + 0.62 * max(0., s if n[2] >= 0 else -0.3 * s)

    for t in surface.triangles:
        extra = attributes_of(t)

        def shade(x):
            return lit(color_of(*x[3:]), brightness(x[:3]))
        canvas.triangle([screen[corner[0]] for corner in t],
                        [list(normals[corner[0]]) + list(e) for corner, e in zip(t, extra)], shade)
    lift = 0.012 * max(WIDTH, HEIGHT) * SAMPLES
    if wires:
        for t in surface.triangles:
            for k in range(3):
                canvas.line(screen[t[k][0]], screen[t[(k + 1) % 3][0]], GREY, 0.6, 0.2 * lift)
    for a, b in seams:
        canvas.line(screen[a], screen[b], ORANGE, 1.8, lift)
    for v in dots:
        canvas.dot(screen[v], RED, 7., 4 * lift)
    return canvas


def projected(uvw):
    return (uvw[0] / uvw[2], uvw[1] / uvw[2], 0.)


def draw_layout(surface, color_of, seams=(), dots=(), wires=False, around=()):
    """The layout in the plane, with the same pattern, and a polygon around it."""
    flat = [projected(p) for p in surface.uv]
    place, scale = fit(flat + list(around))
    screen = [place(p) for p in flat]
    canvas = Canvas(WIDTH, HEIGHT)
    for t in surface.triangles:
        canvas.triangle([screen[c[1]] for c in t], [flat[c[1]][:2] for c in t], lambda x: color_of(*x))
    if wires:
        for t in surface.triangles:
            for k in range(3):
                canvas.line(screen[t[k][1]], screen[t[(k + 1) % 3][1]], GREY, 0.6)
    border = {}
    for t in surface.triangles:
        for k in range(3):
            border[t[k][1], t[(k + 1) % 3][1]] = True
    for a, b in border:
        if (b, a) not in border:
            canvas.line(screen[a], screen[b], GREY, 1.)
    for p, q in zip(around, list(around[1:]) + list(around[:1])):
        canvas.line(place(p), place(q), GREY, 1.)
    for a, b in seams:
        canvas.line(screen[a], screen[b], ORANGE, 1.8)
    for t in dots:
        canvas.dot(screen[t], RED, 7.)
    return canvas


def plane(surface):
    """Attributes of a triangle for patterns of the plane; those of homogeneous coordinates stay so."""
    return lambda t: [surface.uv[c[1]][:2] for c in t]


# ----------------------------------------------------------------- pictures ----

class Gallery:
    def __init__(self, programs, meshes, folder):
        self.programs, self.meshes, self.folder = programs, meshes, folder

    def mesh(self, name):
        return os.path.join(self.meshes, name)

    def flatten(self, mesh, *options):
        out = os.path.join(self.folder, 'out.obj')
        subprocess.run([os.path.join(self.programs, 'flatten_mesh'), mesh, '-o', out, '--quiet', *options], check=True)
        return Surface(out)

    def cell(self, surface, number):
        """Such that about so many squares cover the layout, whatever its shape."""
        area = sum(abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2
                   for a, b, c in ([projected(surface.uv[corner[1]]) for corner in t] for t in surface.triangles))
        return math.sqrt(area / number)

    def textured(self, surface, view, number=300, pattern=None, cones=()):
        """Surface and layout with a checkerboard, seams and cones."""
        pattern = pattern or checker(self.cell(surface, number))
        corners = {c for t in surface.triangles for c in t if c[0] in cones}
        return beside(draw_surface(surface, view, pattern, plane(surface), surface.seam_edges(), cones),
                      draw_layout(surface, pattern, surface.seams(), [c[1] for c in corners]))


# how the lion head and the surface with two handles are turned
LION, EIGHT = (-25, 0, 0), (20, 60, 0)


def cones_of(surface):
    """Vertices at which the angles of the layout do not sum up to a whole turn, inside the surface."""
    total, next_of = {}, {}
    for t in surface.triangles:
        p = [projected(surface.uv[c[1]]) for c in t]
        for k in range(3):
            a, b, c = p[k], p[(k + 1) % 3], p[(k + 2) % 3]
            angle = math.atan2((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]),
                               (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]))
            total[t[k][0]] = total.get(t[k][0], 0.) + angle
            next_of.setdefault(t[k][0], set()).add((t[(k + 1) % 3][0], t[(k + 2) % 3][0]))
    return [v for v, angle in total.items()
            if abs(angle - 2 * math.pi) > 1e-3 and {a for a, b in next_of[v]} == {b for a, b in next_of[v]}]


def natural(g):
    return g.textured(g.flatten(g.mesh('lion-head.off')), LION)


def rectangle(g):
    return g.textured(g.flatten(g.mesh('lion-head.off'), '--boundary', 'rectangle'), LION)


def disk(g):
    return g.textured(g.flatten(g.mesh('lion-head.off'), '--target', 'disk'), LION)


def cones(g):
    s = g.flatten(g.mesh('lion-head.off'), '--cones', 'auto=5')
    return g.textured(s, LION, cones=cones_of(s))


def seamless(g):
    s = g.flatten(g.mesh('lion-head.off'), '--cones', 'auto=5', '--seamless', '--tiles', '300')
    return g.textured(s, LION, pattern=checker(1., shift=0.5), cones=cones_of(s))


def projective(g):
    """The same layout twice: interpolated linearly, and projectively."""
    s = g.flatten(g.mesh('blob.off'), '--projective')
    cell, view = g.cell(s, 400), (0, 0, 0)
    flat = checker(cell)
    part = ((0.55, 0.3), (1., 1.))
    linear = draw_surface(s, view, flat, lambda t: [projected(s.uv[c[1]])[:2] for c in t], wires=True, window=part)
    homogeneous = draw_surface(s, view, lambda u, v, w: flat(u / w, v / w), lambda t: [s.uv[c[1]] for c in t],
                               wires=True, window=part)
    return beside(linear, homogeneous)


def refinement(g):
    """Edges of the mesh in grey, and those of the triangulation after flips, which cut its faces, in orange."""
    s, given = g.flatten(g.mesh('nefertiti.off'), '--retriangulate', 'always', '--refine'), read_off(g.mesh('nefertiti.off'))
    edges = {tuple(sorted((t[k], t[(k + 1) % 3]))) for t in given.triangles for k in range(3)}
    edges = [(given.points[a], given.points[b]) for a, b in edges]

    def is_given(p, q):
        middle = [(x + y) / 2 for x, y in zip(p, q)]
        return any(abs(math.dist(a, middle) + math.dist(middle, b) - math.dist(a, b)) < 1e-7 * math.dist(a, b)
                   for a, b in edges)

    def added(t):
        return [(t[k], t[(k + 1) % 3]) for k in range(3)
                if not is_given(s.points[t[k][0]], s.points[t[(k + 1) % 3][0]])]
    new = [pair for t in s.triangles for pair in added(t)]
    paper = lambda u, v: CREAM
    return beside(draw_surface(s, (20, -10, 0), paper, plane(s), [(a[0], b[0]) for a, b in new], wires=True),
                  draw_layout(s, paper, [(a[1], b[1]) for a, b in new], wires=True))


def charts(g):
    out = os.path.join(g.folder, 'out.obj')
    subprocess.run([os.path.join(g.programs, 'charts'), g.mesh('blobby.off'), out], check=True, stdout=subprocess.DEVNULL)
    return g.textured(Surface(out), (30, 20, 0), 500)


def sphere(g):
    """The surface with the meridians and parallels of the sphere, and the sphere with the edges of the mesh."""
    s, given = g.flatten(g.mesh('bear.off'), '--target', 'sphere'), read_off(g.mesh('bear.off'))
    given.triangles = [tuple((v, v) for v in t) for t in given.triangles]
    pattern, view = graticule(15), (20, 0, 0)
    directions = lambda t: [s.points[c[0]] for c in t]
    return beside(draw_surface(given, view, pattern, directions),
                  draw_surface(s, view, pattern, directions))


def torus(g):
    return g.textured(g.flatten(g.mesh('knot1.off')), (0, 0, 0), 1200)


def handles(g):
    s = g.flatten(g.mesh('eight.off'), '--seamless', '--cones', 'auto=8', '--tiles', '300')
    return g.textured(s, EIGHT, pattern=checker(1., shift=0.5), cones=cones_of(s))


def hyperbolic(g):
    s = g.flatten(g.mesh('eight.off'), '--target', 'hyperbolic')
    paper = lambda u, v: CREAM
    circle = [(math.cos(math.radians(3 * k)), math.sin(math.radians(3 * k)), 1.) for k in range(120)]
    layout = draw_layout(s, paper, s.seams(), wires=True, around=circle)
    return beside(draw_surface(s, EIGHT, paper, plane(s), s.seam_edges(), wires=True), layout)


PICTURES = {f.__name__: f for f in (natural, rectangle, disk, cones, seamless, projective, refinement, charts,
                                    sphere, torus, handles, hyperbolic)}


def main(arguments):
    programs, meshes, names = arguments[0], arguments[1], arguments[2:] or list(PICTURES)
    figures = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'Conformal_equivalence', 'fig')
    for name in names:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.normpath(os.path.join(figures, 'gallery_%s.png' % name))
            write_png(path, PICTURES[name](Gallery(programs, meshes, folder)))
            print('%s: %d bytes' % (path, os.path.getsize(path)))


if __name__ == '__main__':
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1:])
