#!/usr/bin/env bash
# Every header of src/ and apps/ begins with a comment that says what it is for.
set -euo pipefail
cd "$(dirname "$0")/.."

missing=$(git ls-files 'src/*.h' 'apps/*.h' | xargs -r awk 'FNR == 1 && !/^\/\/ [^ ]/ { print FILENAME }')
if [ -n "$missing" ]; then
  echo "These headers have no opening comment on their first line:"
  echo "$missing"
  exit 1
fi
