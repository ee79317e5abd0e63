#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: rv32_link.sh ROOT BUILD_DIR [headers]: compiles and links the whole portable core for the soft core's instruction
# set, where neither heap nor C++ library exists, and shows that each planted violation breaks that link. 77 = skipped.
# headers: compiles every header by itself instead.
# BUILD_DIR is a tree of the preset rv32im, created where there is none; the firmware's build tree may be used.
set -u
root=$1
build=$2
mkdir -p "$build"
if ! command -v riscv64-unknown-elf-gcc >/dev/null; then
  echo "skipped: riscv64-unknown-elf-gcc is not installed (tools/install-dependencies test)"
  exit 77
fi

cmake -S "$root" -B "$build" --preset rv32im >"$build/configure.log" 2>&1 || { cat "$build/configure.log"; exit 1; }
link() { cmake --build "$build" --target "$1"; }

if [ "${3-}" = headers ]; then
  link pharos_core_header_units
  exit
fi
link pharos_core_link || exit 1
echo "largest stack frames, bytes:"
find "$build/common" -name '*.su' -exec cat {} + | awk -F '\t' '{print $2 "\t" $1}' | sort -rn | head -5

declare -A expected=([heap]=__wrap_malloc [new]='operator new' [clock]=__wrap_time [static]='__wrap_atexit\|__cxa_atexit')
for plant in "${!expected[@]}"; do
  if link "pharos_core_link_$plant" >"$build/plant.log" 2>&1; then
    echo "FAILED: the link check did not notice the planted $plant"
    exit 1
  fi
  grep -q "undefined reference to.*\(${expected[$plant]}\)" "$build/plant.log" ||
    { cat "$build/plant.log"; echo "FAILED: the planted $plant broke the build for another reason"; exit 1; }
  echo "planted $plant: link refused, as it must be"
done
