#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The contacts of a run are the same bytes again, on one device thread and on two, and whatever the
# launches were predicted to be. PoCL reads its thread count once a process, hence a script.
set -euo pipefail

program=${1:?usage: tests/demos/same_hash_test.sh <falling_objects>}

contact_hash() {
  "$program" --objects 40 --steps 60 --quiet "$@" | sed -n 's/^ *contact hash *//p'
}

expected=$(contact_hash)
[[ -n $expected ]] || { echo "no contact hash was printed" >&2; exit 1; }
[[ $(contact_hash --seed 2) != "$expected" ]] || { echo "another scene has the same hash" >&2; exit 1; }

same() {
  [[ $2 == "$expected" ]] || { echo "$1: $2, expected $expected" >&2; exit 1; }
  echo "$1: $2"
}
same "once more" "$(contact_hash)"
same "one thread" "$(POCL_MAX_PTHREAD_COUNT=1 POCL_CPU_MAX_CU_COUNT=1 contact_hash)"
same "two threads" "$(POCL_MAX_PTHREAD_COUNT=2 POCL_CPU_MAX_CU_COUNT=2 contact_hash)"
same "exact workload" "$(contact_hash --config workload=exact)"
same "under-predicted" "$(contact_hash --config confidence=0.01)"

# Sheets, which two threads solve: long enough for them to lie on objects and on each other.
sheet_hash() {
  "$program" --scene rigid-deformable --objects 4 --sheets 10 --steps 120 --quiet |
    sed -n 's/^ *contact hash *//p'
}
expected=$(sheet_hash)
[[ -n $expected ]] || { echo "no contact hash was printed with sheets" >&2; exit 1; }
same "sheets once more" "$(sheet_hash)"
same "sheets on one thread" "$(POCL_MAX_PTHREAD_COUNT=1 POCL_CPU_MAX_CU_COUNT=1 sheet_hash)"
