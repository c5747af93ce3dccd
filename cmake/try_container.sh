#!/bin/bash
# What `cmake/package try-container FOLDER [OPTION...]` runs, as root: buildah builds docs/samples/container/Containerfile as it stands, then what
# its head promises is done in the container. It needs no daemon, no namespaces, and no registry: where none answers, debootstrap makes the base
# image. What FOLDER holds of an earlier run is used again; OPTIONs, such as --volume of a compiler's cache, are of `buildah build`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder="$(realpath -m "$1")" base=docker.io/library/debian:12-slim certificates=()
shift
mkdir -p "$folder"/{files,cache}

images() { buildah --root "$folder/images" --runroot "$folder/run" --storage-driver vfs "$@"; }

bare_image() {
    local container
    debootstrap --variant=minbase bookworm "$folder/bare" >"$folder/bare.log" || { tail "$folder/bare.log" >&2 && exit 3; }
    tar -C "$folder/bare" -cf "$folder/bare.tar" .
    container="$(images from scratch)"
    images add -q "$container" "$folder/bare.tar" / >/dev/null
    images commit -q --rm "$container" "$base" >/dev/null
    rm -rf "$folder/bare" "$folder/bare.tar"
}

# A machine whose network has an authority of its own names its certificates so; pip in a container knows nothing of them.
if [ -n "${PIP_CERT-}" ]; then
    printf '[global]\ncert = /run/certificates\n' >"$folder/pip.conf"
    certificates=(--volume "$PIP_CERT:/run/certificates:ro" --volume "$folder/pip.conf:/etc/pip.conf:ro")
fi
images inspect "$base" >/dev/null 2>&1 || images pull -q "$base" 2>"$folder/pull.log" || { echo "no $base to be had ($(tail -n 1 "$folder/pull.log")): made by debootstrap" && bare_image; }
images build --isolation chroot --pull=never "${certificates[@]}" "$@" -f docs/samples/container/Containerfile -t tegument .

container="$(images from --pull-never tegument)"
entry="$(images inspect --format '{{range .OCIv1.Config.Entrypoint}}{{.}} {{end}}' "$container")"
read -ra program <<<"$entry"
tegument() {
    echo "+ tegument $*"
    images run --isolation chroot "${certificates[@]}" --volume "$folder/files:/work" --volume "$folder/cache:/var/cache/tegument" "$container" -- "${program[@]}" "$@"
}
tegument --version
tegument flatten Specular -o mine.fx
tegument check mine.fx --skip-missing
printf 'v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >"$folder/files/own.obj"
tegument prep own.obj --unwrap -o own.glb
tegument prep human
tegument render Pyramid --size 256 -o head.png
test -s "$folder/files/own.glb" && test -s "$folder/files/head.png"
