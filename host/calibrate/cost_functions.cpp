// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/cost_functions.hpp"

#include <cmath>

#include "pharos/lighthouse/station_model.hpp"

namespace pharos::calibrate {
namespace {

template <int Rows, int Columns>
using RowMajor = Eigen::Matrix<double, Rows, Columns, (Columns == 1 ? Eigen::ColMajor : Eigen::RowMajor)>;
using ConstVector3 = Eigen::Map<const Vector3>;
using ConstVector6 = Eigen::Map<const Vector6>;

// Below this the sensor is beside or behind the station, where the angle is undefined.
constexpr double kNearest_m = 0.05;
// Step of the central differences of the station model: far above rounding, and its third derivative times step^2 is
// negligible.
constexpr double kStep_rad = 1e-5;
// Sigma of the rows that fix the frame: a thousandth of what any bearing gives (some micrometres).
constexpr double kFrame_m = 1e-8;

// J of exp([phi + d]x) = exp([J d]x) exp([phi]x).
Matrix3 left_jacobian(const Vector3& phi) {
  const double square = phi.squaredNorm();
  const Matrix3 cross = skew(phi);
  if (square < 1e-10) return Matrix3::Identity() + 0.5 * cross;
  const double angle = std::sqrt(square);
  return Matrix3::Identity() + (1.0 - std::cos(angle)) / square * cross +
         (angle - std::sin(angle)) / (square * angle) * cross * cross;
}

class BearingCost final : public ceres::CostFunction {
 public:
  explicit BearingCost(const BearingRow& row) : row_(row) {
    set_num_residuals(1);
    *mutable_parameter_block_sizes() = {static_cast<int>(kRotorParameters), 6, 3, 1};
    if (row.T_reference_station) mutable_parameter_block_sizes()->push_back(6);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    RotorParameters rotor;
    std::copy_n(blocks[0], kRotorParameters, rotor.begin());
    const ConstVector6 pose_delta(blocks[1]);
    const ConstVector3 p_body(blocks[2]);
    const Vector3 lever = rotation_exp(pose_delta.head<3>()) * (row_.T_home_body.R * p_body);
    const Vector3 p_home = lever + row_.T_home_body.t + pose_delta.tail<3>();
    Matrix3 R_station_home = Matrix3::Identity();
    Vector3 p_station = p_home;
    if (row_.T_reference_station) {
      const ReferenceFromStation T = row_.T_reference_station->moved_by(ConstVector6(blocks[4]));
      R_station_home = T.R.transpose();
      p_station = R_station_home * (p_home - T.t);
    }
    if (p_station.z() < kNearest_m) return false;
    residuals[0] = (row_.raw_rad - blocks[3][0] - model(rotor, p_station)) / row_.sigma_rad;
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) by_rotor(rotor, p_station, jacobians[0]);
    const Eigen::RowVector3d by_point = -model_by_point(rotor, p_station) / row_.sigma_rad;
    const Eigen::RowVector3d by_home = by_point * R_station_home;
    if (jacobians[1] != nullptr) {
      Eigen::Map<RowMajor<1, 6>> out(jacobians[1]);
      out.head<3>() = -by_home * skew(lever) * left_jacobian(pose_delta.head<3>());
      out.tail<3>() = by_home;
    }
    if (jacobians[2] != nullptr) {
      Eigen::Map<RowMajor<1, 3>> out(jacobians[2]);
      out = by_home * rotation_exp(pose_delta.head<3>()) * row_.T_home_body.R;
    }
    if (jacobians[3] != nullptr) jacobians[3][0] = -1.0 / row_.sigma_rad;
    if (row_.T_reference_station && jacobians[4] != nullptr) by_station(blocks[4], p_home, by_point, jacobians[4]);
    return true;
  }

 private:
  double model(const RotorParameters& rotor, const Vector3& p_station) const {
    lighthouse::StationCalibration station;
    station.rotor[static_cast<std::size_t>(index_of(row_.axis))] = rotor_of(rotor);
    return lighthouse::raw_theta(station, row_.form, row_.axis, p_station);
  }

  void by_rotor(const RotorParameters& rotor, const Vector3& p_station, double* out) const {
    for (std::size_t i = 0; i < kRotorParameters; ++i) {
      RotorParameters more = rotor;
      RotorParameters less = rotor;
      more[i] += kStep_rad;
      less[i] -= kStep_rad;
      out[i] = -(model(more, p_station) - model(less, p_station)) / (2.0 * kStep_rad * row_.sigma_rad);
    }
  }

  Eigen::RowVector3d model_by_point(const RotorParameters& rotor, const Vector3& p) const {
    const double step = kStep_rad * p.norm();
    Eigen::RowVector3d out;
    for (Eigen::Index i = 0; i < 3; ++i) {
      out[i] = (model(rotor, p + step * Vector3::Unit(i)) - model(rotor, p - step * Vector3::Unit(i))) / (2.0 * step);
    }
    return out;
  }

  // p_station = R0^T exp(-phi) (p_home - t0 - dt).
  void by_station(const double* delta, const Vector3& p_home, const Eigen::RowVector3d& by_point, double* out) const {
    const ReferenceFromStation& T = *row_.T_reference_station;
    const Vector3 phi = ConstVector3(delta);
    const Vector3 turned = rotation_exp(-phi) * (p_home - T.t - ConstVector3(delta + 3));
    Eigen::Map<RowMajor<1, 6>> map(out);
    map.head<3>() = by_point * T.R.transpose() * skew(turned) * left_jacobian(-phi);
    map.tail<3>() = -by_point * T.R.transpose() * rotation_exp(-phi);
  }

  BearingRow row_;
};

class PriorCost final : public ceres::CostFunction {
 public:
  PriorCost(const std::vector<double>& mean, const std::vector<double>& sigma) : mean_(mean), sigma_(sigma) {
    set_num_residuals(static_cast<int>(mean.size()));
    *mutable_parameter_block_sizes() = {static_cast<int>(mean.size())};
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const std::size_t n = mean_.size();
    for (std::size_t i = 0; i < n; ++i) residuals[i] = (blocks[0][i] - mean_[i]) / sigma_[i];
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    std::fill_n(jacobians[0], n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) jacobians[0][i * n + i] = 1.0 / sigma_[i];
    return true;
  }

 private:
  std::vector<double> mean_;
  std::vector<double> sigma_;
};

class LengthCost final : public ceres::CostFunction {
 public:
  explicit LengthCost(const MeasuredLength& length) : length_(length) {
    set_num_residuals(1);
    *mutable_parameter_block_sizes() = {3, 3};
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Vector3 between = ConstVector3(blocks[0]) - ConstVector3(blocks[1]);
    const double distance = between.norm();
    if (distance <= 0.0) return false;
    residuals[0] = (distance - length_.length_m) / length_.sigma_m;
    if (jacobians == nullptr) return true;
    for (int block = 0; block < 2; ++block) {
      if (jacobians[block] == nullptr) continue;
      Eigen::Map<Vector3> out(jacobians[block]);
      out = (block == 0 ? 1.0 : -1.0) * between / (distance * length_.sigma_m);
    }
    return true;
  }

 private:
  MeasuredLength length_;
};

class FrameCost final : public ceres::CostFunction {
 public:
  explicit FrameCost(const std::vector<Vector3>& nominal_m) : nominal_m_(nominal_m) {
    set_num_residuals(6);
    Vector3 middle = Vector3::Zero();
    for (const Vector3& p : nominal_m) middle += p / static_cast<double>(nominal_m.size());
    double square = 0.0;
    for (const Vector3& p : nominal_m) square += (p - middle).squaredNorm();
    const double spread_m = std::sqrt(square / static_cast<double>(nominal_m.size()));
    for (const Vector3& p : nominal_m) {
      RowMajor<6, 3> rows;
      rows.topRows<3>() = Matrix3::Identity();
      rows.bottomRows<3>() = skew((p - middle) / spread_m);
      rows_.push_back(rows / (kFrame_m * static_cast<double>(nominal_m.size())));
      mutable_parameter_block_sizes()->push_back(3);
    }
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    Eigen::Map<Vector6> out(residuals);
    out.setZero();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      out += rows_[i] * (ConstVector3(blocks[i]) - nominal_m_[i]);
      if (jacobians == nullptr || jacobians[i] == nullptr) continue;
      Eigen::Map<RowMajor<6, 3>> jacobian(jacobians[i]);
      jacobian = rows_[i];
    }
    return true;
  }

 private:
  std::vector<Vector3> nominal_m_;
  std::vector<RowMajor<6, 3>> rows_;
};

}  // namespace

ceres::CostFunction* bearing_cost(const BearingRow& row) { return new BearingCost(row); }
ceres::CostFunction* prior_cost(const std::vector<double>& mean, const std::vector<double>& sigma) {
  return new PriorCost(mean, sigma);
}
ceres::CostFunction* length_cost(const MeasuredLength& length) { return new LengthCost(length); }
ceres::CostFunction* frame_cost(const std::vector<Vector3>& nominal_m) { return new FrameCost(nominal_m); }

}  // namespace pharos::calibrate
