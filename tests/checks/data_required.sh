#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: data_required.sh PROGRAM...: no test that needs real data is skipped where they are required. Each
# GoogleTest program runs without data: with PHAROS_REQUIRE_DATA=1 it fails and skips nothing, without it skips.
set -u
export PHAROS_DATA=/nowhere
wrong=0
for program in "$@"; do
  said=$(PHAROS_REQUIRE_DATA=1 "$program" 2>&1) && failed=no || failed=yes
  if [ $failed = no ] || grep -qF '[  SKIPPED ]' <<<"$said"; then
    echo "$program: does not fail without data where PHAROS_REQUIRE_DATA=1"
    wrong=1
  fi
  said=$(PHAROS_REQUIRE_DATA=0 "$program" 2>&1) && failed=no || failed=yes
  if [ $failed = yes ] || ! grep -qF '[  SKIPPED ]' <<<"$said"; then
    echo "$program: is not skipped without data where PHAROS_REQUIRE_DATA=0"
    wrong=1
  fi
done
exit $wrong
