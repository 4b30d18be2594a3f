#!/usr/bin/env bash
# Draws the scenes of scenes/edges beside their references, into docs/gallery/edges.
#   scripts/edges_gallery.sh [SECONDS] [PROGRAM]     SECONDS for each reference, 60 where not given; with an older PROGRAM, also
#                                                    its picture of each
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
older=${2:-}
. scripts/gallery_tools.sh
out=docs/gallery/edges
mkdir -p "$out"

{
  echo "# Edges, media that touch, lamps with a size"
  echo
  echo "Left: \`nephroid render\` with its default technique, 360 x 270. Right: the reference after $seconds s on this machine. A third"
  echo "picture is of the version before these were mended. Made by \`scripts/edges_gallery.sh $seconds OLDER_PROGRAM\`."
} >"$work/README.md"

for scene in scenes/edges/*.toml; do
  name=$(basename "$scene" .toml)
  echo "$name" >&2
  "$program" compare "$scene" -o "$work/$name" --techniques adaptive-beams --size 360x270 --seconds "$seconds" --photons 1000000 --quiet >/dev/null
  cp "$work/$name/adaptive-beams.png" "$out/$name.png"
  cp "$work/$name/reference.png" "$out/$name.reference.png"
  {
    echo
    sed -n '/^#/!q; s/^# //p' "$scene"
    printf '(`%s`)\n\n' "$scene"
    printf '![%s](%s.png) ![its reference](%s.reference.png)' "$name" "$name" "$name"
  } >>"$work/README.md"
  if [ -n "$older" ] && "$older" render "$scene" -o "$out/$name.before.png" --size 360x270 --quiet; then
    printf ' ![before](%s.before.png)' "$name" >>"$work/README.md"
  fi
  echo >>"$work/README.md"
done
mv "$work/README.md" "$out/README.md"
