#!/usr/bin/env bash
# Whether two builds of nephroid make the same pictures and the same figures, to the byte. Renders each scene, as PNG and
# as EXR, and measures at each of its sensors, by every technique of the first program and by the reference. Of an EXR
# its pixels are compared, not the settings written beside them. Says what differs; exits 1 where something does. Each program has
# a cache of its own, empty at first: neither is shown what the other one made, nor what an earlier run did.
#   scripts/same_bytes.sh BEFORE AFTER [SCENE ...]     programs; all of scenes/ where none is given
set -uo pipefail
if [ $# -lt 2 ] || [ ! -x "$1" ] || [ ! -x "$2" ]; then
  echo "usage: scripts/same_bytes.sh BEFORE AFTER [SCENE ...], where BEFORE and AFTER are built programs" >&2
  exit 2
fi
programs=("$(realpath "$1")" "$(realpath "$2")")
shift 2
scenes=()
for scene in "$@"; do
  [ -f "$scene" ] || { echo "same_bytes.sh: no scene '$scene'" >&2; exit 2; }
  scenes+=("$(realpath "$scene")")
done
cd "$(dirname "$0")/.."
[ ${#scenes[@]} -gt 0 ] || scenes=(scenes/*.toml)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{,cache/}{0,1}
export LC_ALL=C

# Few light samples and photons, so that a volume takes a moment.
volumes=(--light-level 0 --volume-photons 2 --volume-kilobytes 16)
picture=(--size 120x90 --time 0.5)
reference=(--technique reference --passes 1 --photons 4096)
techniques=$("${programs[0]}" info 2>/dev/null | sed -n 's/^techniques *//p' | tr -d , | sed 's/ *reference$//')
[ -n "$techniques" ] || { echo "same_bytes.sh: '${programs[0]} info' lists no techniques" >&2; exit 2; }

# What an EXR holds besides the attributes that say how it was made: its channels, its window and its chunks.
pixels() {
  perl -0777 -ne '
    my $at = 8;
    while (substr($_, $at, 1) ne "\0") {
      my ($name, $type, $size) = unpack("Z*Z*V", substr($_, $at, 1024));
      my $begin = $at + length($name) + length($type) + 6;
      print $name, substr($_, $begin, $size) if $name =~ /^(channels|compression|dataWindow)$/;
      $at = $begin + $size;
    }
    my $chunks = (unpack("Q<", substr($_, $at + 1, 8)) - $at - 1) / 8;
    print substr($_, $at + 1 + 8 * $chunks);' "$1"
}

same() {
  case $1 in
    *.exr) cmp -s <(pixels "$work/0/$1") <(pixels "$work/1/$1") ;;
    *) cmp -s "$work/0/$1" "$work/1/$1" ;;
  esac
}

compared=0 different=0
# check NAME VERB OPTIONS...: runs both programs at once. Where both refuse, with the same status, they agree.
check() {
  local name=$1 status=(0 0) running=()
  shift
  for i in 0 1; do
    XDG_CACHE_HOME="$work/cache/$i" "${programs[i]}" "$@" -o "$work/$i/$name" --quiet >/dev/null 2>"$work/$i/said" &
    running[i]=$!
  done
  for i in 0 1; do wait "${running[i]}" || status[i]=$?; done
  compared=$((compared + 1))
  if [ "${status[0]}" -ne "${status[1]}" ]; then
    echo "differs: $name: exit status ${status[0]} before, ${status[1]} after: $(cat "$work/0/said" "$work/1/said" | tail -n 1)"
  elif [ "${status[0]}" -ne 0 ]; then
    echo "refused by both: $name: $(tail -n 1 "$work/1/said")"
    return
  elif ! same "$name"; then
    echo "differs: $name"
  else
    rm -f "$work"/[01]/"$name"
    return
  fi
  different=$((different + 1))
}

for scene in "${scenes[@]}"; do
  name=$(basename "$scene")
  mapfile -t sensors < <(awk '/^\[/ {inside = /^\[\[sensor\]\]/} inside && /^name *=/ {gsub(/^name *= *"|".*/, ""); print}' "$scene")
  for technique in $techniques; do
    options=(--technique "$technique" "${volumes[@]}")
    check "$name-$technique.png" render "$scene" "${options[@]}" "${picture[@]}"
    check "$name-$technique.exr" render "$scene" "${options[@]}" "${picture[@]}"
    for sensor in "${sensors[@]}"; do
      check "$name-$sensor-$technique.exr" measure "$scene" "${options[@]}" --sensor "$sensor"
    done
  done
  check "$name-reference.exr" render "$scene" "${reference[@]}" "${picture[@]}"
done
echo "$compared outputs compared, $different differ"
[ "$different" -eq 0 ]
