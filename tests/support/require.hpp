// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

namespace pharos::test {

/// Assertion of a fuzz target: libFuzzer and the replay both report an abort as a failure.
inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace pharos::test
