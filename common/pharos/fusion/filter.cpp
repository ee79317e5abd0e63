// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/filter.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pharos::fusion {
namespace {

constexpr double kWideRotation_rad = 1.0;
constexpr double kWidePosition_m = 10.0;  // of a start: what no measurement says yet
constexpr double kFillPosition_m = 1.0;

std::size_t bias_row(std::size_t source) { return static_cast<std::size_t>(kKinematic) + 6 * source; }

using Kinematic12 = Eigen::Matrix<double, kKinematic, kKinematic>;
using RowVector6 = Eigen::Matrix<double, 1, 6>;

struct Derivatives {
  Matrix6 by_pose, by_bias;
};

// Of the pose that a source sees: T = bias * T_state (kSensor, about the sensor), or T_state * bias (kFeature).
Derivatives derivatives(const Kinematics& mean, const BiasMean& bias, const SourceSettings& source) {
  Derivatives d{Matrix6::Zero(), Matrix6::Zero()};
  if (source.bias_frame == BiasFrame::kSensor) {
    const Vector3 arm = bias.R * (mean.pose.t - source.T_vehicle_sensor.t);
    d.by_pose.topLeftCorner<3, 3>() = bias.R;
    d.by_pose.bottomRightCorner<3, 3>() = bias.R;
    d.by_bias.setIdentity();
    d.by_bias.bottomLeftCorner<3, 3>() = -skew(arm);
  } else {
    d.by_pose.setIdentity();
    d.by_pose.bottomLeftCorner<3, 3>() = -skew(mean.pose.R * bias.t);
    d.by_bias.topLeftCorner<3, 3>() = mean.pose.R;
    d.by_bias.bottomRightCorner<3, 3>() = mean.pose.R;
  }
  return d;
}

// White noise integrated over a step: q (dt^3/3, dt^2/2, dt) of each axis.
void add_process_noise(Kinematic12& P, double dt, double rate_rad_s, const MotionSettings& motion) {
  const double size = std::abs(dt);
  for (int axis = 0; axis < 3; ++axis) {
    for (const auto& [value, rate, density] : {std::tuple{axis, axis + 6, angular_density(rate_rad_s, motion)},
                                               std::tuple{axis + 3, axis + 9, motion.acceleration_density}}) {
      P(value, value) += density * size * size * size / 3.0;
      P(value, rate) += density * size * size / 2.0;
      P(rate, value) += density * size * size / 2.0;
      P(rate, rate) += density * size;
    }
  }
}

// Lower Cholesky factor of the leading block; false where it is not positive definite.
bool factorise(const Matrix6& a, int rank, Matrix6& lower) {
  for (int j = 0; j < rank; ++j) {
    for (int i = j; i < rank; ++i) {
      double sum = a(i, j);
      for (int k = 0; k < j; ++k) sum -= lower(i, k) * lower(j, k);
      if (i > j) {
        lower(i, j) = sum / lower(j, j);
      } else if (sum > 1e-13 * a(j, j)) {
        lower(j, j) = std::sqrt(sum);
      } else {
        return false;
      }
    }
  }
  return true;
}

// X lower^-T, of the leading `rank` columns; the others are zero.
void divide_by_transpose(const Matrix6& lower, int rank, Matrix6& X) {
  for (int i = 0; i < rank; ++i) {
    for (int k = 0; k < i; ++k) X.col(i) -= lower(i, k) * X.col(k);
    X.col(i) /= lower(i, i);
  }
  for (int i = rank; i < 6; ++i) X.col(i).setZero();
}

// Six rows and columns of a covariance.
Matrix6 block_of(const Covariance& P, std::size_t row, std::size_t column) {
  if (row < column) return block_of(P, column, row).transpose();
  Matrix6 out;
  for (std::size_t i = 0; i < 6; ++i) {
    const double* const from = P.lower.data() + Covariance::index(row + i, column);
    for (std::size_t j = 0; j < (row == column ? i + 1 : 6); ++j)
      out(static_cast<int>(i), static_cast<int>(j)) = from[j];
  }
  if (row == column) {
    for (int i = 0; i < 6; ++i) {
      for (int j = i + 1; j < 6; ++j) out(i, j) = out(j, i);
    }
  }
  return out;
}

Vector6 solve_lower(const Matrix6& lower, int rank, Vector6 x) {
  for (int i = 0; i < rank; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= lower(i, k) * x[k];
    x[i] /= lower(i, i);
  }
  return x;
}

}  // namespace

TargetPose completed(const TargetPose& pose, const Directions& directions, const TargetPose& reference) {
  if (directions.rank == 6) return pose;
  const auto rows = directions.rows.topRows(directions.rank);
  TargetPose out = pose;
  for (int step = 0; step < 4; ++step) {
    const Vector6 delta = pose_difference(reference, out);
    out = out.moved_by(delta - rows.transpose() * (rows * delta));
  }
  return out;
}

TargetPose Filter::expected_pose(std::uint8_t source, const SourceSettings& settings) const {
  const BiasMean& b = bias_[source];
  if (settings.bias_frame == BiasFrame::kSensor) {
    const Vector3& centre = settings.T_vehicle_sensor.t;
    return {b.R * mean_.pose.R, centre + b.R * (mean_.pose.t - centre) + b.t};
  }
  return {mean_.pose.R * b.R, mean_.pose.t + mean_.pose.R * b.t};
}

void Filter::set_bias_block(std::uint8_t source, const Matrix6& block) {
  const std::size_t first = bias_row(source);
  for (std::size_t i = first; i < first + 6; ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(kStates); ++j) covariance_(i, j) = 0.0;
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      covariance_(first + i, first + j) = block(static_cast<int>(i), static_cast<int>(j));
    }
  }
}

void Filter::reset_bias(std::uint8_t source, const Settings& settings) {
  bias_[source] = BiasMean{};
  active_[source] = false;
  set_bias_block(source, stationary_bias(source, settings.sources[source]));
}

// What the mounting leaves and the source's own error. The latter is one of the pose that the source sees: as a bias of
// the sensor's mounting, whose rotation acts about the sensor, its translation makes up for the lever arm.
Matrix6 Filter::stationary_bias(std::uint8_t source, const SourceSettings& settings) const {
  const auto rotation = static_cast<double>(own_[source].rotation);
  const auto position = static_cast<double>(own_[source].position);
  Matrix6 out = settings.bias_covariance;
  out.diagonal().head<3>().array() += rotation;
  out.diagonal().tail<3>().array() += position;
  if (settings.bias_frame == BiasFrame::kSensor && rotation > 0.0) {
    const Matrix3 arm = skew(mean_.pose.t - settings.T_vehicle_sensor.t);
    out.bottomLeftCorner<3, 3>() += rotation * arm;
    out.topRightCorner<3, 3>() += rotation * arm.transpose();
    out.bottomRightCorner<3, 3>() += rotation * Matrix3(arm * arm.transpose());
  }
  return out;
}

void Filter::set_own_variance(std::uint8_t source, const OwnVariance& variance, const Settings& settings) {
  const OwnVariance before = own_[source];
  own_[source] = variance;
  if (!valid_) return;
  const Matrix6& rest = settings.sources[source].bias_covariance;
  if (!active_[source]) {
    set_bias_block(source, stationary_bias(source, settings.sources[source]));
    return;
  }
  const auto ratio = [](double mounting, float now, float then) {
    return std::sqrt((mounting + 3.0 * static_cast<double>(now)) / (mounting + 3.0 * static_cast<double>(then)));
  };
  const double rotation = ratio(rest.topLeftCorner<3, 3>().trace(), variance.rotation, before.rotation);
  const double position = ratio(rest.bottomRightCorner<3, 3>().trace(), variance.position, before.position);
  // Whether the error follows the stated noise or stays is not known: the difference, (1 - ratio) of the old error, is
  // new. Otherwise every change of the noise would measure the bias.
  const double fresh = std::max(std::abs(1.0 / rotation - 1.0), std::abs(1.0 / position - 1.0));
  const double kept = std::sqrt(std::max(0.0, 1.0 - fresh * fresh));
  scale_bias(source, kept * rotation, kept * position);
  add_bias(source, (1.0 - kept * kept) * stationary_bias(source, settings.sources[source]));
}

void Filter::add_bias(std::uint8_t source, const Matrix6& covariance) {
  const std::size_t first = bias_row(source);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      covariance_(first + i, first + j) += covariance(static_cast<int>(i), static_cast<int>(j));
    }
  }
}

void Filter::scale_bias(std::uint8_t source, double rotation, double position) {
  bias_[source].R = rotation_exp(rotation * rotation_log(bias_[source].R));
  bias_[source].t *= position;
  const std::size_t first = bias_row(source);
  for (std::size_t i = 0; i < 6; ++i) {
    const double factor = i < 3 ? rotation : position;
    for (std::size_t j = 0; j < static_cast<std::size_t>(kStates); ++j) {
      if (j != first + i) covariance_(first + i, j) *= factor;
    }
    covariance_(first + i, first + i) *= factor * factor;
  }
}

void Filter::start(const TargetMeasurement& measurement, const Settings& settings, const TargetPose* fill) {
  covariance_ = Covariance{};
  mean_ = Kinematics{};
  mean_.pose = measurement.pose;
  Vector6 wide;
  wide << Vector3::Constant(kWideRotation_rad), Vector3::Constant(kWidePosition_m);
  if (fill != nullptr) {
    mean_.pose = completed(measurement.pose, measurement.directions, *fill);
    if (measurement.directions.rank < 6) wide.tail<3>().setConstant(kFillPosition_m);
  }
  for (std::size_t i = 0; i < 6; ++i) covariance_(i, i) = wide[static_cast<int>(i)] * wide[static_cast<int>(i)];
  const StartSettings& start = settings.start;
  for (std::size_t i = 6; i < 9; ++i) covariance_(i, i) = start.sigma_rate_rad_s * start.sigma_rate_rad_s;
  for (std::size_t i = 9; i < 12; ++i) covariance_(i, i) = start.sigma_velocity_m_s * start.sigma_velocity_m_s;
  const auto sources = static_cast<std::uint8_t>(settings.sources.size());  // at most kMaxSources
  for (std::uint8_t s = 0; s < sources; ++s) reset_bias(s, settings);
  valid_ = true;
  complete_ = measurement.directions.rank == 6;
  const Innovation first = innovation(measurement, settings);
  if (first.ok) correct(first, measurement.source, settings);
}

void Filter::align(const TargetMeasurement& measurement, const Settings& settings) {
  const std::uint8_t s = measurement.source;
  BiasMean& bias = bias_[s];
  bias.R = mean_.pose.R.transpose() * measurement.pose.R;
  bias.t = mean_.pose.R.transpose() * (measurement.pose.t - mean_.pose.t);
  Matrix6 wide = Matrix6::Zero();
  wide.diagonal() << Vector3::Constant(kWideRotation_rad), Vector3::Constant(kWidePosition_m * kWidePosition_m);
  set_bias_block(s, wide);
  const Innovation first = innovation(measurement, settings);
  if (first.ok) correct(first, s, settings);
}

void Filter::predict(double dt_s, const Settings& settings) {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(dt_s) / kMaxStep_s)));
  for (int step = 0; step < steps; ++step) predict_step(dt_s / steps, settings);
  predict_biases(dt_s, settings);
}

void Filter::predict_step(double dt, const Settings& settings) {
  const Transition transition = advance(mean_, dt, settings.motion);
  Kinematic12 P = kinematic_covariance();
  for (int i = 0; i < kKinematic; ++i) transition.apply(P.col(i).data());
  P.transposeInPlace();
  for (int i = 0; i < kKinematic; ++i) transition.apply(P.col(i).data());
  add_process_noise(P, dt, mean_.rate_rad_s.norm(), settings.motion);
  for (std::size_t i = 0; i < kKinematic; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      covariance_(i, j) =
          0.5 * (P(static_cast<int>(i), static_cast<int>(j)) + P(static_cast<int>(j), static_cast<int>(i)));
    }
  }
  for (std::size_t s = 0; s < settings.sources.size(); ++s) {
    if (!active_[s]) continue;
    // Rows of the packed lower triangle are contiguous: cross terms with the kinematic states come first.
    for (std::size_t i = bias_row(s); i < bias_row(s) + 6; ++i) transition.apply(&covariance_(i, 0));
  }
}

void Filter::predict_biases(double dt_s, const Settings& settings) {
  std::array<double, kMaxSources> kept{};
  for (std::size_t s = 0; s < settings.sources.size(); ++s) {
    const SourceSettings& source = settings.sources[s];
    kept[s] = source.relative ? 1.0 : std::exp(-std::abs(dt_s) / source.bias_time_constant_s);
  }
  for (std::size_t s = 0; s < settings.sources.size(); ++s) {
    if (!active_[s]) continue;
    const SourceSettings& source = settings.sources[s];
    const double gained =
        source.relative ? 2.0 * std::abs(dt_s) / source.bias_time_constant_s : 1.0 - kept[s] * kept[s];
    const Matrix6 stationary = stationary_bias(static_cast<std::uint8_t>(s), source);
    const std::size_t first = bias_row(s);
    for (std::size_t i = first; i < first + 6; ++i) {
      for (std::size_t j = 0; j < kKinematic; ++j) covariance_(i, j) *= kept[s];
      for (std::size_t other = 0; other <= s; ++other) {
        const std::size_t begin = bias_row(other);
        for (std::size_t j = begin; j < std::min(begin + 6, i + 1); ++j) covariance_(i, j) *= kept[s] * kept[other];
      }
      for (std::size_t j = first; j <= i; ++j) {
        covariance_(i, j) += gained * stationary(static_cast<int>(i - first), static_cast<int>(j - first));
      }
    }
    if (!source.relative) {
      bias_[s].R = rotation_exp(kept[s] * rotation_log(bias_[s].R));
      bias_[s].t *= kept[s];
    }
  }
}

Innovation Filter::innovation(const TargetMeasurement& m, const Settings& settings, bool second) const {
  const SourceSettings& source = settings.sources[m.source];
  const TargetPose expected = expected_pose(m.source, source);
  const TargetPose pose = completed(second && m.second ? *m.second : m.pose, m.directions, expected);
  const Derivatives d = derivatives(mean_, bias_[m.source], source);
  Innovation out;
  out.rank = m.directions.rank;
  out.residual = pose_difference(pose, expected);
  // The axis that is not measured is taken where the state has it, not where the noise of each measurement puts it:
  // else a rotation known to 1 rad would be measured by its projection on ever new axes.
  Matrix6 rows = m.directions.rows;
  if (out.rank < 6) rows.leftCols<3>() = rows.leftCols<3>() * (pose.R * expected.R.transpose());
  out.derivatives << rows * d.by_pose, rows * d.by_bias;
  Kinematic12 P;  // of pose and this bias
  const std::size_t first = bias_row(m.source);
  const Matrix6 cross = block_of(covariance_, first, 0);
  P << block_of(covariance_, 0, 0), cross.transpose(), cross, block_of(covariance_, first, first);
  Matrix6 noise = m.covariance * m.noise_factor();
  const double own_time_sigma_s = static_cast<double>(m.time_sigma_s);
  const double time_variance = source.time_sigma_s * source.time_sigma_s + own_time_sigma_s * own_time_sigma_s;
  if (time_variance > 0.0) {
    Vector6 motion;
    motion << mean_.rate_rad_s, mean_.velocity_m_s;
    noise += motion * motion.transpose() * time_variance;
  }
  // Lazy products: the others of this size link the heap.
  const Eigen::Matrix<double, 6, kKinematic> seen = out.derivatives.lazyProduct(P);
  const Matrix6 S = Matrix6(seen.lazyProduct(out.derivatives.transpose())) + Matrix6(rows * noise * rows.transpose());
  out.ok = factorise(S, out.rank, out.factor);
  if (!out.ok) return out;
  out.whitened = solve_lower(out.factor, out.rank, rows * out.residual);
  for (int i = 0; i < out.rank; ++i) {
    out.nis += out.whitened[i] * out.whitened[i];
    out.log_det += 2.0 * std::log(out.factor(i, i));
  }
  return out;
}

bool Filter::second_fits_better(const TargetMeasurement& m, const Settings& settings) const {
  if (!m.second) return false;
  const Innovation first = innovation(m, settings);
  const Innovation other = innovation(m, settings, true);
  return other.ok && (!first.ok || other.nis < first.nis);
}

// T = P H^T C^-T, P -= T T^T, state += T whitened, in blocks of six rows: rows of the packed lower triangle are
// contiguous.
void Filter::correct(const Innovation& in, std::uint8_t source, const Settings& settings) {
  active_[source] = true;
  // Blocks that a correction changes: the kinematic states and the biases that are part of the state.
  std::array<std::size_t, kStates / 6> begin;
  std::size_t count = 0;
  for (std::size_t i = 0; i < kKinematic; i += 6) begin[count++] = i;
  for (std::size_t s = 0; s < settings.sources.size(); ++s) {
    if (active_[s]) begin[count++] = bias_row(s);
  }
  std::array<Matrix6, kStates / 6> T;
  std::array<double, kStates> delta{};
  const Matrix6 by_pose = in.derivatives.leftCols<6>().transpose();
  const Matrix6 by_bias = in.derivatives.rightCols<6>().transpose();
  for (std::size_t k = 0; k < count; ++k) {
    T[k] = block_of(covariance_, begin[k], 0).lazyProduct(by_pose);
    T[k] += block_of(covariance_, begin[k], bias_row(source)).lazyProduct(by_bias);
    divide_by_transpose(in.factor, in.rank, T[k]);
    Vector6::Map(&delta[begin[k]]) = T[k].lazyProduct(in.whitened);
  }
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < 6; ++i) {
      const RowVector6 row = T[k].row(static_cast<int>(i));
      double* const to = &covariance_(begin[k] + i, 0);
      for (std::size_t l = 0; l < k; ++l) RowVector6::Map(to + begin[l]) -= row.lazyProduct(T[l].transpose());
      for (std::size_t j = 0; j <= i; ++j) to[begin[k] + j] -= row.dot(T[k].row(static_cast<int>(j)));
    }
  }
  shift(delta);
}

void Filter::shift(const std::array<double, kStates>& delta) {
  const auto part = [&](std::size_t first) { return Vector3(delta[first], delta[first + 1], delta[first + 2]); };
  mean_.pose.R = orthonormalised(rotation_exp(part(0)) * mean_.pose.R);
  mean_.pose.t += part(3);
  mean_.rate_rad_s += part(6);
  mean_.velocity_m_s += part(9);
  for (std::size_t s = 0; s < kMaxSources; ++s) {
    if (!active_[s]) continue;
    bias_[s].R = orthonormalised(rotation_exp(part(bias_row(s))) * bias_[s].R);
    bias_[s].t += part(bias_row(s) + 3);
  }
}

Matrix6 Filter::pose_covariance() const { return block_of(covariance_, 0, 0); }

Kinematic12 Filter::kinematic_covariance() const {
  const Matrix6 cross = block_of(covariance_, 6, 0);
  Kinematic12 out;
  out << block_of(covariance_, 0, 0), cross.transpose(), cross, block_of(covariance_, 6, 6);
  return out;
}

}  // namespace pharos::fusion
