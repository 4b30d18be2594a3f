#!/usr/bin/env bash
# Draws the scenes of papers 1 and 2 beside their references, into docs/gallery with a README.md that tells how far apart
# they are.
#   scripts/gallery.sh [SECONDS]     for each reference; 60 where not given
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
size=480x360
scenes=(
  glass-ball glass-torus torus-knot glass-teapot knot-spotlight teapot-three-lights bunny-line-light coloured-horse coloured-bunny
  ball-over-teapot coloured-ball-over-statue ball-over-statue-in-room teapot-over-statue bunny-line-light-over-statue
)
. scripts/gallery_tools.sh
mkdir -p docs/gallery

{
  echo "# The scenes of papers 1 and 2"
  echo
  echo "Left: the technique of papers 1 and 2, with 16 samples of each pixel. Right: the reference after $seconds s on this machine, by the same paths"
  echo "(\`--paths transmission\`). LDR-FLIP is the mean difference between the two to someone who flips between them, 0 to 1; what"
  echo "the reference's noise adds to it is in it. Made by \`scripts/gallery.sh $seconds\`."
} >"$work/README.md"

for scene in "${scenes[@]}"; do
  echo "$scene" >&2
  "$program" compare "scenes/$scene.toml" -o "$work/$scene" --techniques illumination-textures --source table --paths transmission \
    --size "$size" --seconds "$seconds" --quiet >/dev/null
  cp "$work/$scene/illumination-textures.png" "docs/gallery/$scene.png"
  cp "$work/$scene/reference.png" "docs/gallery/$scene.reference.png"
  {
    echo
    sed -n '/^#/!q; s/^# //p' "scenes/$scene.toml"
    printf '(`scenes/%s.toml`; LDR-FLIP %.3f)\n\n' "$scene" "$(number "$work/$scene/report.json" ldr_flip)"
    echo "![$scene]($scene.png) ![its reference]($scene.reference.png)"
  } >>"$work/README.md"
done
mv "$work/README.md" docs/gallery/README.md
