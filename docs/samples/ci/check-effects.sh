#!/bin/sh
# Checks every effect below a folder of your project; ends with 1 where one does not compile, with 3 where one could not be checked.
set -eu
folder=${1:?usage: check-effects.sh FOLDER}
tegument=${TEGUMENT:-tegument}
find "$folder" -name '*.fx' -print0 | sort -z | xargs -0 "$tegument" check --target spirv-dxc
