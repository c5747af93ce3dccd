#!/bin/sh
# Runs every *.test.hlsl below a folder of your project, without a GPU on lavapipe; ends with 0 where all tests pass. The results also as JUnit's XML.
set -eu
folder=${1:?usage: test-shaders.sh FOLDER [RESULTS.xml]}
find "$folder" -name '*.test.hlsl' -print0 | sort -z | xargs -0 "${TEGUMENT:-tegument}" test --junit "${2:-tests.xml}"
