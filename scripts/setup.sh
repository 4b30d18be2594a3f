#!/usr/bin/env bash
# Installs what is missing to build and run nephroid on Debian 12 or Ubuntu 24.04, with apt, as root or through sudo.
#   scripts/setup.sh          what building and running need
#   scripts/setup.sh tests    what the tests need as well
set -euo pipefail

packages=(
  g++ cmake ninja-build git pkg-config          # tools
  glslang-tools                                 # GLSL to SPIR-V, while building
  libvulkan-dev libvulkan-volk-dev libspirv-cross-c-shared-dev mesa-vulkan-drivers
  libembree-dev libtbb-dev libglm-dev
  libtinygltf-dev libtinyobjloader-dev libassimp-dev libopenmesh-dev libtomlplusplus-dev
  libopenexr-dev libpng-dev libstb-dev libcli11-dev nlohmann-json3-dev libxxhash-dev
  libfftw3-dev                                  # the sea's spectrum
  libopenvdb-dev libboost-dev                   # density grids of the air
  libglfw3-dev libimgui-dev                     # the viewer's window
  glmark2-data                                  # the bunny, the cat and the horse
)
if [ "${1:-}" = tests ]; then
  packages+=(libgtest-dev libbenchmark-dev vulkan-validationlayers clang clang-format clang-tidy libclang-rt-dev ccache
             xvfb xdotool twm x11-utils ffmpeg)
  # Opens a report in a test, which is skipped without it: Ubuntu's package is a snap, which containers do not run.
  if grep -qsx 'ID=debian' /etc/os-release; then packages+=(chromium); fi
elif [ -n "${1:-}" ]; then
  echo "setup.sh: '$1' is not known; give nothing, or 'tests'" >&2
  exit 2
fi

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "setup.sh: no apt here, so nothing is installed; what is needed: ${packages[*]}" >&2
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null || true)
  grep -qx installed <<<"$state" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: run this as root, or install sudo, to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing with apt: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update && "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
       apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "setup.sh: apt could not install: ${missing[*]} (on Ubuntu, 'universe' has to be enabled)" >&2
  exit 1
fi
