#!/usr/bin/env bash
# check_tidy.sh BUILD_FOLDER: clang-tidy over the files that BUILD_FOLDER compiles, as .clang-tidy says.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1

git ls-files 'src/*.cpp' 'apps/*.cpp' |
  xargs -r -n 1 -P "$(nproc)" clang-tidy -p "$build" --quiet --warnings-as-errors='*' 2>&1 |
  { grep --line-buffered -vE '^[0-9]+ warnings? generated|^Suppressed|^Use -header-filter|^$' || true; }
exit "${PIPESTATUS[1]}"
