// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstddef>

#include "pharos/lighthouse/sweep.hpp"

namespace pharos::test {

/// Field by field: a difference names its field.
inline void expect_equal(const lighthouse::Sweep& a, const lighthouse::Sweep& b) {
  EXPECT_EQ(a.flash.start_ticks, b.flash.start_ticks);
  EXPECT_EQ(a.flash.length_ticks, b.flash.length_ticks);
  EXPECT_EQ(a.flash.station, b.flash.station);
  EXPECT_EQ(a.flash.axis, b.flash.axis);
  EXPECT_EQ(a.flash.data, b.flash.data);
  EXPECT_EQ(a.flash.skip, b.flash.skip);
  EXPECT_EQ(a.flash.sensors, b.flash.sensors);
  EXPECT_EQ(a.period_sixteenth_ticks, b.period_sixteenth_ticks);
  EXPECT_EQ(a.flags, b.flags);
  ASSERT_EQ(a.hits.size(), b.hits.size());
  for (std::size_t i = 0; i < a.hits.size(); ++i) {
    EXPECT_EQ(a.hits[i].sensor, b.hits[i].sensor);
    EXPECT_EQ(a.hits[i].width_ticks, b.hits[i].width_ticks);
    EXPECT_EQ(a.hits[i].centre_half_ticks, b.hits[i].centre_half_ticks);
  }
}

}  // namespace pharos::test
