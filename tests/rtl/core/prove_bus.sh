#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: prove_bus.sh SOC [SED...]: proves formal/soc_bus_properties.vh inside pharos_soc of the folder SOC, from every state of its registers, by
# yosys' solver: what holds in a tick and in the one after it holds always. Each SED plants a fault in pharos_soc.v, which must be found.
# 77: a tool is missing.
set -euo pipefail
soc=$1
shift
here=$(cd "$(dirname "$0")" && pwd)
command -v yosys >/dev/null || { echo "skipped: yosys is not installed (tools/install-dependencies test)"; exit 77; }
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cp "$soc"/*.v "$soc"/*.vh "$here"/formal/soc_bus_properties.v* "$work"
sed -i 's/^endmodule/`include "soc_bus_properties.vh"\nendmodule/' "$work/pharos_soc.v"
cp "$work/pharos_soc.v" "$work/sound"

# What the ROM holds is any.
echo 0 >"$work/loader.hex"
cd "$work"
prove() {
  yosys -p "read_verilog -defer -formal -sv *.v; hierarchy -check -top pharos_soc -chparam EXTERNAL 1; cutpoint t:*soc_rom*; proc; flatten;
    rename -top bus; opt_clean; memory -nomap; memory_map; opt -full; sat -verify -seq 2 -prove-skip 1 -set-assumes -prove-asserts bus" >"$work/log" 2>&1
}
prove || { tail -20 "$work/log"; exit 1; }
grep -q "Import proof for assert" "$work/log" || { echo "nothing was proved"; exit 1; }
echo "$(grep -c 'Import proof for assert' "$work/log") properties hold"
for fault in "$@"; do
  sed "$fault" "$work/sound" >"$work/pharos_soc.v"
  ! cmp -s "$work/pharos_soc.v" "$work/sound" || { echo "nothing was planted: $fault"; exit 1; }
  ! prove || { echo "a planted fault was not found: $fault"; exit 1; }
  grep -q "proof did fail" "$work/log" || { tail -5 "$work/log"; exit 1; }
done
echo "$# planted faults are found"
