#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# panda3d for the tests of the preload, which Debian does not have: a Python package in build/panda, for
# all builds of this tree.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tests/preload/install_panda.sh
Installs panda3d by pip in build/panda where it is not, and prints the Python that has it. Needs a
Python package index, the first time only.
TEXT
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  "") ;;
  *) usage >&2; exit 2 ;;
esac

version=1.10.16
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$root/build/panda
python=$folder/bin/python

mkdir -p "$root/build"
exec {lock}> "$folder.lock"  # of two builds that are tested at the same time one installs it
flock "$lock"
is_there() { "$python" -c "import panda3d.ode, dartpy" > /dev/null 2>&1; }
if ! is_there; then
  # With the packages of the system: dartpy is one.
  /usr/bin/python3 -m venv --clear --system-site-packages "$folder" >&2 &&
    "$python" -m pip install --quiet --disable-pip-version-check --retries 1 "panda3d==$version" >&2 &&
    is_there || {
    echo "install_panda: panda3d $version is not in build/panda, and pip does not install it; please" \
      "run tests/preload/install_panda.sh where a Python package index can be reached" >&2
    exit 1
  }
fi
echo "$python"
