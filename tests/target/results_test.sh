#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: results_test.sh HOST_PROGRAM TARGET_ELF: the same sources give the same results on both machines (compare.py).
# 77 = skipped.
set -u
here=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$here/run_tests.sh" "$2" >"$work/target"
code=$?
[ $code -eq 0 ] || { tail -3 "$work/target"; exit $code; }
"$1" >"$work/host" || exit 1
"$here/compare.py" "$work/host" "$work/target"
