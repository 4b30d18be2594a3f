#!/usr/bin/env bash
# skipped_tests.sh BUILD_FOLDER: how many tests the last run of ctest had there, and which it skipped for which reason.
set -euo pipefail
shopt -s nullglob
reports=("$1"/tests/reports/*.xml)
[ ${#reports[@]} -gt 0 ] || { echo "No test wrote a report in $1/tests/reports"; exit 1; }

awk '
  /<testcase / {
    ++ran
    match($0, /name="[^"]*"/); test = substr($0, RSTART + 6, RLENGTH - 7)
    match($0, /classname="[^"]*"/); suite = substr($0, RSTART + 11, RLENGTH - 12)
  }
  /<skipped message=/ {
    match($0, /message="[^"]*"/); why = substr($0, RSTART + 9, RLENGTH - 10)
    sub(/^[^&]*&#x0A;/, "", why); gsub(/&#x0A;/, " ", why); gsub(/&quot;/, "\"", why); gsub(/&apos;/, "\047", why)
    skipped[++count] = suite "." test ": " why
  }
  END {
    printf "\n%d tests, %d of them SKIPPED%s\n", ran, count, count ? ":" : ""
    for (i = 1; i <= count; ++i) print "  SKIPPED " skipped[i]
  }' "${reports[@]}"
