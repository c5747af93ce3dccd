#!/bin/bash
# fetch_meshoptimizer.sh FOLDER NAME==VERSION SHA256: the simplifier of meshoptimizer, as that crate carries its source, goes to FOLDER.
# Nothing is built. cargo compares what it downloads with the registry's sum, and writes that sum beside it; here it is held against the pin.
set -euo pipefail
folder="$1" name="${2%%==*}" version="${2##*==}" stamp="$2 $3"
[ ! -f "$folder/.package" ] || [ "$(cat "$folder/.package")" != "$stamp" ] || exit 0
mkdir -p "$(dirname "$folder")"
scratch="$(mktemp -d "$folder.XXXXXX")"
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/src" "$scratch/result" && : >"$scratch/src/lib.rs"
printf '[package]\nname = "fetch"\nversion = "0.0.0"\nedition = "2021"\n[dependencies]\n%s = "=%s"\n' "$name" "$version" >"$scratch/Cargo.toml"
(cd "$scratch" && cargo vendor --quiet vendor >/dev/null)
grep -q "\"package\":\"$3\"" "$scratch/vendor/$name/.cargo-checksum.json" || { echo "$2 is not what is pinned" >&2 && exit 1; }
cp "$scratch/vendor/$name/vendor/src/"{meshoptimizer.h,simplifier.cpp,allocator.cpp} "$scratch/result"
echo "$stamp" >"$scratch/result/.package" # the folder appears whole
rm -rf "$folder" && mv "$scratch/result" "$folder"
