#!/usr/bin/env bash
# Times of effects/FurRoots.fx beside its error: lab/measure/fur_times.sh MESH [SIZE [FRAMES]] > table.md
# Run from the root of the source tree; TEGUMENT names the program. The error is the relative L2 distance from the same strands drawn with
# 64 layers, none of them left out; both at one sample a pixel.
set -euo pipefail
tegument=${TEGUMENT:-build/release/tegument}
mesh=$1
size=${2:-1920x1080}
frames=${3:-30}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$tegument" fur roots "$mesh" --shortest 0.55 -o "$work/roots.dds" >/dev/null
cat >"$work/scene.json" <<END
{ "mesh": "$(realpath "$mesh")", "head": false, "camera": { "position": [0.2, 0.6, 4.5], "target": [0, 0, 0], "horizontal_fov": 38 },
  "light": { "position": [-3, 4.5, 4.5], "color": [1.9, 1.8, 1.65] }, "background": [0.12, 0.13, 0.14] }
END

draw() { # TECHNIQUE OUTPUT [--set ...]: milliseconds of the strands
    local technique=$1 output=$2
    shift 2
    "$tegument" render effects/FurRoots.fx -t "$technique" -w "$work/scene.json" --size "$size" --frames "$frames" \
        --set "gFurRootsMap=$work/roots.dds" "$@" -o "$output" | tee "$work/log" | awk '$1 == "Strands" { print $2 }'
}

printf '| technique | layers | drawn | ms | relative L2 |\n|---|---|---|---|---|\n'
for technique in ${TECHNIQUES:-Cellular Roots}; do
    all=$(draw "$technique" "$work/truth.exr" --set gFurLayers=64 --set gFurFewest=64)
    for layers in 8 16 32 64; do
        for fewest in 4 "$layers"; do
            ms=$(draw "$technique" "$work/picture.exr" --set "gFurLayers=$layers" --set "gFurFewest=$fewest")
            error=$("$tegument" compare "$work/picture.exr" "$work/truth.exr" | awk '$1 == "relative" { print $3 }')
            printf '| %s | %s | %s | %s | %s |\n' "$technique" "$layers" "$([ "$fewest" = 4 ] && echo "by the view" || echo all)" "$ms" "$error"
        done
    done
done
sed -n 2p "$work/log"
