#!/usr/bin/env python3
"""What docs/images/fur_roots.sh needs besides scans: `fur_shapes.py FOLDER` writes knot.ply, a trefoil tube without texture coordinates, and
scalp.dds, a cube map that is white where hair grows on a head that looks along +z."""

import math
import struct
import sys
from pathlib import Path

AROUND, ACROSS = 360, 24  # of the tube


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return [x / length for x in a]


def centre(t):
    r = 2 + math.cos(3 * t)
    return [r * math.cos(2 * t), r * math.sin(2 * t), -1.2 * math.sin(3 * t)]


def knot(path):
    points = []
    for i in range(AROUND):
        t = 2 * math.pi * i / AROUND
        p = centre(t)
        along = unit(minus(centre(t + 1e-4), centre(t - 1e-4)))
        side = unit(cross(along, [p[0], p[1], 0.3]))
        out = cross(side, along)
        for k in range(ACROSS):
            a = 2 * math.pi * k / ACROSS
            points.append([20 * (p[q] + 0.42 * (math.cos(a) * out[q] + math.sin(a) * side[q])) for q in range(3)])
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                   b"element face %d\nproperty list uchar uint vertex_indices\nend_header\n" % (len(points), 2 * len(points)))
        for point in points:
            file.write(struct.pack("<3f", *point))
        for i in range(AROUND):
            for k in range(ACROSS):
                a, b = i * ACROSS + k, i * ACROSS + (k + 1) % ACROSS
                c, d = (i + 1) % AROUND * ACROSS + k, (i + 1) % AROUND * ACROSS + (k + 1) % ACROSS
                file.write(struct.pack("<B3IB3I", 3, a, d, c, 3, a, b, d))


def face(number, x, y):
    """Direction through a place on a face of Direct3D's cube, x to the right and y up, both -1 to 1."""
    return [(1, y, -x), (-1, y, x), (x, 1, -y), (x, -1, y), (x, y, 1), (-x, y, -1)][number]


def scalp(path, side=64):
    texels = bytearray()
    for number in range(6):
        for row in range(side):
            for column in range(side):
                x, y, z = unit(face(number, 2 * (column + 0.5) / side - 1, 1 - 2 * (row + 0.5) / side))
                ears = 0.8 * max(0, abs(x) - 0.62)
                hair = min(max(6 * (y - 0.22 - 0.52 * max(z, 0) - 0.3 * min(z, 0) - ears), 0), 1)
                texels += bytes([int(255 * hair)] * 3 + [255])
    header = b"DDS " + struct.pack("<7I", 124, 0x100F, side, side, 4 * side, 0, 0) + bytes(44)
    header += struct.pack("<8I", 32, 4, 0x30315844, 0, 0, 0, 0, 0)  # DX10
    header += struct.pack("<5I", 0x1008, 0xFE00, 0, 0, 0) + struct.pack("<5I", 28, 3, 4, 1, 0)  # RGBA8, cube
    Path(path).write_bytes(header + bytes(texels))


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    knot(folder / "knot.ply")
    scalp(folder / "scalp.dds")
