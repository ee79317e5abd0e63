// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/paper_target.hpp"

#include <gtest/gtest.h>

#include "host/table/target_file.hpp"

namespace pharos::tools {
namespace {

TEST(PaperTarget, IsTheOneOfTheScenarios) {
  const Target built_in = paper_target();
  const Target file = host::read_target(std::string(PHAROS_SOURCE_DIR) + "/tools/sim/scenarios/target12.csv").target;
  ASSERT_EQ(built_in.size(), file.size());
  for (const SensorPlacement& expected : file) {
    const SensorPlacement* sensor = find_sensor(built_in, expected.sensor);
    ASSERT_NE(sensor, nullptr);
    EXPECT_LT((sensor->position_m - expected.position_m).norm(), 1e-12) << int{expected.sensor};
    EXPECT_LT((sensor->normal - expected.normal).norm(), 1e-8) << int{expected.sensor};
  }
}

}  // namespace
}  // namespace pharos::tools
