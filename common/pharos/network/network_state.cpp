// SPDX-License-Identifier: Apache-2.0
#include "pharos/network/network_state.hpp"

#include "pharos/geometry/small_difference.hpp"

namespace pharos::network {
namespace {

// Random walk of a body at rest: a table that yields, temperature.
constexpr double kCreep = 1e-10;  // rad^2/s, m^2/s

}  // namespace

void NetworkState::move_by(const StateVector& delta) {
  pose = pose.moved_by(delta.segment<6>(kPoseAt));
  pose.R = orthonormalised(pose.R);
  rate += delta.segment<6>(kRateAt);
  acceleration += delta.segment<6>(kAccelerationAt);
}

StateVector NetworkState::difference(const NetworkState& from) const {
  StateVector delta;
  delta.segment<6>(kPoseAt) = small_difference(pose, from.pose);
  delta.segment<6>(kRateAt) = rate - from.rate;
  delta.segment<6>(kAccelerationAt) = acceleration - from.acceleration;
  return delta;
}

void NetworkState::predict(double dt_s, double jerk_rotation, double jerk_translation) {
  const double half = 0.5 * dt_s * dt_s;
  const Vector6 step = dt_s * rate + half * acceleration;
  const Matrix3 turn = rotation_exp(step.head<3>());
  pose.R = orthonormalised(turn * pose.R);
  pose.t += step.tail<3>();
  rate += dt_s * acceleration;

  // P <- F P F^T by rows, then by columns. An attitude error turns with the body.
  StateMatrix& P = covariance;
  Eigen::Matrix<double, 3, kStateSize> turned;
  turned = turn.lazyProduct(P.topRows<3>());
  P.topRows<3>() = turned;
  P.middleRows<6>(kPoseAt) += dt_s * P.middleRows<6>(kRateAt) + half * P.middleRows<6>(kAccelerationAt);
  P.middleRows<6>(kRateAt) += dt_s * P.middleRows<6>(kAccelerationAt);
  turned = turn.lazyProduct(P.leftCols<3>().transpose());
  P.leftCols<3>() = turned.transpose();
  P.middleCols<6>(kPoseAt) += dt_s * P.middleCols<6>(kRateAt) + half * P.middleCols<6>(kAccelerationAt);
  P.middleCols<6>(kRateAt) += dt_s * P.middleCols<6>(kAccelerationAt);

  const double d2 = dt_s * dt_s, d3 = d2 * dt_s, d4 = d3 * dt_s, d5 = d4 * dt_s;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double q = k < 3 ? jerk_rotation : jerk_translation;
    const Eigen::Index p = kPoseAt + k, r = kRateAt + k, a = kAccelerationAt + k;
    P(p, p) += q * d5 / 20.0;
    P(p, r) += q * d4 / 8.0;
    P(r, p) += q * d4 / 8.0;
    P(p, a) += q * d3 / 6.0;
    P(a, p) += q * d3 / 6.0;
    P(r, r) += q * d3 / 3.0;
    P(r, a) += q * d2 / 2.0;
    P(a, r) += q * d2 / 2.0;
    P(a, a) += q * dt_s;
  }
}

void NetworkState::predict_at_rest(double dt_s) {
  for (Eigen::Index k = 0; k < 6; ++k) covariance(k, k) += kCreep * dt_s;
}

void NetworkState::place(const Vector3& position_m, const Vector3& velocity_m_s, const Vector3& acceleration_m_s2,
                         const Eigen::Matrix<double, 9, 9>& position_covariance) {
  constexpr std::array<Eigen::Index, 3> kAt = {kPoseAt + 3, kRateAt + 3, kAccelerationAt + 3};
  pose.t = position_m;
  rate.tail<3>() = velocity_m_s;
  acceleration.tail<3>() = acceleration_m_s2;
  for (const Eigen::Index at : kAt) {
    covariance.middleRows<3>(at).setZero();
    covariance.middleCols<3>(at).setZero();
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      covariance.block<3, 3>(kAt[static_cast<std::size_t>(i)], kAt[static_cast<std::size_t>(k)]) =
          position_covariance.block<3, 3>(3 * i, 3 * k);
    }
  }
}

void NetworkState::reset_rates(const std::array<double, 4>& sigmas) {
  rate.setZero();
  acceleration.setZero();
  covariance.middleRows<12>(kRateAt).setZero();
  covariance.middleCols<12>(kRateAt).setZero();
  for (Eigen::Index k = 0; k < 3; ++k) {
    covariance(kRateAt + k, kRateAt + k) = sigmas[0] * sigmas[0];
    covariance(kRateAt + 3 + k, kRateAt + 3 + k) = sigmas[1] * sigmas[1];
    covariance(kAccelerationAt + k, kAccelerationAt + k) = sigmas[2] * sigmas[2];
    covariance(kAccelerationAt + 3 + k, kAccelerationAt + 3 + k) = sigmas[3] * sigmas[3];
  }
}

}  // namespace pharos::network
