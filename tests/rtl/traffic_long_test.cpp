// SPDX-License-Identifier: Apache-2.0
// The random traffic of traffic_test.cpp, with the length of a weekly run.
#include <gtest/gtest.h>

#include "rtl/random_traffic.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint64_t kTicks = 20'000'000;
constexpr std::uint64_t kWrap = std::uint64_t{1} << 32;

class LongTraffic : public testing::TestWithParam<std::uint64_t> {};

TEST_P(LongTraffic, BlockAnswersAsTheReferenceInEveryTick) {
  CaptureRig rig;
  rig.set_ticks(GetParam() * kWrap - kTicks / 2);
  rig.enable();
  RandomTraffic(rig, 1000 + GetParam()).run(kTicks);
  EXPECT_TRUE(rig.agrees());
  EXPECT_GT(rig.model().recorded_edges(), kTicks / 100);
  EXPECT_GT(rig.model().lost_edges(), kTicks / 100);
}

INSTANTIATE_TEST_SUITE_P(Seeds, LongTraffic, testing::Range<std::uint64_t>(1, 4));

}  // namespace
}  // namespace pharos::rtl
