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

if [ ! -d "$root" ]; then
  if [ -z "$mirror" ]; then
    echo "test_in_other_debian.sh: apt here knows no Debian mirror to make a root of $suite from" >&2
    exit 1
  fi
  mkdir -p "$roots"
  rm -rf "$root.unfinished"
  debootstrap --variant=minbase --include=ca-certificates,git "$suite" "$root.unfinished" "$mirror"
  mv "$root.unfinished" "$root"
fi
exec {lock}>"$root.lock"
if ! flock -n "$lock"; then
  echo "test_in_other_debian.sh: another run of it is at work in $root" >&2
  exit 1
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
for file in /etc/apt/apt.conf /etc/apt/apt.conf.d/*proxy*; do [ ! -f "$file" ] || cp "$file" "$root/etc/apt/apt.conf.d/"; done

work=$root/work/nephroid
trap 'rm -rf "$work"' EXIT
rm -rf "$work"
git clone -q . "$work"
mkdir -p "$root/work/shared" "$root/root/.cache/ccache"
# What runs at another width of vectors left in it would be taken for what runs at this one.
rm -rf "$root"/root/.cache/mesa_shader_cache*

# Mounts that no other process sees and that end with this one, as do all processes in the root.
export root shared ccache ci="${CI:-}"
shared=$(realpath -q ../shared || true)
ccache=${CCACHE_DIR:-$HOME/.cache/ccache}
[ $# -gt 0 ] || set -- ./test.sh
echo "Debian $(cat "$root/etc/debian_version"): $*"
unshare --mount --pid --fork --kill-child bash -euo pipefail -c '
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  mount -t tmpfs tmpfs "$root/dev/shm"
  [ ! -d "$shared" ] || mount --bind -o ro "$shared" "$root/work/shared"
  [ ! -d "$ccache" ] || mount --bind "$ccache" "$root/root/.cache/ccache"
  exec chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin LANG=C.UTF-8 CI="$ci" \
    bash -c '\''cd /work/nephroid && exec "$@"'\'' bash "$@"' bash "$@"
