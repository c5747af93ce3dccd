#!/bin/bash
# The tests that draw, with the next Debian's loader, Mesa and validation layer: next_debian.sh make ROOT | run ROOT OUT [OPTION of listened.py...]
#   make  Debian 13 in ROOT, a folder that does not exist (debootstrap; 1.5 GB)
#   run   what build/release holds, in ROOT; libraries whose names Debian 13 does not have come from here, everything else from there
# As root. The tree and the cache are seen in ROOT where they are here, for this command alone. OUT is in the tree or below /tmp of ROOT.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tree="$PWD" suite="${SUITE:-trixie}"
cache="${TEGUMENT_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/tegument}"
packages=(ca-certificates libvulkan1 mesa-vulkan-drivers vulkan-validationlayers vulkan-tools python3 python3-numpy python3-pil python3-xlib
    python3-matplotlib xvfb x11-utils cmake git procps file glslang-tools spirv-tools glmark2-data fonts-dejavu-core)

make_root() {
    [ ! -e "$1" ] || { echo "next_debian.sh: $1 is there already" >&2 && exit 2; }
    debootstrap --variant=minbase --include="$(IFS=, && echo "${packages[*]}")" "$suite" "$1"
}

# Names that programs and compilers ask for and ROOT does not have. Never the C library, nor what Mesa and the layer need.
bring_libraries() {
    local root="$1" asked there name path
    mkdir -p "$root/opt/older"
    there="$(chroot "$root" ldconfig -p | awk '{ print $1 }')"
    asked="$( (find build/release -type f \( -perm -u+x -o -name '*.so' \) -not -name '*.cases' && find "$cache/tools" -name '*.so*') |
        { xargs -r ldd 2>/dev/null || true; } | awk '/=> \//{ print $1, $3 }' | sort -u)"
    while read -r name path; do
        grep -qxF "$name" <<<"$there" || cp -Lu --remove-destination "$path" "$root/opt/older/"
    done <<<"$asked"
}

inside() { # ROOT FOLDER COMMAND...: in a namespace of its own, whose mounts go with it
    local root="$1" folder
    for folder in /proc /sys /dev "$tree" "$cache"; do
        mkdir -p "$root$folder"
        mount --rbind "$folder" "$root$folder"
    done
    # shellcheck disable=SC2016
    exec chroot "$root" /usr/bin/env -i HOME="$HOME" TEGUMENT_CACHE="$cache" LANG=C.UTF-8 LD_LIBRARY_PATH=/opt/older \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin /bin/bash -c 'cd "$1" && shift && exec "$@"' - "$tree" "${@:2}"
}

versions='dpkg-query -W -f "\${Package} \${Version}\n" libvulkan1 mesa-vulkan-drivers vulkan-validationlayers libc6 && build/release/tegument --version --verbose'

case "${1-} $#" in
    "make 2") make_root "$2" ;;
    "run "[3-9] | "run "[1-9][0-9])
        bring_libraries "$2"
        exec unshare --mount --propagation private "$0" inside "$2" bash -c "$versions && exec python3 tests/tools/listened.py build/release \"\$@\"" - "${@:3}"
        ;;
    "inside "*) inside "${@:2}" ;;
    *) sed -n '2,/^[^#]/s/^# *//p' "$0" >&2 && exit 2 ;;
esac
