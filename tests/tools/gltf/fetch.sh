#!/bin/bash
# fetch.sh FOLDER: gltf-validator and gltfpack, which judge what `tegument prep` writes, go to FOLDER. npm holds them against the hashes of
# package-lock.json; no script of theirs is run.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)" folder="$1"
! cmp -s "$here/package-lock.json" "$folder/package-lock.json" || [ ! -d "$folder/node_modules/gltf-validator" ] || exit 0
mkdir -p "$(dirname "$folder")"
scratch="$(mktemp -d "$folder.XXXXXX")"
trap 'rm -rf "$scratch"' EXIT
cp "$here"/package*.json "$scratch"
(cd "$scratch" && npm ci --ignore-scripts --no-audit --no-fund)
chmod 755 "$scratch"
rm -rf "$folder" && mv "$scratch" "$folder" # the folder appears whole
