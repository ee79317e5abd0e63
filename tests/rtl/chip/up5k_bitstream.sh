#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: up5k_bitstream.sh BUILD: `tools/gateware up5k` makes a bitstream whose clocks are as fast as asked. 77 = skipped.
set -euo pipefail
loader=$1/firmware/bin/up5k_loader.hex
root=$(cd "$(dirname "$0")/../../.." && pwd)
for tool in yosys nextpnr-ice40 icepack icetime; do
  command -v $tool >/dev/null || { echo "skipped: $tool is not installed (tools/install-dependencies full)"; exit 77; }
done
[ -r "$loader" ] || { echo "skipped: the images are not built (target firmware)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$root/tools/gateware" up5k --output "$work" --loader "$loader"
[ "$(stat -c %s "$work/up5k.bin")" -ge 100000 ] || { echo "FAILED: no bitstream"; exit 1; }
