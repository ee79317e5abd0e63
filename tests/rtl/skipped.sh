#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: skipped.sh WHY: what a test does that cannot run here.
echo "skipped: $1"
exit 77
