#!/bin/bash
# Holds .github/workflows against yamllint (Debian's) and actionlint, a Go module of one version: Go knows its hash by its own database.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
workflow=.github/workflows/tegument.yml
yamllint --strict -d '{extends: default, rules: {line-length: {max: 180}, comments: {min-spaces-from-content: 1}}}' "$workflow"
GOBIN="$(mktemp -d)"
export GOBIN
trap 'rm -rf "$GOBIN"' EXIT
go install github.com/rhysd/actionlint/cmd/actionlint@v1.7.7
"$GOBIN/actionlint" -no-color "$workflow"
echo "$workflow: nothing found"
