#!/usr/bin/env bash
# Makes the pictures of README and docs: docs/images/make.sh [tones]. Needs ./bootstrap demo; the Lee Perry-Smith head also its data ($TEGUMENT_DATA).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tegument=build/release/tegument
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

picture() { # NAME TECHNIQUE WORKSPACE
    "$tegument" render effects/Main.fx -t "$2" -w "effects/workspaces/$3.json" --size 360x360 -o "$work/$1.png" >/dev/null
    printf '%s\n' "$1"
}

sheet() { # HEAD: portrait, close-up, ear from behind; above with scattered light, below without
    local view pictures=()
    for view in "$1" "$1_closeup" "$1_backlit"; do picture "$view" DEonLuebke "$view" && pictures+=("$work/$view.png"); done
    for view in "$1" "$1_closeup" "$1_backlit"; do picture "$view-lambert" Lambert "$view" && pictures+=("$work/$view-lambert.png"); done
    "$tegument" sheet "${pictures[@]}" --columns 3 -o "docs/images/$1.png"
}

portraits() { # in a studio: portrait and close-up; with hair under one light
    local studio=(-D TEGUMENT_SURROUNDINGS -D TEGUMENT_LAMPS=3 --set gSurroundings=0.35 --set gLightColor=1.1,1.05,1 --size 480)
    "$tegument" render Pyramid "${studio[@]}" -o "$work/front.png" >/dev/null
    "$tegument" render Pyramid "${studio[@]}" -w human_closeup -o "$work/closeup.png" >/dev/null
    "$tegument" render FurSkin --size 480 -o "$work/hair.png" >/dev/null
    "$tegument" sheet "$work"/{front,closeup,hair}.png --columns 3 -o docs/images/portraits.jpg
}

tones() { # the skins among the presets
    local skin pictures=()
    for skin in very_light light intermediate tan brown dark pale flushed sunburnt; do
        "$tegument" render Pyramid -t PyramidLinked -p "$skin" -w human_front --size 320x380 -o "$work/$skin.png" >/dev/null
        pictures+=("$work/$skin.png")
    done
    "$tegument" sheet "${pictures[@]}" --columns 3 -o docs/images/tones.jpg
}

coats() { # every preset of FurCoat on the Bunny, and hair on the default head
    local coat pictures=()
    for coat in rabbit fox cat bear terrier plush velvet; do
        "$tegument" render FurCoat -p "$coat" -w bunny_roots --fit width --size 400x340 -o "$work/$coat.png" >/dev/null
        pictures+=("$work/$coat.png")
    done
    "$tegument" render FurSkin --fit width --size 400x340 -o "$work/head.png" >/dev/null
    "$tegument" sheet "${pictures[@]}" "$work/head.png" --columns 4 -o docs/images/coats.jpg
}

if [ $# -gt 0 ]; then # NAME: one of these functions alone
    "$@"
    exit
fi
sheet human
portraits
tones
coats
if [ -n "${TEGUMENT_DATA:-}" ]; then sheet lps_head; else echo "TEGUMENT_DATA is not set: docs/images/lps_head.png stays as it is"; fi
