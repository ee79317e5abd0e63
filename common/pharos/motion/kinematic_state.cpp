// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/kinematic_state.hpp"

#include <cmath>

namespace pharos::motion {
namespace {

// side C^-T for side = (covariance with the observed pose) L: the factor of the whitened innovation.
Matrix6 gain_side(const Matrix6& covariance_with_seen, const SweepInformation& sweep, const Innovation& innovation) {
  Matrix6 T = covariance_with_seen.lazyProduct(sweep.factor);
  for (int j = 0; j < 6; ++j) {
    for (int k = 0; k < j; ++k) T.col(j) -= innovation.factor(j, k) * T.col(k);
    T.col(j) *= 1.0 / innovation.factor(j, j);
  }
  return T;
}

void subtract_product(Matrix6& from, const Matrix6& a, const Matrix6& b) { from -= a.lazyProduct(b.transpose()); }

// Covariance of some part of the state with the pose that the second station sees.
Matrix6 with_seen(const SecondView& view, const Matrix6& with_body, const Matrix6& with_second) {
  return with_body.lazyProduct(view.by_body.transpose()) + with_second.lazyProduct(view.by_second.transpose());
}

// `Ts`, `Tp`: gains of the station's and of the body's pose.
void correct_station(SecondStation& second, const Matrix6& Ts, const Matrix6& Tp, const Innovation& innovation) {
  subtract_product(second.ss, Ts, Ts);
  subtract_product(second.sp, Ts, Tp);
  second.pose = second.pose.moved_by(Ts * innovation.whitened);
}

Matrix6 transformed(const Matrix6& by, const Matrix6& covariance) {
  return by.lazyProduct(Matrix6(covariance.lazyProduct(by.transpose())));
}

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

Matrix6 corrected_covariance(const Matrix6& covariance, const SweepInformation& sweep, const Innovation& innovation) {
  const Matrix6 T = gain_side(covariance, sweep, innovation);
  return covariance - T.lazyProduct(T.transpose());
}

SecondView::SecondView(const LighthouseFromBody& body, const StationFromStation& second) : pose(second * body) {
  const Vector3 q = second.R * body.t;
  by_body.setZero();
  by_body.topLeftCorner<3, 3>() = second.R;
  by_body.bottomRightCorner<3, 3>() = second.R;
  by_second.setIdentity();
  by_second.bottomLeftCorner<3, 3>() = -skew(q);
}

Matrix6 seen_covariance(const SecondView& view, const Matrix6& pp, const SecondStation& second) {
  const Matrix6 with_pose =
      pp.lazyProduct(view.by_body.transpose()) + second.sp.transpose().lazyProduct(view.by_second.transpose());
  const Matrix6 with_second =
      second.sp.lazyProduct(view.by_body.transpose()) + second.ss.lazyProduct(view.by_second.transpose());
  return view.by_body.lazyProduct(with_pose) + view.by_second.lazyProduct(with_second);
}

void RestingState::correct(const SweepInformation& sweep, const Innovation& innovation, bool linked) {
  const Matrix6 T = gain_side(covariance, sweep, innovation);
  if (linked) correct_station(second, gain_side(second.sp, sweep, innovation), T, innovation);
  subtract_product(covariance, T, T);
  pose = pose.moved_by(T * innovation.whitened);
}

void RestingState::correct_second(const SweepInformation& sweep, const Innovation& innovation, const SecondView& view) {
  const Matrix6 T = gain_side(with_seen(view, covariance, second.sp.transpose()), sweep, innovation);
  correct_station(second, gain_side(with_seen(view, second.sp, second.ss), sweep, innovation), T, innovation);
  subtract_product(covariance, T, T);
  pose = pose.moved_by(T * innovation.whitened);
}

void MovingState::predict_mean(double dt_s) {
  pose = pose.moved_by(rate * dt_s + acceleration * (0.5 * dt_s * dt_s));
  rate += acceleration * dt_s;
}

void MovingState::predict(double dt_s, double jerk_rotation, double jerk_translation) {
  const double t = dt_s, h = 0.5 * t * t;
  // An attitude error rotates with the body.
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

void MovingState::predict_second(double dt_s) {
  const Matrix3 E = rotation_exp(rate.head<3>() * dt_s + acceleration.head<3>() * (0.5 * dt_s * dt_s));
  second.sp.leftCols<3>() = second.sp.leftCols<3>().lazyProduct(E.transpose()).eval();
  second.sp += dt_s * second.sr + (0.5 * dt_s * dt_s) * second.sa;
  second.sr += dt_s * second.sa;
}

void MovingState::apply(const Matrix6& Tp, const Matrix6& Tr, const Matrix6& Ta, const Vector6& whitened) {
  subtract_product(pp, Tp, Tp);
  subtract_product(rp, Tr, Tp);
  subtract_product(rr, Tr, Tr);
  subtract_product(ap, Ta, Tp);
  subtract_product(ar, Ta, Tr);
  subtract_product(aa, Ta, Ta);
  pose = pose.moved_by(Tp * whitened);
  rate += Tr * whitened;
  acceleration += Ta * whitened;
}

void MovingState::correct(const SweepInformation& sweep, const Innovation& innovation, bool linked) {
  const Matrix6 Tp = gain_side(pp, sweep, innovation);
  const Matrix6 Tr = gain_side(rp, sweep, innovation);
  const Matrix6 Ta = gain_side(ap, sweep, innovation);
  if (linked) {
    const Matrix6 Ts = gain_side(second.sp, sweep, innovation);
    subtract_product(second.sr, Ts, Tr);
    subtract_product(second.sa, Ts, Ta);
    correct_station(second, Ts, Tp, innovation);
  }
  apply(Tp, Tr, Ta, innovation.whitened);
}

void MovingState::correct_second(const SweepInformation& sweep, const Innovation& innovation, const SecondView& view) {
  const Matrix6 Tp = gain_side(with_seen(view, pp, second.sp.transpose()), sweep, innovation);
  const Matrix6 Tr = gain_side(with_seen(view, rp, second.sr.transpose()), sweep, innovation);
  const Matrix6 Ta = gain_side(with_seen(view, ap, second.sa.transpose()), sweep, innovation);
  const Matrix6 Ts = gain_side(with_seen(view, second.sp, second.ss), sweep, innovation);
  subtract_product(second.sr, Ts, Tr);
  subtract_product(second.sa, Ts, Ta);
  correct_station(second, Ts, Tp, innovation);
  apply(Tp, Tr, Ta, innovation.whitened);
}

void RestingState::mirror(const Tilt& tilt) {
  const Matrix6 by = tilt.by_pose(pose);
  covariance = transformed(by, covariance);
  pose = tilt.mirrored(pose);
}

void MovingState::mirror(const Tilt& tilt) {
  const Matrix6 by = tilt.by_pose(pose);
  for (Matrix6* block : {&pp, &rp, &rr, &ap, &ar, &aa}) *block = transformed(by, *block);
  rate = by * rate.eval();
  acceleration = by * acceleration.eval();
  pose = tilt.mirrored(pose);
}

}  // namespace pharos::motion
