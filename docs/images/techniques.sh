#!/usr/bin/env bash
# Renders both techniques x both heads x three lights x three settings into out/techniques/ and lays them into one sheet per head:
# docs/images/techniques.sh [SIZE]. Needs ./bootstrap demo; the Lee Perry-Smith head also its data ($TEGUMENT_DATA).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tegument=${TEGUMENT:-build/release/tegument}
size=${1:-200}
settings=(seed deon2007 corrected)
lights=(front side behind)
out=out/techniques
mkdir -p "$out"

sheet() { # HEAD
    local setting technique light name pictures=() labels=()
    for setting in "${settings[@]}"; do
        for technique in DEonLuebke Gosselin; do
            for light in "${lights[@]}"; do
                name="$out/$1_${technique}_${light}_$setting.png"
                "$tegument" render effects/Main.fx -t "$technique" --setting "$setting" -w "effects/workspaces/$1_$light.json" \
                    --size "${size}x$size" -o "$name" >/dev/null
                pictures+=("$name")
            done
        done
    done
    for technique in "d'Eon" Gosselin; do
        for light in "${lights[@]}"; do labels+=("$technique $light"); done
    done
    "$tegument" sheet "${pictures[@]}" --columns 6 --gap 4 --column-labels "$(IFS=, && echo "${labels[*]}")" \
        --row-labels "$(IFS=, && echo "${settings[*]}")" -o "docs/images/techniques_$1.jpg"
}

sheet human
if [ -n "${TEGUMENT_DATA:-}" ]; then sheet lps_head; else echo "TEGUMENT_DATA is not set: docs/images/techniques_lps_head.jpg stays as it is"; fi
