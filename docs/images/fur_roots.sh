#!/usr/bin/env bash
# Makes the pictures of docs/design/modules/FurRoots.md: docs/images/fur_roots.sh [SIZE]. Needs ./bootstrap demo, the Stanford scans where the tests of
# docs/meshprep.md look for them ($TEGUMENT_DATA, the Dragon in the cache) and Python 3. What lies in between goes to out/fur_roots/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tegument=${TEGUMENT:-build/release/tegument}
size=${1:-250}
cache=${TEGUMENT_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/tegument}
out=out/fur_roots
mkdir -p "$out"

scene() { # MESH ANGLE DISTANCE: camera and light turned together around the mesh
    awk -v mesh="$1" -v degrees="$2" -v away="$3" 'BEGIN {
        a = degrees * atan2(0, -1) / 180
        printf "{ \"mesh\": \"%s\", \"head\": false, \"background\": [0.12, 0.13, 0.14], \"parameters\": { \"gFurFill\": [0.07, 0.08, 0.1] },\n", mesh
        printf "  \"camera\": { \"position\": [%g, %g, %g], \"target\": [0, 0, 0], \"horizontal_fov\": 26 },\n", away * sin(a), 0.13 * away, away * cos(a)
        printf "  \"light\": { \"position\": [%g, 4.5, %g], \"color\": [1.9, 1.8, 1.65] } }\n", -3 * cos(a) + 4.5 * sin(a), 3 * sin(a) + 4.5 * cos(a)
    }'
}

draw() { # NAME MESH ANGLE DISTANCE SIZE ARGUMENT...
    local name="$1" mesh="$2" angle="$3" away="$4" side="$5"
    shift 5
    [ ! -s "$out/$name.png" ] || return 0
    scene "$(realpath "$mesh")" "$angle" "$away" >"$out/$name.json"
    "$tegument" render effects/FurRoots.fx -w "$out/$name.json" --size "${side}x$side" "$@" -o "$out/$name.png" >/dev/null
}

roots() { # NAME MESH ARGUMENT...
    local name="$1" mesh="$2"
    shift 2
    [ -s "$out/$name.dds" ] || "$tegument" fur roots "$mesh" --shortest 0.5 "$@" -o "$out/$name.dds" >/dev/null
}

pictures=()
turn() { # NAME MESH SETTING...: six views
    local name="$1" mesh="$2" angle sets=()
    shift 2
    for angle in "$@"; do sets+=(--set "$angle"); done
    for angle in 30 90 150 210 270 330; do
        draw "${name}_$angle" "$mesh" "$angle" 4.5 "$size" -t Roots --set "gFurRootsMap=$out/$name.dds" "${sets[@]}"
        pictures+=("$out/${name}_$angle.png")
    done
}

xz -dc "$TEGUMENT_DATA/stanford/bun_zipper_res3.ply.xz" >"$out/scan.ply"
"$tegument" prep "$out/scan.ply" --unit-mm 1000 --levels 1 -o "$out/bunny.glb" >/dev/null
gunzip -c "$cache/data/dragon/dragon_vrip_res4.ply.gz" >"$out/scan.ply"
"$tegument" prep "$out/scan.ply" --unit-mm 1000 --levels 1 -o "$out/dragon.glb" >/dev/null
python3 docs/images/fur_shapes.py "$out"
head=$cache/human/human.glb
roots bunny "$out/bunny.glb"
roots dragon "$out/dragon.glb"
roots knot "$out/knot.ply"
roots head "$head" --count 60000 --density-map "$out/scalp.dds" --lean 0.5 --comb 0 -0.4 -1

turn bunny "$out/bunny.glb" gFurLength=0.07 gFurLean=0.6
turn dragon "$out/dragon.glb" gFurLength=0.04 gFurLean=0.4 gFurRootColor=0.02,0.05,0.04 gFurTipColor=0.35,0.6,0.42
turn knot "$out/knot.ply" gFurLength=0.08 gFurLean=0.3 gFurRootColor=0.1,0.02,0.03 gFurTipColor=0.9,0.5,0.45
turn head "$head" gFurLength=0.1 gFurLean=0.5 gFurRadius=0.2 gFurRootColor=0.45,0.27,0.19 gFurTipColor=0.35,0.2,0.1
"$tegument" sheet "${pictures[@]}" --columns 6 --gap 2 -o docs/images/fur_turntable.jpg

zoom=()
for away in 2.2 3.2 4.5 6.5 9 13 20 40; do # radii; with lattice and roots, 4 samples a pixel
    draw "cells_$away" "$out/bunny.glb" 30 "$away" "$size" -t Cellular --samples 4
    zoom+=("$out/cells_$away.png")
done
for away in 2.2 3.2 4.5 6.5 9 13 20 40; do
    draw "roots_$away" "$out/bunny.glb" 30 "$away" "$size" -t Roots --set "gFurRootsMap=$out/bunny.dds" --samples 4
    zoom+=("$out/roots_$away.png")
done
"$tegument" sheet "${zoom[@]}" --columns 8 --gap 2 -o docs/images/fur_zoom.jpg
