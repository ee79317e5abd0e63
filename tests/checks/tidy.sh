#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: tidy.sh ROOT BUILD_DIR JOBS [REGEX]: clang-tidy 14 over every file of the tree (or those whose path matches
# REGEX), from a tree that is only configured. The same findings stop the build of the preset `tidy`. What passed is
# remembered in BUILD_DIR/passed (tidy.py).
set -u
root=$(realpath "$1")
build=$(realpath -m "$2")
mkdir -p "$build"
cmake -S "$root" -B "$build" --preset tidy -DCMAKE_CXX_CLANG_TIDY= \
  >"$build/configure.log" 2>&1 || { cat "$build/configure.log"; exit 1; }
cmake --build "$build" --target pharos_lcm_generate pharos_commit >/dev/null 2>&1 || true
exec "$(dirname "$0")/tidy.py" "$root" "$build/compile_commands.json" "$build" "$3" \
  "${4:-^$root/(common|firmware|host|tools|tests)/}"
