// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/mounting/hand_eye_start.hpp"

#include <algorithm>
#include <cmath>

#include "host/linear/dense.hpp"
#include "pharos/geometry/rotation.hpp"
#include "pharos/geometry/symmetric.hpp"

namespace pharos::calibrate {
namespace {

constexpr std::size_t kMinPoses = 10;
constexpr std::size_t kMaxPoses = 300;  // of the start; more tell no better where to begin
constexpr double kSearchStep_s = 0.025;
// Second smallest over largest singular value of the rotations' equations: below, more than one rotation fits.
constexpr double kMinSeparation = 1e-4;

struct Pair {
  host::VehicleFromTarget target;
  const host::SourceRow* row = nullptr;
};

// Poses with the turn tell the rotations alone where there are enough of them.
bool mostly_with_turn(const std::vector<host::SourceRow>& rows) {
  std::size_t with_turn = 0;
  for (const host::SourceRow& row : rows) with_turn += row.has_turn ? 1 : 0;
  return 2 * with_turn > rows.size();
}

std::vector<Pair> pairs_of(const std::vector<TimedTarget>& target, const std::vector<host::SourceRow>& rows,
                           double offset_s) {
  std::vector<Pair> pairs;
  const bool turn = mostly_with_turn(rows);
  const std::size_t step = std::max<std::size_t>(1, rows.size() / kMaxPoses);
  for (std::size_t i = 0; i < rows.size(); i += step) {
    if (rows[i].second || (turn && !rows[i].has_turn)) continue;
    const auto pose = target_at(target, rows[i].time_s + offset_s, kMaxPathGap_s);
    if (pose) pairs.push_back({*pose, &rows[i]});
  }
  return pairs;
}

struct Rotations {
  Matrix3 vehicle_sensor, target_feature;
};

// [I (x) R_A, -(R_B^T (x) I)] [vec R_Y; vec R_X] = 0: 9 rows a pose.
std::optional<Rotations> full_rotations(const std::vector<Pair>& pairs) {
  using Matrix18 = Eigen::Matrix<double, 18, 18>;
  Matrix18 normal = Matrix18::Zero();
  for (const Pair& pair : pairs) {
    Eigen::Matrix<double, 9, 18> row = Eigen::Matrix<double, 9, 18>::Zero();
    for (int j = 0; j < 3; ++j) {
      row.block<3, 3>(3 * j, 3 * j) = pair.target.R;
      for (int k = 0; k < 3; ++k) row.block<3, 3>(3 * j, 9 + 3 * k) = -pair.row->pose.R(k, j) * Matrix3::Identity();
    }
    normal += row.transpose() * row;
  }
  const host::DenseEigen eigen = host::dense_eigen(normal);
  if (!(eigen.values[1] > kMinSeparation * eigen.values[17])) return std::nullopt;
  const Eigen::Matrix<double, 18, 1> v = eigen.vectors.col(0);
  Matrix3 Y = Eigen::Map<const Matrix3>(v.data()), X = Eigen::Map<const Matrix3>(v.data() + 9);
  if (X.determinant() < 0.0) {
    X = -X;
    Y = -Y;
  }
  return Rotations{host::nearest_rotation(X).R, host::nearest_rotation(Y).R};
}

// [R_A, -(n_B^T (x) I)] [y; vec R_X] = 0, y the feature's axis in the target frame: 3 rows a pose.
std::optional<Rotations> axis_rotations(const std::vector<Pair>& pairs) {
  using Matrix12 = Eigen::Matrix<double, 12, 12>;
  Matrix12 normal = Matrix12::Zero();
  for (const Pair& pair : pairs) {
    Eigen::Matrix<double, 3, 12> row;
    row.leftCols<3>() = pair.target.R;
    for (int k = 0; k < 3; ++k) row.block<3, 3>(0, 3 + 3 * k) = -pair.row->pose.R(k, 2) * Matrix3::Identity();
    normal += row.transpose() * row;
  }
  const host::DenseEigen eigen = host::dense_eigen(normal);
  if (!(eigen.values[1] > kMinSeparation * eigen.values[11])) return std::nullopt;
  const Eigen::Matrix<double, 12, 1> v = eigen.vectors.col(0);
  Matrix3 X = Eigen::Map<const Matrix3>(v.data() + 3);
  Vector3 axis = v.head<3>();
  if (X.determinant() < 0.0) {
    X = -X;
    axis = -axis;
  }
  const Matrix3 turn = rotation_between(Vector3::UnitZ(), axis);
  return Rotations{host::nearest_rotation(X).R, turn};
}

}  // namespace

std::optional<host::VehicleFromTarget> target_at(const std::vector<TimedTarget>& path, double time_s,
                                                 double max_gap_s) {
  const auto after = std::upper_bound(path.begin(), path.end(), time_s,
                                      [](double time, const TimedTarget& pose) { return time < pose.time_s; });
  if (after == path.begin() || after == path.end()) return std::nullopt;
  const TimedTarget &a = *(after - 1), &b = *after;
  const double span_s = b.time_s - a.time_s;
  if (!(span_s > 0.0) || span_s > max_gap_s) return std::nullopt;
  const double u = (time_s - a.time_s) / span_s;
  return host::VehicleFromTarget{rotation_exp(u * rotation_log(b.pose.R * a.pose.R.transpose())) * a.pose.R,
                                 (1.0 - u) * a.pose.t + u * b.pose.t};
}

std::optional<HandEyeStart> hand_eye_start(const std::vector<TimedTarget>& target,
                                           const std::vector<host::SourceRow>& rows, double time_offset_s) {
  const std::vector<Pair> pairs = pairs_of(target, rows, time_offset_s);
  if (pairs.size() < kMinPoses) return std::nullopt;
  const auto rotations = mostly_with_turn(rows) ? full_rotations(pairs) : axis_rotations(pairs);
  if (!rotations) return std::nullopt;
  // R_A t_Y - t_X = R_X t_B - t_A.
  Matrix6 normal = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  for (const Pair& pair : pairs) {
    Eigen::Matrix<double, 3, 6> row;
    row << pair.target.R, -Matrix3::Identity();
    normal += row.transpose() * row;
    right += row.transpose() * (rotations->vehicle_sensor * pair.row->pose.t - pair.target.t);
  }
  const Vector6 shift = solve_symmetric<6>(normal, right);
  if (!shift.allFinite()) return std::nullopt;
  HandEyeStart start{
      {rotations->vehicle_sensor, shift.tail<3>()}, {rotations->target_feature, shift.head<3>()}, time_offset_s, 0.0};
  for (const Pair& pair : pairs) {
    const Vector3 error = pair.target * start.T_target_feature.t - start.T_vehicle_sensor * pair.row->pose.t;
    start.rms_m += error.squaredNorm() / static_cast<double>(pairs.size());
  }
  start.rms_m = std::sqrt(start.rms_m);
  return start;
}

std::optional<HandEyeStart> search_hand_eye_start(const std::vector<TimedTarget>& target,
                                                  const std::vector<host::SourceRow>& rows, double max_offset_s) {
  std::optional<HandEyeStart> best;
  const auto steps = static_cast<int>(std::ceil(max_offset_s / kSearchStep_s));
  for (int i = -steps; i <= steps; ++i) {
    const auto start = hand_eye_start(target, rows, i * kSearchStep_s);
    if (start && (!best || start->rms_m < best->rms_m)) best = start;
  }
  return best;
}

Vector3 excitation_rad(const std::vector<TimedTarget>& target) {
  if (target.empty()) return Vector3::Zero();
  Matrix3 mean = Matrix3::Zero();
  for (const TimedTarget& pose : target) mean += pose.pose.R;
  const Matrix3 centre = host::nearest_rotation(mean).R;
  Matrix3 scatter = Matrix3::Zero();
  for (const TimedTarget& pose : target) {
    const Vector3 turn = rotation_log(pose.pose.R * centre.transpose());
    scatter += turn * turn.transpose() / static_cast<double>(target.size());
  }
  return symmetric_eigen<3>(scatter).values.reverse().cwiseMax(0.0).cwiseSqrt();
}

}  // namespace pharos::calibrate
