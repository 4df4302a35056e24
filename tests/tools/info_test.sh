#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# ode_ext-info lists the devices, says which one is taken and why, and lists the settings.
set -euo pipefail

info=${1:?usage: tests/tools/info_test.sh <ode_ext-info>}

fail() {
  echo "info: $*" >&2
  exit 1
}

devices=$("$info")
grep -q -E '^ *(\* *)?0  cpu ' <<< "$devices" || fail "lists no device 0: $devices"
grep -q "default order GPU, accelerator, CPU" <<< "$devices" || fail "does not say why: $devices"
grep -q "^a collider works on " <<< "$devices" || fail "tries none: $devices"
grep -q 'ODE_EXT_DEVICE="cpu"' <<< "$(ODE_EXT_DEVICE=:cpu: "$info" | sed 's/:cpu:/cpu/')" ||
  fail "does not say that the environment chose"

code=0
none=$(ODE_EXT_DEVICE=nosuch "$info") || code=$?
[[ $code -eq 3 ]] || fail "exit code $code without a device"
[[ $(grep -c 'matches "nosuch"' <<< "$none") -eq 1 ]] || fail "says not once what matches nothing"

for argument in "" --settings; do
  code=0
  said=$("$info" $argument 2>&1 > /dev/full) || code=$?
  [[ $code -eq 2 && $said == *"the list could not be written"* ]] ||
    fail "a list that is lost ($argument): exit $code, $said"
done

kept=$(mktemp)
trap 'rm -f "$kept"' EXIT
echo "of another program" > "$kept"
ODE_EXT_CAPTURE=$kept ODE_EXT_TRACE=$kept "$info" > /dev/null
[[ $(cat "$kept") == "of another program" ]] || fail "begins the capture of another program anew"

settings=$("$info" --settings)
for name in rays edges organization deformable_target workload prediction misprediction; do
  grep -q "^$name = " <<< "$settings" || fail "--settings lacks $name"
done
echo "info: $(grep -c ' = ' <<< "$settings") settings"
