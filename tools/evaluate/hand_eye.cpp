// SPDX-License-Identifier: Apache-2.0
// Closed-form starts.
#include <algorithm>
#include <cmath>

#include "host/linear/dense.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "tools/evaluate/alignment.hpp"

namespace pharos::evaluate {
namespace {

constexpr std::size_t kKeyPoses = 80;  // 3160 relative motions
constexpr int kTrimRounds = 6;
constexpr double kTrim = 3.0;  // times the median residual
constexpr double kMinTurn_rad = 0.02;
constexpr double kMaxTurn_rad = 3.0;  // near a half turn the sign of the rotation vector is ambiguous
constexpr double kMinSwing = 0.03;    // with a smaller rotation the length of a lever arm is unobservable

std::vector<Pair> spread(const std::vector<Pair>& pairs) {
  std::vector<Pair> chosen;
  const std::size_t count = std::min(kKeyPoses, pairs.size());
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(pairs[i * pairs.size() / count]);
  return chosen;
}

/// Weights 1 or 0: 1 for residuals within kTrim times the median.
std::vector<double> trimmed(const std::vector<double>& residuals) {
  std::vector<double> sorted = residuals;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  std::vector<double> weights;
  weights.reserve(residuals.size());
  for (const double r : residuals) weights.push_back(r <= kTrim * *middle + 1e-12 ? 1.0 : 0.0);
  return weights;
}

/// R with a_i = R b_i for most i.
Matrix3 rotation_between(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  std::vector<double> weights(a.size(), 1.0);
  Matrix3 R = Matrix3::Identity();
  for (int round = 0; round < kTrimRounds && !a.empty(); ++round) {
    Matrix3 C = Matrix3::Zero();
    for (std::size_t i = 0; i < a.size(); ++i) C += weights[i] * a[i] * b[i].transpose();
    R = host::nearest_rotation(C).R;
    std::vector<double> residuals;
    for (std::size_t i = 0; i < a.size(); ++i) residuals.push_back((a[i] - R * b[i]).norm());
    weights = trimmed(residuals);
  }
  return R;
}

/// Mean of rotations, most of which agree.
Matrix3 mean_rotation(const std::vector<Matrix3>& rotations) {
  std::vector<double> weights(rotations.size(), 1.0);
  Matrix3 mean = Matrix3::Identity();
  for (int round = 0; round < kTrimRounds && !rotations.empty(); ++round) {
    Matrix3 C = Matrix3::Zero();
    for (std::size_t i = 0; i < rotations.size(); ++i) C += weights[i] * rotations[i];
    mean = host::nearest_rotation(C).R;
    std::vector<double> residuals;
    for (const Matrix3& R : rotations) residuals.push_back(rotation_angle_between(R, mean));
    weights = trimmed(residuals);
  }
  return mean;
}

Matrix3 body_rotation(const std::vector<Pair>& key) {
  std::vector<Vector3> of_truth;
  std::vector<Vector3> of_estimate;
  for (std::size_t i = 0; i < key.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vector3 a = rotation_log(key[j].truth.pose.R.transpose() * key[i].truth.pose.R);
      const Vector3 b = rotation_log(key[j].estimate.pose.R.transpose() * key[i].estimate.pose.R);
      const double minimum = std::min(a.norm(), b.norm());
      if (minimum < kMinTurn_rad || std::max(a.norm(), b.norm()) > kMaxTurn_rad) continue;
      of_truth.push_back(a);
      of_estimate.push_back(b);
    }
  }
  return rotation_between(of_truth, of_estimate);
}

/// Offsets for known rotations: Rx Rt ty + tx = te - Rx tt. Unobservable directions of ty remain 0.
void fill_offsets(const std::vector<Pair>& key, Alignment& alignment) {
  std::vector<double> weights(key.size(), 1.0);
  for (int round = 0; round < kTrimRounds; ++round) {
    double n = 0.0;
    Matrix3 mean_A = Matrix3::Zero();
    Vector3 mean_b = Vector3::Zero();
    const auto A_of = [&](const Pair& p) -> Matrix3 { return alignment.world.R * p.truth.pose.R; };
    const auto b_of = [&](const Pair& p) -> Vector3 { return p.estimate.pose.t - alignment.world.R * p.truth.pose.t; };
    for (std::size_t i = 0; i < key.size(); ++i) {
      n += weights[i], mean_A += weights[i] * A_of(key[i]), mean_b += weights[i] * b_of(key[i]);
    }
    mean_A /= n, mean_b /= n;
    Matrix3 N = Matrix3::Zero();
    Vector3 g = Vector3::Zero();
    for (std::size_t i = 0; i < key.size(); ++i) {
      const Matrix3 A = A_of(key[i]) - mean_A;
      N += weights[i] / n * A.transpose() * A, g += weights[i] / n * A.transpose() * (b_of(key[i]) - mean_b);
    }
    const SymmetricEigen<3> eigen = symmetric_eigen<3>(N);
    alignment.body.t.setZero();
    for (int k = 0; k < 3; ++k) {
      if (eigen.values[k] < kMinSwing * kMinSwing) continue;
      const Vector3 axis = eigen.vectors.col(k);
      alignment.body.t += axis * (axis.dot(g) / eigen.values[k]);
    }
    alignment.world.t = mean_b - mean_A * alignment.body.t;
    std::vector<double> residuals;
    for (const Pair& p : key) residuals.push_back((p.estimate.pose.t - alignment.predicted(p.truth.pose).t).norm());
    weights = trimmed(residuals);
  }
}

}  // namespace

Alignment hand_eye_start(const std::vector<Pair>& pairs) {
  const std::vector<Pair> key = spread(pairs);
  Alignment alignment;
  alignment.body.R = body_rotation(key);
  std::vector<Matrix3> worlds;
  for (const Pair& p : key) worlds.push_back(p.estimate.pose.R * (p.truth.pose.R * alignment.body.R).transpose());
  alignment.world.R = mean_rotation(worlds);
  fill_offsets(key, alignment);
  return alignment;
}

Alignment path_start(const std::vector<Pair>& pairs) {
  const std::vector<Pair> key = spread(pairs);
  Alignment alignment;
  alignment.world.R = se3_of_positions(key, alignment).world.R;
  std::vector<Matrix3> bodies;
  for (const Pair& p : key) bodies.push_back((alignment.world.R * p.truth.pose.R).transpose() * p.estimate.pose.R);
  alignment.body.R = mean_rotation(bodies);
  fill_offsets(key, alignment);
  return alignment;
}

PositionFit se3_of_positions(const std::vector<Pair>& pairs, const Alignment& present) {
  const auto from = [&present](const Pair& p) -> Vector3 { return (p.truth.pose * present.body).t; };
  const double n = static_cast<double>(pairs.size());
  Vector3 mean_e = Vector3::Zero();
  Vector3 mean_t = Vector3::Zero();
  for (const Pair& p : pairs) mean_e += p.estimate.pose.t / n, mean_t += from(p) / n;
  Matrix3 C = Matrix3::Zero();
  Matrix3 extent = Matrix3::Zero();
  for (const Pair& p : pairs) {
    const Vector3 d = from(p) - mean_t;
    C += (p.estimate.pose.t - mean_e) * d.transpose();
    extent += d * d.transpose() / n;
  }
  PositionFit fit;
  fit.world.R = host::nearest_rotation(C).R;
  fit.world.t = mean_e - fit.world.R * mean_t;
  fit.second_extent_m = std::sqrt(std::max(0.0, symmetric_eigen<3>(extent).values[1]));
  return fit;
}

}  // namespace pharos::evaluate
