// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "host/linear/dense.hpp"
#include "pharos/base/units.hpp"

namespace pharos::evaluate {
namespace {

constexpr int kParameters = 13;  // world rotation, world offset, body rotation, body offset, time
constexpr int kTime = 12;
using Vector13 = Eigen::Matrix<double, kParameters, 1>;
using Matrix13 = Eigen::Matrix<double, kParameters, kParameters>;
using Jacobian = Eigen::Matrix<double, 6, kParameters>;

constexpr std::size_t kMaxPairs = 4000;
constexpr double kIndependentPairs = 100.0;
constexpr double kMedianOfChi3 = 1.538;
constexpr double kCauchy = 4.0;      // in one-dimensional sigmas of a 3-vector: 95 % efficient
constexpr double kMinSpread = 1e-4;  // rad and m: about the resolution of the recordings themselves
constexpr int kMaxSteps = 60;
constexpr int kMaxHalvings = 8;
constexpr double kUnitRotation_rad = 1.0 * kRadPerDeg;  // limit of observability: see UnobservableDirection
constexpr double kUnitOffset_m = 0.02;
constexpr double kUnitTime_s = 0.02;
constexpr double kPartShown = 0.2;

Vector13 units() {
  Vector13 u;
  u << Vector3::Constant(kUnitRotation_rad), Vector3::Constant(kUnitOffset_m), Vector3::Constant(kUnitRotation_rad),
      Vector3::Constant(kUnitOffset_m), kUnitTime_s;
  return u;
}

Alignment moved(const Alignment& a, const Vector13& delta) {
  return {a.world.moved_by(delta.head<6>()), a.body.moved_by(delta.segment<6>(6)), a.time_offset_s + delta[kTime]};
}

Vector6 residual_of(const Pair& pair, const Alignment& a) {
  return pose_difference(pair.estimate.pose, a.predicted(pair.truth.pose));
}

/// Of the predicted pose, for the parameters of moved().
Jacobian jacobian_of(const Pair& pair, const Alignment& a) {
  const TruthPose& truth = pair.truth.pose;
  const Matrix3 R_world_body = a.world.R * truth.R;
  const Vector3 lever = truth.R * a.body.t;
  Jacobian J = Jacobian::Zero();
  J.block<3, 3>(0, 0).setIdentity();
  J.block<3, 3>(3, 0) = -skew(a.world.R * (lever + truth.t));
  J.block<3, 3>(3, 3).setIdentity();
  J.block<3, 3>(0, 6) = R_world_body;
  J.block<3, 3>(3, 9) = R_world_body;
  J.block<3, 1>(0, kTime) = a.world.R * pair.truth.rate_rad_s;
  J.block<3, 1>(3, kTime) = a.world.R * (pair.truth.rate_rad_s.cross(lever) + pair.truth.velocity_m_s);
  return J;
}

struct Spread {
  double rotation_rad = kMinSpread;
  double position_m = kMinSpread;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Spread spread_of(const std::vector<Pair>& pairs, const Alignment& a) {
  std::vector<double> rotation;
  std::vector<double> position;
  for (const Pair& pair : pairs) {
    const Vector6 r = residual_of(pair, a);
    rotation.push_back(r.head<3>().norm());
    position.push_back(r.tail<3>().norm());
  }
  return {std::max(kMinSpread, median(std::move(rotation)) / kMedianOfChi3),
          std::max(kMinSpread, median(std::move(position)) / kMedianOfChi3)};
}

double square(double x) { return x * x; }

/// Mean of Cauchy's function over the pairs.
double cost_of(const std::vector<Pair>& pairs, const Alignment& a, const Spread& s) {
  double sum = 0.0;
  for (const Pair& pair : pairs) {
    const Vector6 r = residual_of(pair, a);
    sum += std::log1p(r.head<3>().squaredNorm() / square(kCauchy * s.rotation_rad)) +
           std::log1p(r.tail<3>().squaredNorm() / square(kCauchy * s.position_m));
  }
  return sum / static_cast<double>(pairs.size());
}

struct Normal {
  Matrix13 N = Matrix13::Zero();
  Vector13 g = Vector13::Zero();
};

/// In units of units(), for kIndependentPairs pairs at most.
Normal normal_of(const std::vector<Pair>& pairs, const Alignment& a, const Spread& s) {
  Normal normal;
  for (const Pair& pair : pairs) {
    const Vector6 r = residual_of(pair, a);
    const Jacobian J = jacobian_of(pair, a) * units().asDiagonal();
    const double wr = 1.0 / (square(s.rotation_rad) + r.head<3>().squaredNorm() / square(kCauchy));
    const double wt = 1.0 / (square(s.position_m) + r.tail<3>().squaredNorm() / square(kCauchy));
    Vector6 weights;
    weights << wr, wr, wr, wt, wt, wt;
    normal.N += J.transpose() * weights.asDiagonal() * J;
    normal.g += J.transpose() * weights.asDiagonal() * r;
  }
  const double fraction = std::min(1.0, kIndependentPairs / static_cast<double>(pairs.size()));
  normal.N *= fraction;
  normal.g *= fraction;
  return normal;
}

std::vector<int> parameters_of(FreeParts free) {
  std::vector<int> indices;
  for (int i = 0; i < kParameters; ++i) {
    if (i < 6 ? free.world : i < kTime ? free.body : free.time) indices.push_back(i);
  }
  return indices;
}

struct Step {
  Vector13 delta = Vector13::Zero();
  std::vector<UnobservableDirection> open;
};

Step step_of(const Normal& normal, FreeParts free) {
  const std::vector<int> indices = parameters_of(free);
  const Eigen::MatrixXd N = normal.N(indices, indices);
  const Eigen::VectorXd g = normal.g(indices);
  const host::DenseEigen eigen = host::dense_eigen(N);
  Step step;
  for (Eigen::Index k = 0; k < g.size(); ++k) {
    Vector13 direction = Vector13::Zero();
    for (std::size_t i = 0; i < indices.size(); ++i) {
      direction[indices[i]] = eigen.vectors(static_cast<Eigen::Index>(i), k);
    }
    const double information = eigen.values[k];
    if (information >= 1.0) {
      step.delta += direction * (eigen.vectors.col(k).dot(g) / information);
    } else {
      step.open.push_back({direction.segment<3>(0), direction.segment<3>(3), direction.segment<3>(6),
                           direction.segment<3>(9), direction[kTime]});
    }
  }
  step.delta = step.delta.cwiseProduct(units());
  return step;
}

std::vector<Pair> some_pairs(const Trajectory<EstimatePose>& estimate, const Trajectory<TruthPose>& truth,
                             double time_offset_s, double max_gap_s) {
  const std::size_t count = std::min(kMaxPairs, estimate.size());
  Trajectory<EstimatePose> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(estimate[i * estimate.size() / count]);
  return pair_up(chosen, truth, time_offset_s, max_gap_s).pairs;
}

std::string axis_words(const Vector3& axis) {
  std::array<char, 64> text{};
  const Vector3 n = axis.normalized();
  std::snprintf(text.data(), text.size(), "(%.2f, %.2f, %.2f)", n.x(), n.y(), n.z());
  return text.data();
}

}  // namespace

bool UnobservableDirection::turns() const { return std::max(world_rotation.norm(), body_rotation.norm()) > kPartShown; }

std::string UnobservableDirection::parts() const {
  std::string text;
  const auto add = [&text](const char* name, double size) {
    if (size > kPartShown) text += (text.empty() ? "" : "|") + std::string(name);
  };
  add("world_rotation", world_rotation.norm());
  add("world_offset", world_offset.norm());
  add("body_rotation", body_rotation.norm());
  add("body_offset", body_offset.norm());
  add("time", std::abs(time));
  return text;
}

std::string UnobservableDirection::words() const {
  std::string text;
  const auto add = [&text](const std::string& what, double size) {
    if (size > kPartShown) text += (text.empty() ? "" : " together with ") + what;
  };
  add("the turn between the worlds about " + axis_words(world_rotation) + " of ESTIMATE's world",
      world_rotation.norm());
  add("the offset of the worlds along " + axis_words(world_offset) + " of ESTIMATE's world", world_offset.norm());
  add("the turn between the bodies about " + axis_words(body_rotation) + " of TRUTH's body", body_rotation.norm());
  add("the offset of the bodies along " + axis_words(body_offset) + " of TRUTH's body", body_offset.norm());
  add("the time offset", std::abs(time));
  return text;
}

Aligned align(const Trajectory<EstimatePose>& estimate, const Trajectory<TruthPose>& truth, const Alignment& start,
              FreeParts free, double max_gap_s) {
  Aligned result{start, {}, 0.0};
  for (int i = 0; i < kMaxSteps; ++i) {
    Alignment& present = result.alignment;
    const std::vector<Pair> pairs = some_pairs(estimate, truth, present.time_offset_s, max_gap_s);
    if (pairs.empty()) return result;
    const Spread spread = spread_of(pairs, present);
    result.cost =
        cost_of(pairs, present, spread) + 2.0 * std::log(spread.rotation_rad) + 2.0 * std::log(spread.position_m);
    const Step step = step_of(normal_of(pairs, present, spread), free);
    result.open = step.open;
    const double before = cost_of(pairs, present, spread);
    double fraction = 1.0;
    for (int halving = 0; halving < kMaxHalvings; ++halving, fraction *= 0.5) {
      const Alignment next = moved(present, fraction * step.delta);
      const auto there = free.time ? some_pairs(estimate, truth, next.time_offset_s, max_gap_s) : pairs;
      if (!there.empty() && cost_of(there, next, spread) <= before) break;
    }
    const Vector13 delta = fraction * step.delta;
    present = moved(present, delta);
    if (delta.cwiseQuotient(units()).norm() < 1e-6) break;
  }
  result.alignment.world.R = orthonormalised(result.alignment.world.R);
  result.alignment.body.R = orthonormalised(result.alignment.body.R);
  return result;
}

}  // namespace pharos::evaluate
