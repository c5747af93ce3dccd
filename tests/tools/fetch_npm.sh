#!/bin/bash
# fetch_npm.sh FOLDER: what tests want of npm goes to FOLDER: gltf/ (gltf-validator and gltfpack, which judge what `tegument prep` writes),
# three/ (three.js, which docs/samples/three draws with) and vscode/ (the protocol of VS Code's clients, which talks to the language server). npm holds them against the hashes of each package-lock.json; no script of theirs is run.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"

fetch() ( # FROM TO
    ! cmp -s "$1/package-lock.json" "$2/package-lock.json" || [ ! -d "$2/node_modules" ] || exit 0
    mkdir -p "$(dirname "$2")"
    scratch="$(mktemp -d "$2.XXXXXX")"
    trap 'rm -rf "$scratch"' EXIT
    cp "$1"/package*.json "$scratch"
    cd "$scratch"
    npm ci --ignore-scripts --no-audit --no-fund
    cd /
    chmod 755 "$scratch"
    rm -rf "$2" && mv "$scratch" "$2" # the folder appears whole
)

folder="$(realpath -m "$1")"
fetch "$here/gltf" "$folder/gltf"
fetch "$here/../../docs/samples/three" "$folder/three"
fetch "$here/../../tools/vscode" "$folder/vscode"
