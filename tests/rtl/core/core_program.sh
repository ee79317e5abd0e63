#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: core_program.sh BUILD PROGRAM: the program of tests/target on the Verilated core. Output and exit code are its own; 77 = skipped.
set -euo pipefail
elf=$1/firmware/bin/$2.elf
[ -r "$elf" ] || { echo "skipped: the images are not built (target firmware)"; exit 77; }
exec "$1/tests/core_program" "$elf"
