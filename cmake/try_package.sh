#!/bin/bash
# Runs in a bare Debian, where the package lies beside it: installs it, then does what README begins with, without compilers of others.
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive LC_ALL=C
cd "$(dirname "$0")"
apt-get update -qq
apt-get install -y --no-install-recommends ./tegument_*.deb mesa-vulkan-drivers | tail -n 1
set -x
tegument --version
tegument list >list.txt
tegument check Specular --target spirv-glslang
printf 'v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >own.obj
tegument prep own.obj --unwrap -o own.glb
tegument render Fur --mesh own.obj --size 256 -o fur.png
tegument render Specular --mesh own.glb --size 256 --no-head -o own.png
tegument flatten --library -o tegument.hlsl
test -s list.txt && test -s fur.png && test -s own.png && test -s tegument.hlsl
man_page=/usr/share/man/man1/tegument.1
test -s $man_page || test -s $man_page.gz || echo "no manual page: the machine's dpkg leaves manual pages out"
