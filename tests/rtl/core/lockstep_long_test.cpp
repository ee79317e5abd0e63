// SPDX-License-Identifier: Apache-2.0
// The comparison of lockstep_test.cpp over ten million instructions.
#include <gtest/gtest.h>

#include "rtl/core/lockstep.hpp"

namespace pharos::rtl {
namespace {

class LongLockstep : public testing::TestWithParam<std::uint64_t> {};

TEST_P(LongLockstep, AgreesWithTheModelAfterEveryRandomInstruction) {
  Lockstep bench(GetParam());
  ASSERT_TRUE(bench.run_random(2'500'000)) << bench.difference();
  EXPECT_GT(bench.interrupts(), 500u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, LongLockstep, testing::Range<std::uint64_t>(100, 104));

}  // namespace
}  // namespace pharos::rtl
