#!/usr/bin/env bash
# Who may include whom in src/ (docs/design.md). One line a folder: its name, then the folders it may know besides itself.
set -euo pipefail
cd "$(dirname "$0")/.."

rules="
core
optics core
geometry core
water core geometry
scene core optics geometry water
lights core optics geometry water scene
formats core optics geometry water scene lights
trace core optics geometry water scene
transport core optics geometry water scene lights trace
beams core optics geometry water scene lights trace transport
gpu core
gpu_scene core geometry water scene gpu
irradiance_volume core optics geometry water scene lights trace transport
techniques core optics geometry water scene lights trace transport beams irradiance_volume gpu gpu_scene
render core optics geometry water scene lights trace transport beams irradiance_volume gpu gpu_scene techniques
reference core optics geometry water scene lights trace
report core optics geometry water scene lights trace reference transport irradiance_volume beams gpu gpu_scene techniques render
papers core optics geometry water scene lights formats trace reference transport irradiance_volume beams gpu gpu_scene techniques render report
viewer core optics geometry water scene lights formats trace reference transport irradiance_volume beams gpu gpu_scene techniques render report
"
wrong=0
complain() {
  echo "$1" >&2
  wrong=1
}

while read -r folder allowed; do
  [ -n "$folder" ] && [ -d "src/$folder" ] || continue
  while IFS=: read -r file line include; do
    target=$(sed -E 's/.*"([^"]+)".*/\1/' <<<"$include")
    known=${target%%/*}
    [[ "$target" == */* && -d "src/$known" ]] || continue
    if [[ " $folder $allowed " != *" $known "* ]]; then
      complain "$file:$line: '$folder' may not know '$known'"
    fi
  done < <(grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' "src/$folder")
done <<<"$rules"

# A technique knows no other technique: of techniques/X/ only its own files and those of techniques/ itself, and techniques/planes/,
# which several are made of.
while IFS=: read -r file line include; do
  own=$(cut -d/ -f3 <<<"$file")
  other=$(sed -E 's|.*"techniques/([^/"]+)/.*|\1|' <<<"$include")
  if [ "$own" != "$other" ] && [ "$other" != planes ] && [ "$(dirname "$file")" != src/techniques ]; then
    complain "$file:$line: the technique '$own' may not know '$other'"
  fi
done < <(grep -rnE '#[[:space:]]*include[[:space:]]*"techniques/[^/"]+/' src/techniques)

while IFS=: read -r file line _; do
  complain "$file:$line: only src/trace includes Embree"
done < <(grep -rnE '#[[:space:]]*include[[:space:]]*[<"]embree' src apps tests | grep -v '^src/trace/')

while IFS=: read -r file line _; do
  complain "$file:$line: windows belong to apps/"
done < <(grep -rnE '#[[:space:]]*include[[:space:]]*[<"](imgui|GLFW)' src)

exit "$wrong"
