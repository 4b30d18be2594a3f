#!/usr/bin/env bash
# Everything that has to hold: rules and format, a build with clang and the sanitizers, a release build with gcc, all tests.
# It says what was skipped and why; the tests' own summary closes the output.
#   ./test.sh          everything
#   ./test.sh quick    the tests that need neither a driver nor counted answers, built with gcc
set -euo pipefail
cd "$(dirname "$0")"
. scripts/build.sh

if [ "${1:-}" != "" ] && [ "$1" != quick ]; then
  echo "test.sh: '$1' is not known; give nothing, or 'quick'" >&2
  exit 2
fi

step() { printf '\n== %s\n' "$*"; }

# run_tests FOLDER [ctest option ...]
run_tests() {
  local folder=$1
  shift
  rm -rf "$folder/tests/reports"
  ctest --test-dir "$folder" --parallel "$(nproc)" --output-on-failure "$@" |
    while IFS= read -r line; do
      if [[ $line =~ tests\ passed,\ [0-9]+\ tests\ failed ]]; then scripts/skipped_tests.sh "$folder" || true; echo; fi
      printf '%s\n' "$line"
    done
}

step "Set-up"
scripts/setup.sh tests

step "Who may include whom"
scripts/check_includes.sh

step "Opening comments of headers"
scripts/check_headers.sh

step "Format"
scripts/check_format.sh

if [ "${1:-}" = quick ]; then
  step "gcc: release, warnings as errors; quick tests"
  build build/test quick --preset test
  run_tests build/test --label-regex quick
  exit
fi

step "clang: warnings as errors; address and undefined-behaviour sanitizers on the tests that need no driver"
build build/sanitize quick --preset sanitize
run_tests build/sanitize --label-regex quick --exclude-regex Install

step "clang-tidy"
scripts/check_tidy.sh build/sanitize

step "gcc: the program as ./demo.sh builds it, each file by itself"
build_program

step "gcc: release, warnings as errors; all tests"
build build/test all --preset test
run_tests build/test
