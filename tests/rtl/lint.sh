#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: lint.sh VERILOG...: fails when Verilator warns about the capture logic at any supported width, and
# when it does not warn about a latch planted in it.
set -u
if ! command -v verilator >/dev/null; then
  echo "skipped: verilator is not installed (tools/install-dependencies test)"
  exit 77
fi
for inputs in 1 4 8 12 16 24 31 32; do
  for depth in 2 512 4096; do
    verilator --lint-only -Wall -GINPUTS=$inputs -GDEPTH=$depth --top-module pharos_capture "$@" || exit 1
  done
done

planted=$(mktemp -d)
trap 'rm -r "$planted"' EXIT
cp "$@" "$planted"
sed -i "/^    answer = 32'd0;\$/d" "$planted/capture_queue.v"
if verilator --lint-only -Wall --top-module pharos_capture "$planted"/*.v >/dev/null 2>&1; then
  echo "a planted latch was not found"
  exit 1
fi
