#!/usr/bin/env bash
# The head in a studio, key, fill and two rims: docs/images/faces.sh HEAD OUT [SIZE [MESH]]. Close-ups of the default head (eye, lips, ear,
# forehead) and five sides, as PNG in the folder OUT: faces.sh human out/faces. From 1024 on a close-up has more pixels than maps of 1024 have
# texels: it gets maps of 2048, two lobes and penumbras. MESH, a head with finer maps, for close-ups: tegument prep human --texture-size 4096
# -o out/head; faces.sh human out/faces 2048 out/head/human.glb. With lps_head only the five sides (needs its data, $TEGUMENT_DATA).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tegument=${TEGUMENT:-build/release/tegument}
head=$1
out=$2
size=${3:-448}
mesh=$(realpath "${4:-${TEGUMENT_CACHE:-$HOME/.cache/tegument}/human/human.glb}")
mkdir -p "$out"
studio=(-D TEGUMENT_SURROUNDINGS -D TEGUMENT_LAMPS=3 --set gSurroundings=0.35 --set gLightColor=1.1,1.05,1 --size "$size")
close=("${studio[@]}")
[ "$size" -lt 1024 ] || close+=(-D TEGUMENT_LOBES=1 -D TEGUMENT_SOFT_SHADOWS=1 --map-size 2048)

picture() { # NAME TARGET EYE FIELD [LIGHT], mm from the head's middle
    cat > "$out/$1.json" <<JSON
{ "mesh": "$mesh", "background": [0.02, 0.02, 0.024],
  "camera": { "frame": "world", "position": [$3], "target": [$2], "horizontal_fov": $4 },
  "light": { "frame": "world", "position": [${5:--420, 480, 820}], "color": [1.1, 1.05, 1] } }
JSON
    "$tegument" render effects/Pyramid.fx "${close[@]}" -w "$out/$1.json" -o "$out/$1.png" >/dev/null
}

if [ "$head" = human ]; then
    picture eye "31, 38, 60" "34, 41, 330" 11
    picture lips "0, -26, 75" "40, -15, 360" 14
    picture ear "75, 8, -8" "360, 30, 70" 16 "500, 350, 500"
    picture forehead "0, 72, 60" "70, 90, 470" 16
fi
for turn in 0 50 100 -60 180; do # the scene turns, camera and light stay
    "$tegument" render effects/Pyramid.fx "${studio[@]}" -w "effects/workspaces/${head}_front.json" --turn "$turn" -o "$out/turn$turn.png" >/dev/null
done
"$tegument" sheet "$out"/turn{0,50,100,-60,180}.png --columns 5 -o "$out/sides.jpg"
