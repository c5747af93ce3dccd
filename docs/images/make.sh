#!/usr/bin/env bash
# Makes the pictures of README and docs: docs/images/make.sh. Needs ./bootstrap demo; the Lee Perry-Smith head also its data ($TEGUMENT_DATA).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tegument=build/release/tegument
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

picture() { # NAME TECHNIQUE WORKSPACE [OPTION...]
    local name="$1" technique="$2" workspace="$3"
    shift 3
    "$tegument" render effects/Main.fx -t "$technique" -w "effects/workspaces/$workspace.json" --size 440x440 -o "$work/$name.png" "$@" >/dev/null
    printf '%s\n' "$name"
}

sheet() { # HEAD: scattered and not, the same from behind
    picture "$1" DEonLuebke "$1"
    picture "$1-lambert" Lambert "$1"
    picture "$1-backlit" DEonLuebke "$1_backlit"
    picture "$1-backlit-lambert" Lambert "$1_backlit"
    "$tegument" sheet "$work/$1.png" "$work/$1-lambert.png" "$work/$1-backlit.png" "$work/$1-backlit-lambert.png" --columns 2 -o "docs/images/$1.png"
}

sheet human
if [ -n "${TEGUMENT_DATA:-}" ]; then sheet lps_head; else echo "TEGUMENT_DATA is not set: docs/images/lps_head.png stays as it is"; fi
