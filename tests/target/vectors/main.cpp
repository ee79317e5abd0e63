// SPDX-License-Identifier: Apache-2.0
// Prints the core's results for compare.py: built for the host and for the target, from the same sources.
#include "tests/target/vectors/vectors.hpp"

int main() {
  pharos::test::decoder_vectors();
  pharos::test::pose_vectors();
  pharos::test::track_vectors();
}
