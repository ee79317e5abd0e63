#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: tof_frame_test.sh HOST_PROGRAM TARGET_ELF: a depth frame of 640x480 gives the same results on the soft core as
# on the host (compare.py); prints its cost there. 77 = skipped.
set -u
here=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$1" "$work/frame" >"$work/host" || { echo "tof_frame_test: $1 failed"; exit 1; }
"$here/../firmware/run_in_qemu.sh" --seconds "${PHAROS_TARGET_SECONDS:-240}" "$2" \
  -cpu rv32,a=false,c=false,f=false,d=false -m 40M \
  -device loader,file="$work/frame",addr=0x82000000,force-raw=on </dev/null >"$work/target"
code=$?
[ $code -eq 0 ] || { tail -3 "$work/target"; exit $code; }
grep '^count ' "$work/target"
grep -v '^count ' "$work/target" >"$work/results"
"$here/compare.py" "$work/host" "$work/results"
