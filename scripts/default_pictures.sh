#!/usr/bin/env bash
# Draws scenes by the shortest command, 640 x 480, and tells how far they are from the reference by all paths: writes
# docs/gallery/default-pictures.md.
#   scripts/default_pictures.sh [SECONDS [NAME ...]]     SECONDS for each reference, 60 where not given; NAMES of scenes in
#                                                        scenes/, all where none is given
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
names=("${@:2}")
if [ ${#names[@]} -eq 0 ]; then
  for scene in scenes/*.toml; do names+=("$(basename "$scene" .toml)"); done
fi
for program in build/release/bin/nephroid build/bin/nephroid; do [ -x "$program" ] && break; done
if [ ! -x "$program" ]; then
  echo "default_pictures.sh: no program at $program; build it first (scripts/build.sh)" >&2
  exit 1
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The first number behind "KEY" in a report.
number() { grep -A3 "\"$2\"" "$1" | grep -o '[0-9.]*[0-9]\(e-[0-9]*\)\?,\?$' | head -1 | tr -d ,; }

{
  echo "# Pictures by the default technique, beside the reference"
  echo
  echo "\`nephroid render SCENE\` at 640 x 480, 16 samples, all paths, and the reference after $seconds s on this machine. LDR-FLIP is the"
  echo "mean difference to someone who flips between the two, 0 to 1; what the reference's noise adds to it is in it. Made by"
  echo "\`scripts/default_pictures.sh $*\`."
  echo
  echo "| scene | LDR-FLIP | noise of the reference's caustics |"
  echo "|---|---|---|"
} >"$work/table.md"

for name in "${names[@]}"; do
  echo "$name" >&2
  if "$program" compare "scenes/$name.toml" -o "$work/$name" --techniques adaptive-beams --size 640x480 --seconds "$seconds" --photons 1000000 --quiet \
    >/dev/null 2>"$work/error"; then
    report="$work/$name/report.json"
    noise=$(sed -n 's/^ *"noise": \([0-9.e-]*\),\?$/\1/p' "$report" | head -1)
    printf '| %s | %.3f | %s |\n' "$name" "$(number "$report" ldr_flip)" \
      "${noise:+$(awk "BEGIN { printf \"%.1f %%\", 100 * $noise }")}" >>"$work/table.md"
  else
    printf '| %s | %s | |\n' "$name" "$(head -1 "$work/error")" >>"$work/table.md"
  fi
done
mv "$work/table.md" docs/gallery/default-pictures.md
