#!/bin/bash
# Runs in a bare Debian, where the package lies beside it: installs it, draws, prepares and checks, as README begins, without compilers of others.
# Where docs/samples/client lies beside it, too: installs what the package suggests for that, builds it, draws with it, and looks for what it links.
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive LC_ALL=C
cd "$(dirname "$0")"
apt-get update -qq
from=$SECONDS
apt-get install -y --no-install-recommends ./tegument_*.deb mesa-vulkan-drivers | tail -n 1
echo "installed after $((SECONDS - from)) s"
# A ball without texture coordinates: 24 times 12 squares.
awk 'BEGIN { pi = atan2(0, -1)
    for (j = 0; j <= 12; ++j) for (i = 0; i < 24; ++i)
        printf "v %.6f %.6f %.6f\n", 50 * sin(pi * j / 12) * cos(pi * i / 12), 50 * cos(pi * j / 12), -50 * sin(pi * j / 12) * sin(pi * i / 12)
    for (j = 0; j < 12; ++j) for (i = 0; i < 24; ++i) {
        a = 24 * j + i + 1; b = 24 * j + (i + 1) % 24 + 1
        if (j > 0) print "f", a, a + 24, b
        if (j < 11) print "f", b, a + 24, b + 24 } }' >ball.obj
set -x
tegument --version
tegument list >list.txt
tegument check Specular --target spirv-glslang
tegument prep ball.obj --unwrap -o ball.glb
tegument render Pyramid --mesh ball.glb --size 256 --no-head -o skin.png
: "the first picture after $((SECONDS - from)) s"
tegument render Fur --mesh ball.obj --size 256 -o fur.png
tegument render FurCoat --mesh ball.obj --size 256 -o coat.png
tegument flatten --library -o tegument.hlsl
test -s list.txt && test -s tegument.hlsl
man_page=/usr/share/man/man1/tegument.1
test -s $man_page || test -s $man_page.gz || : "no manual page: the machine's dpkg leaves manual pages out"
[ -d client ] || exit 0

: "a program of the library"
suggested=$(dpkg-query -W -f='${Suggests}' tegument | tr -d , | sed 's/\(wine\|wine64\|xvfb\) //g')
# shellcheck disable=SC2086
apt-get install -y --no-install-recommends $suggested | tail -n 1
cmake -S client -B built -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS='-Wall -Wextra -Werror -Wno-missing-field-initializers' \
    -DCMAKE_EXE_LINKER_FLAGS=-Wl,-Map=client.map | tail -n 1
cmake --build built | tail -n 1
built/client FurCoat ball.obj --size 256x256 -o client.png
cmp client.png coat.png
# What the linker took from archives of the package, and that none of it is made of tools/.
taken=$(grep -o '^[^ ]*/libtegument_[a-z0-9_]*\.a(' built/client.map | sed 's/.*libtegument_//; s/\.a($//' | sort -u | paste -sd ' ')
[[ " $taken " = *" assets "* ]]
[[ ! " $taken " =~ \ (batch|check|cli|app|direct3d|emit|lsp|report|view)\  ]]
