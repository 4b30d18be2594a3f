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
. scripts/gallery_tools.sh

{
  echo "# Pictures by the default technique, beside the reference"
  echo
  echo "What \`nephroid render SCENE\` draws at 640 x 480, 16 samples, all paths, and the reference after $seconds s on this machine, in passes"
  echo "of a million photons, so that its noise is known (\`nephroid compare SCENE --techniques adaptive-beams\`). LDR-FLIP is the"
  echo "mean difference to someone who flips between the two, 0 to 1; what the reference's noise adds to it is in it. Made by"
  echo "\`scripts/default_pictures.sh $seconds ${names[*]}\`."
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
