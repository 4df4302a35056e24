#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Every installed program says --help and --version, has a manual page that mandoc accepts, and the two
# tell of the same options.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
[[ $# -gt 0 ]] || { echo "usage: tests/tools/man_test.sh <program>..." >&2; exit 2; }

fail() {
  echo "man: $*" >&2
  exit 1
}
options() { grep -o -E '^  (-[a-z],)?--[a-z-]+(, --[a-z-]+)*' | grep -o -E -- '--[a-z-]+' | sort -u; }

for program in "$@"; do
  name=$(basename "$program")
  page=$root/ode_ext/tools/${name#ode_ext-}/$name.1
  [[ -e $page ]] || fail "$name has no $page"
  mandoc -T lint -W warning "$page" || fail "$name.1 is not in order"
  "$program" --version | grep -q -E '[0-9]+\.[0-9]+\.[0-9]+$' || fail "$name --version: no version"
  help=$("$program" --help | options)
  manual=$(sed -n 's/^\.It .*Fl [a-z , ]*-\([a-z-]*\).*/--\1/p; s/^\.It Fl h , -help/--help/p' \
    "$page" | sort -u)
  [[ $help == "$manual" ]] ||
    fail "$name: --help and the manual differ:"$'\n'"$(diff <(echo "$help") <(echo "$manual"))"
  echo "$name: $(wc -l <<< "$help") options"
done
