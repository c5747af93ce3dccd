"""Places that tgPostView reads from a depth buffer, in double precision: projections of every kind, each as a matrix from the picture."""
import math
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TEST = """#include "hlsl/scatter.fxh"
TG_TEST(places_are_those_of_the_projection)
{{
    float4 r0 = tgTable("places.csv", 0);
    float4 r1 = tgTable("places.csv", 4);
    float4 r2 = tgTable("places.csv", 8);
    float4 r3 = tgTable("places.csv", 12);
    float3 stored = tgTable("places.csv", 16);
    float4 expected = tgTable("places.csv", 19);
    float4x4 fromPicture = float4x4(r0, r1, r2, r3);
    TgPostView view = tgPostView(fromPicture, expected.w);
    float z = tgPostUnproject(stored.xy, stored.z, fromPicture, expected.w).z;
    tgNear(tgPostPlace(view, stored.xy, z), expected.xyz, tgAbsolute({tolerance}));
}}
"""


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def inverse(m):
    rows = [list(row) + [float(i == j) for j in range(4)] for i, row in enumerate(m)]
    for i in range(4):
        pivot = max(range(i, 4), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [value / rows[i][i] for value in rows[i]]
        for r in range(4):
            if r != i:
                rows[r] = [a - rows[r][i] * b for a, b in zip(rows[r], rows[i])]
    return [row[4:] for row in rows]


# Row vectors, the eye looks along -z. near 0.1, far 5, in metres.
def perspective(depth, aside=(0.0, 0.0), flipped=1.0):
    return [[2.5, 0, 0, 0], [0, 3.5 * flipped, 0, 0], [aside[0], aside[1], -depth[0], -1], [0, 0, depth[1], 0]]


USUAL = (5 / 4.9, -0.5 / 4.9)
REVERSED = (-0.1 / 4.9, 0.5 / 4.9)
INFINITE = (0.0, 0.1)
OPENGL = (5.1 / 4.9, -1 / 4.9)
ORTHO = [[3, 0, 0, 0], [0, 3, 0, 0], [0, 0, -1 / 4.9, 0], [0.2, -0.1, -0.1 / 4.9, 1]]
# (u, v, depth, 1) to clip space; v down, v up, depth to -1..1.
DOWN = [[2, 0, 0, 0], [0, -2, 0, 0], [0, 0, 1, 0], [-1, 1, 0, 1]]
UP = [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0], [-1, -1, -1, 1]]
CASES = [(perspective(USUAL), DOWN), (perspective(REVERSED), DOWN), (perspective(INFINITE), DOWN), (perspective(USUAL, (0.3, -0.2)), DOWN),
         (perspective(REVERSED, (0.1, 0.4), -1.0), DOWN), (perspective(OPENGL), UP), (ORTHO, DOWN)]


def lines(wrong):
    draw = random.Random(5)
    yield "a,b,c,d,e,f,g,h,i,j,k,l,m,n,o,p,u,v,depth,x,y,z,mm"
    for projection, picture in CASES:
        back = inverse(picture)
        matrix = times(picture, inverse(projection))
        for _ in range(20):
            place = [draw.uniform(-0.1, 0.1), draw.uniform(-0.1, 0.1), draw.uniform(-0.9, -0.5), 1.0]
            clip = [sum(place[k] * projection[k][j] for k in range(4)) for j in range(4)]
            at = [sum(clip[k] / clip[3] * back[k][j] for k in range(4)) for j in range(4)]
            numbers = [n for row in matrix for n in row] + at[:3] + [1000 * c for c in place[:3]] + [1000.0]
            numbers[-2] += wrong
            yield ",".join(f"{n:.12g}" for n in numbers)


def run(program, folder, wrong):
    # Depths are floats, of which the usual ones keep 2^-24: 0.02 mm at 0.9 m of 0.1 to 5 m.
    (folder / "places.csv").write_text("\n".join(lines(wrong)) + "\n")
    (folder / "view.test.hlsl").write_text(TEST.format(tolerance=0.1))
    return subprocess.run([program, "test", str(folder / "view.test.hlsl")], capture_output=True, text=True)


def main(program, hlsl):
    assert all(math.isfinite(float(n)) for line in list(lines(0))[1:] for n in line.split(","))
    with tempfile.TemporaryDirectory() as name:
        shutil.copytree(hlsl, Path(name) / "hlsl")
        right = run(program, Path(name), 0.0)
        if right.returncode == 3:
            print(right.stderr)
            return 77
        wrong = run(program, Path(name), 1.0)
    if right.returncode != 0 or wrong.returncode == 0 or "places_are" not in wrong.stdout + wrong.stderr:
        print(right.stdout, right.stderr, "with places 1 mm off:", wrong.returncode, sep="\n")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], Path(sys.argv[2]).resolve()))
