#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: consumers_test.sh BUILD_DIR PYTHON | consumers_test.sh --installed PYTHON
# Programs outside of Pharos, from what was installed alone (into a folder, or, --installed, on this computer): the core by
# find_package and by pkg-config, and every example of SUBSCRIBER.md.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
python=$2
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
fail() { echo "consumers: $*" >&2; exit 1; }
quietly() { "$@" >"$root/log" 2>&1 || { cat "$root/log" >&2; fail "$* failed"; }; }

prefix=/usr
if [ "$1" != --installed ]; then
  prefix=$root/usr
  quietly cmake --install "$1" --prefix "$prefix"
  export CMAKE_PREFIX_PATH=$prefix PKG_CONFIG_PATH=$prefix/lib/pkgconfig PYTHONPATH=$1/python
fi

quietly cmake -S "$here/consumer" -B "$root/consumer" -G Ninja
quietly cmake --build "$root/consumer"
"$root/consumer/consumer" || fail "the pose is wrong"
if grep -rq "$(realpath "$here/../..")/common" "$root/consumer/build.ninja"; then fail "the source tree was used"; fi
# shellcheck disable=SC2046
quietly "${CXX:-g++}" -std=c++20 "$here/consumer/consumer.cpp" $(pkg-config --cflags --libs pharos) -o "$root/by_pkg_config"
"$root/by_pkg_config" || fail "the pose is wrong by pkg-config"

"$python" -B "$here/subscriber_examples_test.py" "$here/../../SUBSCRIBER.md" "$root/examples"
