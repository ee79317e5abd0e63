// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/kinematic_state.hpp"

#include <cmath>

namespace pharos::motion {
namespace {

// side C^-T for side = (rows of P belonging to the pose) L: what multiplies the whitened innovation.
Matrix6 gain_side(const Matrix6& covariance_with_pose, const SweepInformation& sweep, const Innovation& innovation) {
  Matrix6 T = covariance_with_pose.lazyProduct(sweep.factor);
  for (int j = 0; j < 6; ++j) {
    for (int k = 0; k < j; ++k) T.col(j) -= innovation.factor(j, k) * T.col(k);
    T.col(j) *= 1.0 / innovation.factor(j, j);
  }
  return T;
}

void subtract_product(Matrix6& from, const Matrix6& a, const Matrix6& b) { from -= a.lazyProduct(b.transpose()); }

void add_diagonal(Matrix6& matrix, double rotation, double translation) {
  for (int k = 0; k < 3; ++k) {
    matrix(k, k) += rotation;
    matrix(k + 3, k + 3) += translation;
  }
}

}  // namespace

Innovation innovation_of(const SweepInformation& sweep, const Matrix6& pose_covariance, const Vector6& offset) {
  Innovation out;
  const Vector6 innovation = sweep.whitened - sweep.factor.transpose() * offset;
  const Matrix6 side = pose_covariance.lazyProduct(sweep.factor);
  const Matrix6 S = sweep.factor.transpose().lazyProduct(side);
  double det = 1.0;
  for (int j = 0; j < 6; ++j) {
    double pivot = 1.0 + S(j, j);
    double value = innovation[j];
    for (int k = 0; k < j; ++k) {
      pivot -= out.factor(j, k) * out.factor(j, k);
      value -= out.factor(j, k) * out.whitened[k];
    }
    // I + (positive semidefinite): no pivot can be below one.
    const double root = std::sqrt(pivot > 1.0 ? pivot : 1.0);
    const double inverse = 1.0 / root;
    det *= root;
    out.factor(j, j) = root;
    out.whitened[j] = value * inverse;
    for (int i = j + 1; i < 6; ++i) {
      double sum = S(i, j);
      for (int k = 0; k < j; ++k) sum -= out.factor(i, k) * out.factor(j, k);
      out.factor(i, j) = sum * inverse;
    }
  }
  out.chi2 = out.whitened.squaredNorm();
  out.log_det = 2.0 * std::log(det);
  return out;
}

Vector6 pose_shift(const Matrix6& covariance, const SweepInformation& sweep, const Innovation& innovation) {
  return gain_side(covariance, sweep, innovation) * innovation.whitened;
}

void RestingState::correct(const SweepInformation& sweep, const Innovation& innovation) {
  const Matrix6 T = gain_side(covariance, sweep, innovation);
  subtract_product(covariance, T, T);
  pose = pose.moved_by(T * innovation.whitened);
}

void MovingState::predict_mean(double dt_s) {
  pose = pose.moved_by(rate * dt_s + acceleration * (0.5 * dt_s * dt_s));
  rate += acceleration * dt_s;
}

void MovingState::predict(double dt_s, double jerk_rotation, double jerk_translation) {
  const double t = dt_s, h = 0.5 * t * t;
  // An error of attitude turns with the body.
  const Vector3 turn = rate.head<3>() * t + acceleration.head<3>() * h;
  const Matrix3 E = rotation_exp(turn);
  pp.topRows<3>() = E.lazyProduct(pp.topRows<3>()).eval();
  pp.leftCols<3>() = pp.leftCols<3>().lazyProduct(E.transpose()).eval();
  rp.leftCols<3>() = rp.leftCols<3>().lazyProduct(E.transpose()).eval();
  ap.leftCols<3>() = ap.leftCols<3>().lazyProduct(E.transpose()).eval();

  // pose += rate t + acceleration t^2/2, then rate += acceleration t.
  pp += t * (rp + rp.transpose()) + h * (ap + ap.transpose()) + (t * t) * rr + (t * h) * (ar + ar.transpose()) +
        (h * h) * aa;
  rp += t * rr + h * ar.transpose();
  ap += t * ar + h * aa;
  rp += t * ap;
  rr += t * (ar + ar.transpose()) + (t * t) * aa;
  ar += t * aa;

  const double q[6] = {t * h * h / 5.0, h * h / 2.0, h * t / 3.0, t * t * t / 3.0, h, t};
  add_diagonal(pp, jerk_rotation * q[0], jerk_translation * q[0]);
  add_diagonal(rp, jerk_rotation * q[1], jerk_translation * q[1]);
  add_diagonal(ap, jerk_rotation * q[2], jerk_translation * q[2]);
  add_diagonal(rr, jerk_rotation * q[3], jerk_translation * q[3]);
  add_diagonal(ar, jerk_rotation * q[4], jerk_translation * q[4]);
  add_diagonal(aa, jerk_rotation * q[5], jerk_translation * q[5]);
  predict_mean(t);
}

void MovingState::correct(const SweepInformation& sweep, const Innovation& innovation) {
  const Matrix6 Tp = gain_side(pp, sweep, innovation);
  const Matrix6 Tr = gain_side(rp, sweep, innovation);
  const Matrix6 Ta = gain_side(ap, sweep, innovation);
  subtract_product(pp, Tp, Tp);
  subtract_product(rp, Tr, Tp);
  subtract_product(rr, Tr, Tr);
  subtract_product(ap, Ta, Tp);
  subtract_product(ar, Ta, Tr);
  subtract_product(aa, Ta, Ta);
  pose = pose.moved_by(Tp * innovation.whitened);
  rate += Tr * innovation.whitened;
  acceleration += Ta * innovation.whitened;
}

}  // namespace pharos::motion
