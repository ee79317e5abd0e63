#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: format.sh ROOT: fails when clang-format 14 would change a C++ file; 77 (skip) without clang-format 14.
set -u
cd "$1" || exit 2
if ! command -v clang-format-14 >/dev/null; then
  echo "skipped: clang-format-14 is not installed (tools/install-dependencies test)"
  exit 77
fi
wrong=$(find common firmware host tools tests \( -name '*.hpp' -o -name '*.cpp' -o -name '*.h' -o -name '*.c' \) -print0 |
  xargs -0 --no-run-if-empty clang-format-14 --dry-run 2>&1 | grep -o '^[^: ]*:[0-9]*' | sort -t: -k1,1 -u)
[ -z "$wrong" ] && exit 0
echo "not as clang-format-14 writes them (mend with clang-format-14 -i FILE):"
echo "$wrong"
exit 1
