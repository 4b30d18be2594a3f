#!/usr/bin/env bash
# Runs the tests of what is committed in a root of the other Debian: 13 (trixie) on Debian 12, 12 (bookworm) on all else.
#   scripts/test_in_other_debian.sh [COMMAND ...]     ./test.sh where none is given; it runs in a clone of the repository
# Needs root and debootstrap. The root is kept in NEPHROID_ROOTS (the cache folder where not given) and is used again.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "$(id -u)" -ne 0 ]; then
  echo "test_in_other_debian.sh: run this as root, since it makes a root of its own and enters it by chroot" >&2
  exit 1
fi
if ! command -v debootstrap >/dev/null; then
  echo "test_in_other_debian.sh: debootstrap is missing; install it (apt-get install debootstrap)" >&2
  exit 1
fi

suite=bookworm
if grep -qs '^12' /etc/debian_version; then suite=trixie; fi
roots=${NEPHROID_ROOTS:-${XDG_CACHE_HOME:-$HOME/.cache}/nephroid}
root=$roots/root-$suite
# The mirror that this machine's apt uses.
mirror=$(apt-get indextargets --format '$(SITE)' 2>/dev/null | grep -m 1 '/debian$' || true)

if [ ! -x "$root/usr/bin/apt-get" ]; then
  if [ -z "$mirror" ]; then
    echo "test_in_other_debian.sh: apt here knows no Debian mirror to make a root of $suite from" >&2
    exit 1
  fi
  mkdir -p "$roots"
  debootstrap --variant=minbase --include=ca-certificates,git "$suite" "$root" "$mirror"
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
for file in /etc/apt/apt.conf /etc/apt/apt.conf.d/*proxy*; do [ ! -f "$file" ] || cp "$file" "$root/etc/apt/apt.conf.d/"; done

work=$root/work/nephroid
mounted=()
leave() {
  for point in "${mounted[@]}"; do umount -l "$point"; done
  rm -rf "$work"
}
trap leave EXIT
rm -rf "$work"
git clone -q . "$work"

# mount_at PLACE [mount option ...]
mount_at() {
  local place=$root/$1
  shift
  mkdir -p "$place"
  mount "$@" "$place"
  mounted=("$place" "${mounted[@]}")
}
mount_at proc -t proc proc
mount_at dev --rbind /dev
mount_at dev/shm -t tmpfs tmpfs
if [ -d ../shared ]; then mount_at work/shared --bind -o ro ../shared; fi
if [ -d "${CCACHE_DIR:-$HOME/.cache/ccache}" ]; then mount_at root/.cache/ccache --bind "${CCACHE_DIR:-$HOME/.cache/ccache}"; fi

command=("$@")
[ ${#command[@]} -gt 0 ] || command=(./test.sh)
echo "Debian $(cat "$root/etc/debian_version"): ${command[*]}"
chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin LANG=C.UTF-8 CI="${CI:-}" \
  bash -c 'cd /work/nephroid && exec "$@"' bash "${command[@]}"
