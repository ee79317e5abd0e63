// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/source_view.hpp"

namespace pharos::fusion {
namespace {

// Moved along what was not measured towards the pose that `reference` means for this sensor: in the sensor's frame,
// where a rotation about the feature's axis moves nothing else.
SensorPose completed_in_sensor(const SensorPose& pose, const Directions& directions, const SensorPose& reference) {
  const auto rows = directions.rows.topRows(directions.rank);
  SensorPose out = pose;
  for (int step = 0; step < 4; ++step) {
    const Vector6 delta = pose_difference(reference, out);
    out = out.moved_by(delta - rows.transpose() * (rows * delta));
  }
  return out;
}

// Orthonormal rows with the same span.
void orthonormalise(Directions& directions) {
  for (int i = 0; i < directions.rank; ++i) {
    for (int j = 0; j < i; ++j) {
      directions.rows.row(i) -= directions.rows.row(i).dot(directions.rows.row(j)) * directions.rows.row(j);
    }
    directions.rows.row(i).normalize();
  }
}

}  // namespace

TargetMeasurement to_target(const Measurement& m, const SourceSettings& source,
                            const Pose<frame::Target, FeatureFrame>& T_target_feature, const TargetPose* reference) {
  const Pose<FeatureFrame, frame::Target> T_feature_target = T_target_feature.inverse();
  SensorPose pose = m.pose;
  if (reference != nullptr && m.directions.rank < 6) {
    pose = completed_in_sensor(pose, m.directions, source.T_vehicle_sensor.inverse() * (*reference * T_target_feature));
  }
  TargetMeasurement out;
  out.time_ns = m.time_ns;
  out.source = m.source;
  out.time_sigma_s = m.time_sigma_s;
  out.pose = source.T_vehicle_sensor * pose * T_feature_target;
  if (m.second) out.second = source.T_vehicle_sensor * *m.second * T_feature_target;
  // Error in V of an error in S: the arm from the feature to the target turns with the rotation's error.
  const Matrix3& R = source.T_vehicle_sensor.R;
  const Matrix3 arm = skew(pose.R * T_feature_target.t);
  Matrix6 to_vehicle = Matrix6::Zero();
  to_vehicle.topLeftCorner<3, 3>() = R;
  to_vehicle.bottomLeftCorner<3, 3>() = -R * arm;
  to_vehicle.bottomRightCorner<3, 3>() = R;
  out.covariance = to_vehicle * m.covariance * to_vehicle.transpose();
  Matrix6 to_sensor = Matrix6::Zero();
  to_sensor.topLeftCorner<3, 3>() = R.transpose();
  to_sensor.bottomLeftCorner<3, 3>() = arm * R.transpose();
  to_sensor.bottomRightCorner<3, 3>() = R.transpose();
  out.directions.rank = m.directions.rank;
  if (m.directions.rank == 6) return out;
  out.directions.rows.setZero();
  out.directions.rows.topRows(m.directions.rank) = m.directions.rows.topRows(m.directions.rank) * to_sensor;
  orthonormalise(out.directions);
  return out;
}

}  // namespace pharos::fusion
