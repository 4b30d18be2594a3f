# Sourced by demo.sh and test.sh.

# build FOLDER TARGET [cmake option ...]: configures and builds; what CMake says is shown where it fails.
build() {
  local folder=$1 target=$2 said
  shift 2
  local options=("$@")
  # Clones share what ccache holds, files with precompiled headers too.
  export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
  if command -v ccache >/dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  said=$(cmake -S . -B "$folder" -G Ninja "${options[@]}" 2>&1) || { echo "$said" >&2; return 1; }
  cmake --build "$folder" --target "$target" --parallel "$(nproc)"
}

# What ./demo.sh runs: the program alone, each file compiled by itself.
build_program() {
  build build/release all -DCMAKE_BUILD_TYPE=Release -DNEPHROID_TESTS=OFF -DNEPHROID_BENCHMARKS=OFF
}
