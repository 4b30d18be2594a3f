#!/usr/bin/env bash
# From nothing to a picture: installs what is missing, builds, and renders a glass of wine at a pool.
set -euo pipefail
cd "$(dirname "$0")"
. scripts/build.sh

scripts/setup.sh
build_program
mkdir -p out
build/release/bin/nephroid render scenes/terrace/terrace.toml -o out/terrace.png --size 1280x800 "$@"
echo "The picture: $PWD/out/terrace.png"
