#!/usr/bin/env bash
# check_tidy.sh BUILD_FOLDER: clang-tidy over the library, as it is compiled in BUILD_FOLDER: several files at once, where it is
# a unity build. The program's few files would take as long again, for CLI11's headers.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1

sed -nE 's|^ *"file": "(.*)",?$|\1|p' "$build/compile_commands.json" | grep -E "/nephroid_[a-z_]+\.dir/Unity/|^($PWD|$(pwd -P))/src/" |
  xargs -r -n 1 -P "$(nproc)" clang-tidy -p "$build" --quiet --checks=-bugprone-suspicious-include --warnings-as-errors='*' 2>&1 |
  { grep --line-buffered -vE '^[0-9]+ warnings? generated|^Suppressed|^Use -header-filter|^$' || true; }
exit "${PIPESTATUS[2]}"
