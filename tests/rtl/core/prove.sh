#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: prove.sh RTL PROPERTIES TICKS [PLANT-FILE PLANT-SED]: proves the properties in formal/PROPERTIES.v of the Verilog in the folder
# RTL for every input: TICKS 0: of combinational logic, by yosys' own solver; else up to so many ticks after start, by yosys-smtbmc
# with z3; CLOCKS:STEPS: of logic on several clocks whose edges come in any order, from registers that are 0, by yosys' solver; INDUCTION:TICKS: at any time, by
# induction over at most so many ticks, whatever products and quotients are. With a planted fault
# (a sed command on one file): fails when it is not found. 77: a tool is missing.
set -euo pipefail
rtl=$1 properties=$2 ticks=$3
here=$(cd "$(dirname "$0")" && pwd)
for tool in yosys yosys-smtbmc z3; do
  command -v $tool >/dev/null || { echo "skipped: $tool is not installed (tools/install-dependencies test)"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cp "$rtl"/*.v "$work"
# Yosys knows no wire of another module by its name: properties of inner wires are read inside the module that the second line names.
inside=$here/formal/$properties.vh
if [ -e "$inside" ]; then
  module=$(sed -n '2s/^.*Read inside \([a-z0-9_]*\).*/\1/p' "$inside")
  sed -i "s|^endmodule|\`include \"$inside\"\nendmodule|" "$work/$module.v"
fi

prove() {
  local read="read_verilog -formal -sv $work/*.v $here/formal/$properties.v; prep -flatten -top $properties"
  if [ "$ticks" = 0 ]; then
    yosys -p "$read; sat -verify -prove-asserts -show-inputs $properties" >"$work/log" 2>&1
  elif [ "${ticks%%:*}" = CLOCKS ]; then
    yosys -p "$read; memory_map; clk2fflogic; opt -full; sat -verify -prove-asserts -set-init-zero -tempinduct-baseonly -maxsteps ${ticks#*:} $properties" \
      >"$work/log" 2>&1
  elif [ "${ticks%%:*}" = INDUCTION ]; then
    yosys -p "${read%%;*}; hierarchy -check -top $properties; cutpoint t:core_multiply t:core_divide; proc; flatten; opt_clean;
      memory -nomap; memory_map; opt -full; sat -verify -prove-asserts -set-assumes -tempinduct -maxsteps ${ticks#*:} $properties" >"$work/log" 2>&1
  else
    yosys -q -p "$read; async2sync; dffunmap; write_smt2 -wires $work/properties.smt2" >"$work/log" 2>&1 || return 2
    yosys-smtbmc -s z3 --noincr -t "$ticks" "$work/properties.smt2" >"$work/log" 2>&1
  fi
}

prove || { tail -20 "$work/log"; exit 1; }
! grep "is used but has no driver\|implicitly declared" "$work/log" || { echo "a property is about nothing"; exit 1; }
echo "$properties hold"
[ $# -gt 3 ] || exit 0
cp "$work/$4" "$work/before"
sed -i "$5" "$work/$4"
! cmp -s "$work/$4" "$work/before" || { echo "nothing was planted in $4"; exit 1; }
if prove; then
  echo "a planted fault was not found: $5"
  exit 1
fi
grep -q "Assert failed\|proof did fail" "$work/log" || { tail "$work/log"; exit 1; }
echo "a planted fault is found"
