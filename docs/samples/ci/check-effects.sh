#!/bin/sh
# Checks every effect below a folder of your project; ends with 1 where one does not compile, with 3 where one could not be checked.
set -eu
folder=${1:?usage: check-effects.sh FOLDER}
exec 3>&1
codes=$(find "$folder" -name '*.fx' -print0 | sort -z |
  xargs -0 sh -c '"$0" check --target spirv-dxc "$@" >&3 || echo $?' "${TEGUMENT:-tegument}")
case $codes in
  '') exit 0 ;;
  *[12]*) exit 1 ;;
  *) exit 3 ;;
esac
