#!/usr/bin/env bash
# From nothing to a picture: installs what is missing, builds, and renders the bunny in colored glass.
set -euo pipefail
cd "$(dirname "$0")"
. scripts/build.sh

scripts/setup.sh
build_program
mkdir -p out
build/release/bin/nephroid render scenes/glass-bunny.toml -o out/glass-bunny.png --size 960x640 "$@"
echo "The picture: $PWD/out/glass-bunny.png"
