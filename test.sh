#!/usr/bin/env bash
# Everything that has to hold: rules and format, a build with clang and the sanitizers, a release build with gcc, all tests.
# The tests' own summary closes the output.
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

step "Set-up"
scripts/setup.sh tests

step "Who may include whom"
scripts/check_includes.sh

step "Format"
scripts/check_format.sh

if [ "${1:-}" = quick ]; then
  step "gcc: release, warnings as errors; quick tests"
  build build/test --preset test
  ctest --test-dir build/test --parallel 2 --output-on-failure --label-regex quick
  exit
fi

step "clang: warnings as errors; address and undefined-behaviour sanitizers on the tests that need no driver"
build build/sanitize --preset sanitize
# Those that meet the counted answers, or load every scene, take minutes here, and go through no code that the others do not; what reads OpenVDB's files trips over a cast in oneTBB.
ctest --test-dir build/sanitize --parallel 2 --output-on-failure --progress --exclude-regex 'Scenes/(Reference)?Truth|LoadsTheScenes|Vdb'

step "clang-tidy"
scripts/check_tidy.sh build/sanitize

step "gcc: release, warnings as errors; all tests"
build build/test --preset test
ctest --test-dir build/test --parallel 2 --output-on-failure
