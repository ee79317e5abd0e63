// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/fusion/settings.hpp"

namespace pharos::fusion {

/// T_vehicle_target = T_vehicle_sensor T_sensor_feature T_target_feature^-1 with the measurement's covariance and
/// directions carried along. Directions that were not measured are taken from `reference` where there is one.
TargetMeasurement to_target(const Measurement& measurement, const SourceSettings& source,
                            const Pose<frame::Target, FeatureFrame>& T_target_feature, const TargetPose* reference);

}  // namespace pharos::fusion
