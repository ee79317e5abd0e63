#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: run_tests.sh ELF: runs a program under QEMU on a core with RV32IM only (a floating-point or
# compressed instruction is a fault). Its output and exit code are ours; 77 = skipped.
exec "$(dirname "$0")/../firmware/run_in_qemu.sh" --seconds 240 "$1" -cpu rv32,a=false,c=false,f=false,d=false </dev/null
