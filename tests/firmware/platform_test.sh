#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: platform_test.sh IMAGES: start-up code, linker script, clock, stack mark and trap handler, tested from a
# program that runs under QEMU. 77 = skipped.
set -u
images=$1
run=$(dirname "$0")/run_in_qemu.sh

says() { # FILE LINE
  grep -qx "$2" "$1" || { echo "FAILED: no line '$2' in:"; cat "$1"; exit 1; }
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$run" "$images/platform_probe.elf" >"$work/first"
code=$?
[ $code -ne 77 ] || exit 77
[ $code -eq 3 ] || { echo "FAILED: main's value 3 came out as $code"; cat "$work/first"; exit 1; }
says "$work/first" "constructed 42"
says "$work/first" "zeroes 0"
says "$work/first" "stack 4096"
used=$(awk '$1 == "stack_used_more" { print $2 }' "$work/first")
[ "$used" -ge 768 ] && [ "$used" -le 1152 ] || { echo "FAILED: a block of 1024 bytes moved the stack's mark by $used"; exit 1; }
ticks=$(awk '$1 == "ticks" { print $2 }' "$work/first")
[ "$ticks" -ge 50000 ] && [ "$ticks" -le 50010 ] || { echo "FAILED: waited 50000 ticks, the clock says $ticks"; exit 1; }

"$run" "$images/platform_probe.elf" >"$work/second"
grep -v ticks "$work/first" >"$work/expected"
grep -v ticks "$work/second" | cmp "$work/expected" - || { echo "FAILED: instruction counts differ from run to run"; exit 1; }

"$run" "$images/fault_probe.elf" >"$work/fault"
code=$?
[ $code -eq 70 ] || { echo "FAILED: a fault ended with $code instead of 70"; exit 1; }
grep -q '^fault: mcause 0x00000007 mepc 0x808.* mtval 0x00000004$' "$work/fault" ||
  { echo "FAILED: the fault is not told:"; cat "$work/fault"; exit 1; }
echo "platform: start, data, constructors, clock, stack mark, repeatable counts, fault report"
