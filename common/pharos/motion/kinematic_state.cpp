// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/kinematic_state.hpp"

#include <cmath>

#include "pharos/motion/gain.hpp"

namespace pharos::motion {
namespace {

// Covariance of some part of the state with the pose that the second station sees.
[[gnu::flatten]] Matrix6 with_seen(const SecondView& view, const Matrix6& with_body, const Matrix6& with_second) {
  const Matrix3 turn = view.by_body.topLeftCorner<3, 3>().transpose();
  const Matrix3 lever = view.by_second.bottomLeftCorner<3, 3>().transpose();
  Matrix6 with;
  with.leftCols<3>() = with_body.leftCols<3>().lazyProduct(turn) + with_second.leftCols<3>();
  with.rightCols<3>() = with_body.rightCols<3>().lazyProduct(turn) +
                        (with_second.leftCols<3>().lazyProduct(lever) + with_second.rightCols<3>());
  return with;
}

// `Ts`, `Tp`: gains of the station's and of the body's pose.
template <int blind>
void correct_station(SecondStation& second, const Gain<blind>& Ts, const Gain<blind>& Tp,
                     const Innovation& innovation) {
  subtract_square(second.ss, Ts);
  subtract_product(second.sp, Ts, Tp);
  second.pose = second.pose.moved_by(shift_of<blind>(Ts, innovation));
}

// Gains of pose, rate and acceleration.
template <int blind>
struct Gains {
  Gain<blind> p, r, a;
};

template <int blind>
void correct_motion(MovingState& state, const Gains<blind>& gain, const Innovation& innovation) {
  subtract_square(state.pp, gain.p);
  subtract_product(state.rp, gain.r, gain.p);
  subtract_square(state.rr, gain.r);
  subtract_product(state.ap, gain.a, gain.p);
  subtract_product(state.ar, gain.a, gain.r);
  subtract_square(state.aa, gain.a);
  state.pose = state.pose.moved_by(shift_of<blind>(gain.p, innovation));
  state.rate += shift_of<blind>(gain.r, innovation);
  state.acceleration += shift_of<blind>(gain.a, innovation);
}

template <int blind>
void correct_station(SecondStation& second, const Gain<blind>& Ts, const Gains<blind>& gain,
                     const Innovation& innovation) {
  subtract_product(second.sr, Ts, gain.r);
  subtract_product(second.sa, Ts, gain.a);
  correct_station<blind>(second, Ts, gain.p, innovation);
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

// By the rotation E of the attitude in t; h is half of its square.
void move(MovingState& state, const Matrix3& E, double t, double h) {
  state.pose.R = E * state.pose.R;
  state.pose.t += state.rate.tail<3>() * t + state.acceleration.tail<3>() * h;
  state.rate += state.acceleration * t;
}

template <int blind>
[[gnu::flatten]] Innovation innovation_without(const SweepInformation& sweep, const Matrix6& pose_covariance,
                                               const Vector6& offset) {
  Innovation out;
  const Vector6 innovation = sweep.whitened - sweep.factor.transpose() * offset;
  const Gain<blind> side = times_factor<blind>(pose_covariance, sweep);
  out.side.leftCols<kColumns<blind>>() = side;
  double det = 1.0;
  for_each_column<blind>([&](auto place, auto column) {
    constexpr int k = place, j = column;
    // Of L^T P L.
    const auto element = [&](auto row) {
      constexpr int i = row, rows = 6 - even(i);
      return sweep.factor.col(i).template tail<rows>().dot(side.col(k).template tail<rows>());
    };
    double pivot = 1.0 + element(column);
    double value = innovation[j];
    for_each_before<blind, j>([&](int before) {
      pivot -= out.factor(j, before) * out.factor(j, before);
      value -= out.factor(j, before) * out.whitened[before];
    });
    // I + (positive semidefinite): no pivot can be below one.
    const double root = std::sqrt(pivot > 1.0 ? pivot : 1.0);
    const double inverse = 1.0 / root;
    det *= root;
    out.inverse_root[j] = inverse;
    out.whitened[j] = value * inverse;
    for_each_column<blind>([&](auto, auto row) {
      constexpr int i = row;
      if constexpr (i > j) {
        double sum = element(row);
        for_each_before<blind, j>([&](int before) { sum -= out.factor(i, before) * out.factor(j, before); });
        out.factor(i, j) = sum * inverse;
      }
    });
  });
  out.chi2 = out.whitened.squaredNorm();
  out.log_det = 2.0 * std::log(det);
  return out;
}

}  // namespace

Innovation innovation_of(const SweepInformation& sweep, const Matrix6& pose_covariance, const Vector6& offset) {
  return without_blind_column(sweep,
                              [&](auto blind) { return innovation_without<blind>(sweep, pose_covariance, offset); });
}

Vector6 pose_shift(const SweepInformation& sweep, const Innovation& innovation) {
  return without_blind_column(sweep,
                              [&](auto blind) { return shift_of<blind>(gain_of<blind>(innovation), innovation); });
}

Matrix6 corrected_covariance(const Matrix6& covariance, const SweepInformation& sweep, const Innovation& innovation) {
  Matrix6 corrected = covariance;
  without_blind_column(sweep, [&](auto blind) { subtract_square(corrected, gain_of<blind>(innovation)); });
  return corrected;
}

SecondView::SecondView(const LighthouseFromBody& body, const StationFromStation& second) : pose(second * body) {
  const Vector3 q = second.R * body.t;
  by_body.setZero();
  by_body.topLeftCorner<3, 3>() = second.R;
  by_body.bottomRightCorner<3, 3>() = second.R;
  by_second.setIdentity();
  by_second.bottomLeftCorner<3, 3>() = -skew(q);
}

[[gnu::flatten]] Matrix6 seen_covariance(const SecondView& view, const Matrix6& pp, const SecondStation& second) {
  const Matrix6 with_pose =
      pp.lazyProduct(view.by_body.transpose()) + second.sp.transpose().lazyProduct(view.by_second.transpose());
  const Matrix6 with_second =
      second.sp.lazyProduct(view.by_body.transpose()) + second.ss.lazyProduct(view.by_second.transpose());
  return view.by_body.lazyProduct(with_pose) + view.by_second.lazyProduct(with_second);
}

void RestingState::correct(const SweepInformation& sweep, const Innovation& innovation, bool linked) {
  without_blind_column(sweep, [&](auto blind) {
    const Gain<blind> T = gain_of<blind>(innovation);
    if (linked) correct_station<blind>(second, gain_of<blind>(second.sp, sweep, innovation), T, innovation);
    subtract_square(covariance, T);
    pose = pose.moved_by(shift_of<blind>(T, innovation));
  });
}

void RestingState::correct_second(const SweepInformation& sweep, const Innovation& innovation, const SecondView& view) {
  without_blind_column(sweep, [&](auto blind) {
    const Gain<blind> T = gain_of<blind>(with_seen(view, covariance, second.sp.transpose()), sweep, innovation);
    const Gain<blind> Ts = gain_of<blind>(with_seen(view, second.sp, second.ss), sweep, innovation);
    correct_station<blind>(second, Ts, T, innovation);
    subtract_square(covariance, T);
    pose = pose.moved_by(shift_of<blind>(T, innovation));
  });
}

void MovingState::predict_mean(double dt_s) {
  const double h = 0.5 * dt_s * dt_s;
  move(*this, rotation_exp(rate.head<3>() * dt_s + acceleration.head<3>() * h), dt_s, h);
}

[[gnu::flatten]] void MovingState::predict(double dt_s, double jerk_rotation, double jerk_translation) {
  const double t = dt_s, h = 0.5 * t * t;
  // An attitude error rotates with the body.
  const Vector3 turn = rate.head<3>() * t + acceleration.head<3>() * h;
  const Matrix3 E = rotation_exp(turn);
  pp.topRows<3>() = E.lazyProduct(pp.topRows<3>()).eval();
  pp.leftCols<3>() = pp.leftCols<3>().lazyProduct(E.transpose()).eval();
  rp.leftCols<3>() = rp.leftCols<3>().lazyProduct(E.transpose()).eval();
  ap.leftCols<3>() = ap.leftCols<3>().lazyProduct(E.transpose()).eval();

  // pose += rate t + acceleration t^2/2, then rate += acceleration t.
  const Matrix6 pr = rp.transpose(), pa = ap.transpose(), ra = ar.transpose();
  pp += t * (rp + pr) + h * (ap + pa) + (t * t) * rr + (t * h) * (ar + ra) + (h * h) * aa;
  rp += t * rr + h * ra;
  ap += t * ar + h * aa;
  rp += t * ap;
  rr += t * (ar + ra) + (t * t) * aa;
  ar += t * aa;

  const double q[6] = {t * h * h / 5.0, h * h / 2.0, h * t / 3.0, t * t * t / 3.0, h, t};
  add_diagonal(pp, jerk_rotation * q[0], jerk_translation * q[0]);
  add_diagonal(rp, jerk_rotation * q[1], jerk_translation * q[1]);
  add_diagonal(ap, jerk_rotation * q[2], jerk_translation * q[2]);
  add_diagonal(rr, jerk_rotation * q[3], jerk_translation * q[3]);
  add_diagonal(ar, jerk_rotation * q[4], jerk_translation * q[4]);
  add_diagonal(aa, jerk_rotation * q[5], jerk_translation * q[5]);
  move(*this, E, t, h);
}

[[gnu::flatten]] void MovingState::predict_second(double dt_s) {
  const Matrix3 E = rotation_exp(rate.head<3>() * dt_s + acceleration.head<3>() * (0.5 * dt_s * dt_s));
  second.sp.leftCols<3>() = second.sp.leftCols<3>().lazyProduct(E.transpose()).eval();
  second.sp += dt_s * second.sr + (0.5 * dt_s * dt_s) * second.sa;
  second.sr += dt_s * second.sa;
}

void MovingState::correct(const SweepInformation& sweep, const Innovation& innovation, bool linked) {
  without_blind_column(sweep, [&](auto blind) {
    const Gains<blind> gain = {gain_of<blind>(innovation), gain_of<blind>(rp, sweep, innovation),
                               gain_of<blind>(ap, sweep, innovation)};
    if (linked) correct_station<blind>(second, gain_of<blind>(second.sp, sweep, innovation), gain, innovation);
    correct_motion<blind>(*this, gain, innovation);
  });
}

void MovingState::correct_second(const SweepInformation& sweep, const Innovation& innovation, const SecondView& view) {
  without_blind_column(sweep, [&](auto blind) {
    const auto of = [&](const Matrix6& with_body, const Matrix6& with_second) {
      return gain_of<blind>(with_seen(view, with_body, with_second), sweep, innovation);
    };
    const Gains<blind> gain = {of(pp, second.sp.transpose()), of(rp, second.sr.transpose()),
                               of(ap, second.sa.transpose())};
    correct_station<blind>(second, of(second.sp, second.ss), gain, innovation);
    correct_motion<blind>(*this, gain, innovation);
  });
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
