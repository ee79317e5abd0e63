#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: run_in_qemu.sh [--seconds N] ELF [QEMU-OPTION...]
#
# Runs a program for the soft core under qemu-system-riscv32 with repeatable instruction counts. Its UART is standard
# input and output; its exit code is ours. 124: still running after N seconds (60); 77: no QEMU here.
set -u
seconds=60
if [ "${1:-}" = --seconds ]; then
  seconds=$2
  shift 2
fi
[ $# -ge 1 ] || { sed -n '3,6s/^# \{0,1\}//p' "$0" >&2; exit 2; }
elf=$1
shift
[ -r "$elf" ] || { echo "run_in_qemu: cannot read $elf (build the target firmware)" >&2; exit 2; }
if ! command -v qemu-system-riscv32 >/dev/null; then
  echo "skipped: qemu-system-riscv32 is not installed (tools/install-dependencies test)" >&2
  exit 77
fi
exec timeout --kill-after=5 "$seconds" qemu-system-riscv32 -M virt -smp 1 -m 32M -bios none -nodefaults -display none \
  -serial stdio -icount shift=0,sleep=off -device loader,file="$elf",cpu-num=0 "$@"
