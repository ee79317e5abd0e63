// SPDX-License-Identifier: Apache-2.0
#include "tools/support/stations.hpp"

#include <gtest/gtest.h>

#include <string_view>

namespace pharos::tools {
namespace {

// The worked payload of a real station, BEC08E38.
constexpr std::string_view kPayload = "063d388ec0befb23e428e20c981802096297009781fd093ab508be5a1ce69d0100";

lighthouse::OotxPayload payload_of(std::uint8_t station, std::string_view hex) {
  lighthouse::OotxPayload payload;
  payload.station = station;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    payload.bytes.push_back(static_cast<std::uint8_t>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
  }
  return payload;
}

TEST(Stations, KnowTheIdAtOnceAndTheCalibrationWhenItCameTwice) {
  Stations stations;
  EXPECT_EQ(stations.id(0), std::nullopt);
  EXPECT_FALSE(stations.push(payload_of(0, kPayload)));
  EXPECT_EQ(stations.id(0), 0xBEC08E38u);
  EXPECT_EQ(stations.calibration(0), nullptr);
  EXPECT_TRUE(stations.push(payload_of(0, kPayload)));
  ASSERT_NE(stations.calibration(0), nullptr);
  EXPECT_NEAR(stations.calibration(0)->rotor[0].phase_rad, 0.015587, 1e-6);
  EXPECT_FALSE(stations.complete());
  EXPECT_EQ(stations.id(1), std::nullopt);
  stations.push(payload_of(1, kPayload));
  stations.push(payload_of(1, kPayload));
  EXPECT_TRUE(stations.complete());
}

TEST(Stations, RejectWhatHasNoFields) {
  Stations stations;
  EXPECT_FALSE(stations.push(payload_of(0, "063d38")));
  EXPECT_EQ(stations.id(0), std::nullopt);
}

}  // namespace
}  // namespace pharos::tools
