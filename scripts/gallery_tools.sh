# For the scripts that draw a gallery: finds the program, makes a folder to work in, and reads reports. To be sourced in the
# repository.
for program in build/release/bin/nephroid build/bin/nephroid; do [ -x "$program" ] && break; done
if [ ! -x "$program" ]; then
  echo "$(basename "$0"): no program at $program; build it first (scripts/build.sh)" >&2
  exit 1
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The first number behind "KEY" in a report's part of the view.
number() { grep -A3 "\"$2\"" "$1" | grep -o '[0-9.]*[0-9]\(e-[0-9]*\)\?,\?$' | head -1 | tr -d ,; }
