// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "pharos/lighthouse/ootx_payload.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/report/reports.hpp"
#include "support/equal_sweeps.hpp"

namespace pharos::report::test {

/// A sweep as the decoder may return it.
inline lighthouse::Sweep random_sweep(std::mt19937_64& random, std::size_t hits) {
  lighthouse::Sweep sweep;
  sweep.flash.start_ticks = static_cast<std::int64_t>(random() % (std::uint64_t{1} << 50));
  sweep.flash.length_ticks = static_cast<std::int32_t>(2600 + random() % 4901);
  sweep.flash.station = static_cast<std::uint8_t>(random() % 2);
  sweep.flash.axis = static_cast<Axis>(random() % 2);
  sweep.flash.data = random() % 2 == 1;
  sweep.flash.skip = random() % 2 == 1;
  sweep.flash.sensors = static_cast<std::uint8_t>(random() % 33);
  sweep.period_sixteenth_ticks = static_cast<std::uint32_t>(13'320'000 + random() % 26'667);
  sweep.flags = static_cast<std::uint8_t>(random() % 8);
  for (std::size_t i = 0; i < hits; ++i) {
    lighthouse::Hit hit;
    hit.sensor = static_cast<std::uint8_t>(random() % 32);
    hit.width_ticks = static_cast<std::uint16_t>(16 + random() % 2584);
    hit.centre_half_ticks = static_cast<std::int32_t>(120'000 + random() % 540'001);
    sweep.hits.push_back(hit);
  }
  return sweep;
}

inline LighthousePoseEstimate random_estimate(std::mt19937_64& random, bool second) {
  std::normal_distribution<double> normal;
  const auto draw_pose = [&] {
    LighthouseFromBody pose;
    pose.R = Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
    pose.t = Vector3(normal(random), normal(random), 3.0 + normal(random));
    return pose;
  };
  LighthousePoseEstimate estimate;
  estimate.pose = draw_pose();
  Matrix6 factor;
  for (int i = 0; i < 36; ++i) factor(i) = 1e-3 * normal(random);
  estimate.covariance = factor * factor.transpose();
  estimate.residual_rms = 4.2e-5;
  estimate.observations = 17;
  estimate.iterations = 4;
  estimate.adop_deg_per_rad = 2345.6;
  estimate.pdop_m_per_rad = 45.6;
  estimate.time_ns = 20 * 123'456'789'012;
  if (second) estimate.second = {draw_pose(), 3.25};
  return estimate;
}

using pharos::test::expect_equal;

}  // namespace pharos::report::test
