// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

namespace pharos::test {

/// What a fuzz target asserts: libFuzzer and the replay both take an abort for a failure.
inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace pharos::test
