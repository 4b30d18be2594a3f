#!/usr/bin/env bash
# check_tidy.sh BUILD_FOLDER: clang-tidy over the library, as it is compiled in BUILD_FOLDER. The program's few files would
# take as long again, for CLI11's headers.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1

git ls-files 'src/*.cpp' |
  xargs -r -n 1 -P "$(nproc)" clang-tidy -p "$build" --quiet --warnings-as-errors='*' 2>&1 |
  { grep --line-buffered -vE '^[0-9]+ warnings? generated|^Suppressed|^Use -header-filter|^$' || true; }
exit "${PIPESTATUS[1]}"
