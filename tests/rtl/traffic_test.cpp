// SPDX-License-Identifier: Apache-2.0
// Random traffic of every kind, compared with the reference model in every tick.
#include <gtest/gtest.h>

#include "rtl/random_traffic.hpp"

namespace pharos::rtl {
namespace {

constexpr std::uint64_t kTicks = 400'000;
constexpr std::uint64_t kWrap = std::uint64_t{1} << 32;

class Traffic : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Traffic, BlockAnswersAsTheReferenceInEveryTick) {
  CaptureRig rig;
  rig.set_ticks(kWrap - kTicks / 2);  // the wrap is in the middle
  rig.enable();
  RandomTraffic(rig, GetParam()).run(kTicks);
  EXPECT_TRUE(rig.agrees());
  // A run without records or without losses would not be a test.
  EXPECT_GT(rig.model().recorded_edges(), 1000u);
  EXPECT_GT(rig.model().lost_edges(), 1000u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Traffic, testing::Range<std::uint64_t>(1, 4));

}  // namespace
}  // namespace pharos::rtl
