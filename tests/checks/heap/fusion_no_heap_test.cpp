// SPDX-License-Identifier: Apache-2.0
// The fusion of two sources, with late measurements and an exclusion, under the guard.
#include <gtest/gtest.h>

#include <memory>

#include "pharos/fusion/target_estimator.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pharos::fusion {
namespace {

constexpr std::int64_t kStep_ns = 10'000'000;

Settings two_sources() {
  Settings settings;
  settings.sources.push_back(SourceSettings{});
  settings.sources.push_back(SourceSettings{});
  return settings;
}

// A target at rest; tenths of a millimetre of deterministic noise, so that no pose repeats.
Measurement pose_at(std::int64_t time_ns, std::uint8_t source) {
  Measurement m;
  m.time_ns = time_ns;
  m.source = source;
  m.covariance = Matrix6::Identity() * 1e-6;
  m.pose.t = Vector3(1e-4 * static_cast<double>(time_ns / kStep_ns % 7), 0.0, 2.0);
  return m;
}

TEST(NoHeap, FromPosesToTheFusedState) {
  const Settings settings = two_sources();
  const auto estimator = std::make_unique<TargetEstimator>(settings);
  std::size_t valid = 0;

  const test::AllocationGuard guard;
  for (std::int64_t k = 1; k < 200; ++k) {
    estimator->push(pose_at(k * kStep_ns, 0));
    // The second source is five steps late, and wrong in the end.
    Measurement late = pose_at((k - 5) * kStep_ns + kStep_ns / 2, 1);
    if (k > 150) late.pose.t.x() += 0.2;
    estimator->push(late);
    valid += estimator->state(k * kStep_ns).valid ? 1U : 0U;
  }
  const std::size_t allocations = guard.allocations();

  EXPECT_EQ(allocations, 0u);
  EXPECT_GT(valid, 180u);
  EXPECT_GT(estimator->late(), 150u);
  EXPECT_GT(estimator->counters().gated, 3u);
}

}  // namespace
}  // namespace pharos::fusion
