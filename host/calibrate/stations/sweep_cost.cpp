// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/sweep_cost.hpp"

#include <cmath>

namespace pharos::calibrate {
namespace {

template <int Rows, int Columns>
using RowMajor = Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>;
using ConstVector3 = Eigen::Map<const Vector3>;

constexpr double kNearest_m = 0.05;
constexpr double kStep_rad = 1e-5;  // of central differences of the station's model

constexpr std::size_t kTurns = 4, kStation = 8, kFields = 9, kSensors = 10;

Matrix3 left_jacobian(const Vector3& phi) {
  const Matrix3 cross = skew(phi);
  const double square = phi.squaredNorm();
  if (square < 1e-10) return Matrix3::Identity() + 0.5 * cross;
  const double angle = std::sqrt(square);
  return Matrix3::Identity() + (1.0 - std::cos(angle)) / square * cross +
         (angle - std::sin(angle)) / (square * angle) * cross * cross;
}

class SweepCost final : public ceres::CostFunction {
 public:
  explicit SweepCost(const SweepRows& rows) : rows_(rows) {
    const std::size_t n = rows_.sweep->hits.size();
    set_num_residuals(static_cast<int>(n));
    auto& sizes = *mutable_parameter_block_sizes();
    sizes.assign(kStation, 3);
    sizes.push_back(6);
    sizes.push_back(static_cast<int>(kPlaneFields));
    sizes.insert(sizes.end(), n, 3);
    const PlaneNoise& noise = rows_.noise;
    const double apart = std::hypot(noise.own_rad, noise.apart_rad);
    const double all = std::hypot(noise.own_rad, std::sqrt(static_cast<double>(n)) * noise.common_rad);
    apart_ = 1.0 / apart;
    shared_ = (1.0 / apart - 1.0 / all) / static_cast<double>(n);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const std::size_t n = rows_.sweep->hits.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (!row(i, blocks, residuals, jacobians)) return false;
    }
    whiten(residuals, n, 1);
    if (jacobians == nullptr) return true;
    for (std::size_t b = 0; b < kSensors + n; ++b) {
      if (jacobians[b] != nullptr) whiten(jacobians[b], n, static_cast<std::size_t>(parameter_block_sizes()[b]));
    }
    return true;
  }

 private:
  double model(const double* fields, const Vector3& p) const {
    PlaneFields own;
    std::copy_n(fields, kPlaneFields, own.begin());
    network::Station station;
    station.generation = rows_.generation;
    station.plane[rows_.sweep->plane] = plane_of(own);
    return network::raw_angle(station, rows_.sweep->plane, p);
  }

  bool row(std::size_t i, double const* const* blocks, double* residuals, double** jacobians) const {
    const network::Hit& hit = rows_.sweep->hits[i];
    Vector3 position = Vector3::Zero(), turn = Vector3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      position += rows_.weight[i][k] * ConstVector3(blocks[k]);
      turn += rows_.weight[i][k] * ConstVector3(blocks[kTurns + k]);
    }
    const Matrix3 R = rotation_exp(turn) * rows_.reference[i];
    const Vector3 arm = R * ConstVector3(blocks[kSensors + i]);
    const Vector3 phi = ConstVector3(blocks[kStation]);
    const network::WorldFromStation& T = rows_.T_world_station;
    const Matrix3 turned_back = rotation_exp(-phi);
    const Vector3 from = turned_back * (position + arm - T.t - ConstVector3(blocks[kStation] + 3));
    const Vector3 p = T.R.transpose() * from;
    if (p.z() < kNearest_m) return false;
    residuals[i] = hit.angle_rad - model(blocks[kFields], p);
    if (!std::isfinite(residuals[i])) return false;
    if (jacobians == nullptr) return true;
    const Eigen::RowVector3d by_station = -by_point(blocks[kFields], p) * T.R.transpose();
    const Eigen::RowVector3d by_world = by_station * turned_back;
    const Eigen::RowVector3d by_turn = -by_world * skew(arm) * left_jacobian(turn);
    const std::size_t n = rows_.sweep->hits.size();
    for (std::size_t k = 0; k < 4; ++k) {
      if (jacobians[k] != nullptr) Eigen::Map<RowMajor<1, 3>>(jacobians[k] + 3 * i) = rows_.weight[i][k] * by_world;
      if (jacobians[kTurns + k] != nullptr) {
        Eigen::Map<RowMajor<1, 3>>(jacobians[kTurns + k] + 3 * i) = rows_.weight[i][k] * by_turn;
      }
    }
    if (jacobians[kStation] != nullptr) {
      Eigen::Map<RowMajor<1, 6>> out(jacobians[kStation] + 6 * i);
      out.head<3>() = by_station * skew(from) * left_jacobian(-phi);
      out.tail<3>() = -by_world;
    }
    if (jacobians[kFields] != nullptr) by_fields(blocks[kFields], p, jacobians[kFields] + kPlaneFields * i);
    for (std::size_t j = 0; j < n; ++j) {
      if (jacobians[kSensors + j] == nullptr) continue;
      Eigen::Map<RowMajor<1, 3>> out(jacobians[kSensors + j] + 3 * i);
      if (j == i) {
        out = by_world * R;
      } else {
        out.setZero();
      }
    }
    return true;
  }

  Eigen::RowVector3d by_point(const double* fields, const Vector3& p) const {
    const double step = kStep_rad * p.norm();
    Eigen::RowVector3d out;
    for (Eigen::Index k = 0; k < 3; ++k) {
      out[k] = (model(fields, p + step * Vector3::Unit(k)) - model(fields, p - step * Vector3::Unit(k))) / (2.0 * step);
    }
    return out;
  }

  void by_fields(const double* fields, const Vector3& p, double* out) const {
    for (std::size_t k = 0; k < kPlaneFields; ++k) {
      PlaneFields more, less;
      std::copy_n(fields, kPlaneFields, more.begin());
      less = more;
      more[k] += kStep_rad;
      less[k] -= kStep_rad;
      out[k] = -(model(more.data(), p) - model(less.data(), p)) / (2.0 * kStep_rad);
    }
  }

  // apart^2 (I - 1 1^T / n) + (own^2 / n + common^2) 1 1^T = S: S^(-1/2) x = x / apart - shared sum(x).
  void whiten(double* rows, std::size_t n, std::size_t columns) const {
    for (std::size_t c = 0; c < columns; ++c) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) sum += rows[i * columns + c];
      for (std::size_t i = 0; i < n; ++i) {
        rows[i * columns + c] = apart_ * rows[i * columns + c] - shared_ * sum;
      }
    }
  }

  SweepRows rows_;
  double apart_ = 1.0, shared_ = 0.0;
};

class JerkCost final : public ceres::CostFunction {
 public:
  JerkCost(Vector3 offset, double density, double step_s)
      : offset_(std::move(offset)), scale_(1.0 / std::sqrt(density * std::pow(step_s, 5))) {
    set_num_residuals(3);
    mutable_parameter_block_sizes()->assign(4, 3);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    constexpr std::array<double, 4> kThirdDifference = {-1.0, 3.0, -3.0, 1.0};
    Eigen::Map<Vector3> out(residuals);
    out = scale_ * offset_;
    for (std::size_t k = 0; k < 4; ++k) {
      out += scale_ * kThirdDifference[k] * ConstVector3(blocks[k]);
      if (jacobians == nullptr || jacobians[k] == nullptr) continue;
      Eigen::Map<RowMajor<3, 3>>(jacobians[k]).setIdentity();
      Eigen::Map<RowMajor<3, 3>>(jacobians[k]) *= scale_ * kThirdDifference[k];
    }
    return true;
  }

 private:
  Vector3 offset_;
  double scale_;
};

}  // namespace

SweepRows sweep_rows(const network::PlaneSweep& sweep, const network::Station& station, const BodySpline& motion,
                     const PlaneNoise& noise) {
  SweepRows rows;
  rows.sweep = &sweep;
  rows.generation = station.generation;
  rows.T_world_station = *station.T_world_station;
  rows.noise = noise;
  // All hits of a sweep by one piece of the spline: it is smooth beyond its end for the few milliseconds of a sweep.
  rows.first_control = motion.basis(sweep.hits[0].time_s).first;
  for (const network::Hit& hit : sweep.hits) {
    rows.weight.push_back(motion.basis_of(rows.first_control, hit.time_s).weight);
    rows.reference.push_back(motion.reference(hit.time_s));
  }
  return rows;
}

ceres::CostFunction* sweep_cost(const SweepRows& rows) { return new SweepCost(rows); }
ceres::CostFunction* jerk_cost(const Vector3& offset, double density, double step_s) {
  return new JerkCost(offset, density, step_s);
}

}  // namespace pharos::calibrate
