# Sourced by demo.sh and test.sh: configures and builds one folder.

# build FOLDER [cmake option ...]
build() {
  local folder=$1
  shift
  local options=(-G Ninja "$@")
  if command -v ccache >/dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  # Two compilers for each core is what small machines bear; big files take about 1 GiB.
  cmake -S . -B "$folder" "${options[@]}" >"$folder.log" 2>&1 || { cat "$folder.log" >&2; return 1; }
  rm -f "$folder.log"
  cmake --build "$folder" --parallel "$(nproc)"
}
