#!/usr/bin/env bash
# Every C++ file and every shader is as .clang-format says. Versions of clang-format differ in small things, so
# one of them decides.
set -euo pipefail
cd "$(dirname "$0")/.."
deciding=14

program=$(command -v "clang-format-$deciding" || command -v clang-format || true)
version=$("${program:-false}" --version 2>/dev/null | sed -E 's/.*version ([0-9]+).*/\1/' || true)
if [ "$version" != "$deciding" ]; then
  echo "Not checked: clang-format $deciding decides, here is ${version:-none}"
  exit 0
fi
git ls-files '*.h' '*.cpp' '*.vert' '*.frag' '*.comp' | xargs -r "$program" --dry-run -Werror
