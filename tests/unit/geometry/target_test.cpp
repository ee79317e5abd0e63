// SPDX-License-Identifier: Apache-2.0
#include "pharos/geometry/target.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pharos {
namespace {

Target make_target(std::initializer_list<Vector3> positions) {
  Target target;
  std::uint8_t number = 0;
  for (const Vector3& p : positions) target.push_back({number++, p, Vector3::UnitZ()});
  return target;
}

TEST(CheckTarget, AcceptsASolidTarget) {
  const auto shape = check_target(make_target({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}}));
  ASSERT_TRUE(shape.ok());
  EXPECT_EQ(shape->sensors, 4u);
  EXPECT_FALSE(shape->coplanar);
}

TEST(CheckTarget, MarksACoplanarTargetWhateverItsTilt) {
  EXPECT_TRUE(check_target(make_target({{0, 0, 0.3}, {0.1, 0, 0.4}, {0, 0.1, 0.3}, {0.1, 0.1, 0.4}}))->coplanar);
}

TEST(CheckTarget, RefusesWhatCannotCarryAPose) {
  EXPECT_EQ(check_target(make_target({{0, 0, 0}, {1, 0, 0}})).error(), TargetError::kTooFewSensors);
  EXPECT_EQ(check_target(make_target({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}})).error(), TargetError::kCollinear);
  EXPECT_EQ(check_target(make_target({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0.00005}})).error(),
            TargetError::kDuplicatePosition);
  Target doubled = make_target({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  doubled[2].sensor = 0;
  EXPECT_EQ(check_target(doubled).error(), TargetError::kDuplicateNumber);
  Target large = make_target({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  large[1].sensor = 32;
  EXPECT_EQ(check_target(large).error(), TargetError::kSensorNumberTooLarge);
  Target nan = make_target({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  nan[1].position_m.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check_target(nan).error(), TargetError::kNotFinite);
}

TEST(FindSensor, KnowsGapsInTheNumbers) {
  Target target = make_target({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  target[2].sensor = 7;
  ASSERT_NE(find_sensor(target, 7), nullptr);
  EXPECT_EQ(find_sensor(target, 2), nullptr);
}

}  // namespace
}  // namespace pharos
