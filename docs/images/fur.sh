#!/usr/bin/env bash
# Makes the pictures of docs/design/modules/Fur.md: docs/images/fur.sh [SIZE]. Needs ./bootstrap demo; for the Dragon and the coarse meshes the Stanford
# scans of docs/meshprep.md, where its tests look for them. Pictures and meshes in between go to out/fur_pictures/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tegument=${TEGUMENT:-build/release/tegument}
size=${1:-220}
workspace=effects/workspaces/bunny.json
cache=${TEGUMENT_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/tegument}
out=out/fur_pictures
mkdir -p "$out"

render() { # NAME ARGUMENT...
    local name="$1"
    shift
    [ -s "$out/$name.png" ] || "$tegument" render effects/Fur.fx "$@" -o "$out/$name.png" >/dev/null
}

view() { # NAME CAMERA LIGHT: the workspace, seen and lit from elsewhere
    sed -E "s|(\"position\": )\[[^]]*\](, \"target\")|\1[$2]\2|; s|(\"light\": \{ \"position\": )\[[^]]*\]|\1[$3]|" "$workspace" >"$out/$1.json"
}

techniques() { # three views x six techniques, with strands wide enough to be seen one by one
    local view technique pictures=()
    "$tegument" fur texture -o "$out" --size 512 --density 0.05 --spacing 2.8 --radius 3.4 --shortest 0.45 --taper >/dev/null
    view left "0.2, 0.6, 4.5" "-3, 4.5, 4.5"
    view front "-4.1, 0.6, 1.9" "-5, 5, 3.5"
    view behind "3.2, 2.2, -2.4" "4.5, 4.5, 1"
    for view in left front behind; do
        for technique in CubePosition CubeNormal CubeCombined SpherePosition SphereNormal SphereCombined; do
            render "${technique}_$view" -t "$technique" -w "$out/$view.json" --size "${size}x$size" \
                --set "gFurCubeMap=$out/fur_cube.dds" --set "gFurSphereMap=$out/fur_sphere.dds" --set gFurGrain=0.019
            pictures+=("$out/${technique}_$view.png")
        done
    done
    "$tegument" sheet "${pictures[@]}" --columns 6 --gap 4 --row-labels "left,front,behind" \
        --column-labels "cube position,cube normal,cube both,sphere position,sphere normal,sphere both" -o docs/images/fur_techniques.jpg
}

prepare() { # NAME SCAN.gz|SCAN.xz
    local scan="$out/$1.ply"
    [ ! -s "$out/$1.glb" ] || return 0
    case "$2" in
        *.gz) gunzip -c "$2" >"$scan" ;;
        *.xz) xz -dc "$2" >"$scan" ;;
    esac
    "$tegument" prep "$scan" --unit-mm 1000 --levels 1 -o "$out/$1.glb" >/dev/null
}

levels() { # full meshes, and coarse ones of the same scans
    local name pictures=()
    prepare dragon "$cache/data/dragon/dragon_vrip.ply.gz"
    prepare dragon_coarse "$cache/data/dragon/dragon_vrip_res4.ply.gz"
    prepare bunny_coarse "$TEGUMENT_DATA/stanford/bun_zipper_res3.ply.xz"
    cp "$cache/fur/bunny.glb" "$out/bunny.glb"
    for name in bunny bunny_coarse dragon dragon_coarse; do
        render "level_$name" -t CubePosition -w "$workspace" --mesh "$out/$name.glb" --size 400x400 --set gFurLength=0.04
        pictures+=("$out/level_$name.png")
    done
    "$tegument" sheet "${pictures[@]}" --columns 4 --gap 4 \
        --column-labels "Bunny 69666,Bunny 3837,Dragon 871306,Dragon 10980" --row-labels " " -o docs/images/fur_levels.jpg
}

render bunny -t CubePosition -w "$workspace" --size 640x640
"$tegument" sheet "$out/bunny.png" --columns 1 -o docs/images/bunny.jpg
techniques
if [ -n "${TEGUMENT_DATA:-}" ] && [ -s "$cache/data/dragon/dragon_vrip.ply.gz" ]; then
    levels
else
    echo "TEGUMENT_DATA is not set, or there is no Dragon: docs/images/fur_levels.jpg stays as it is"
fi
