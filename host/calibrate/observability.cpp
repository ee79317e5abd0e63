// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/observability.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "pharos/geometry/rotation.hpp"

namespace pharos::calibrate {
namespace {

// Of the sensors that fix the body frame.
Vector3 middle_of_hit(const BundleProblem& problem, const ParameterBlocks& blocks) {
  Vector3 sum = Vector3::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < blocks.hit.size(); ++i) {
    if (!blocks.hit[i]) continue;
    sum += problem.nominal.target[i].position_m;
    count += 1.0;
  }
  return sum / std::max(count, 1.0);
}

// The sensors' prior with the body frame fixed: an isotropic prior without the six rigid motions of the sensors that
// fix the frame.
Eigen::MatrixXd framed_prior(const BundleProblem& problem, const ParameterBlocks& blocks) {
  const auto n = static_cast<Eigen::Index>(blocks.sensor.size());
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(3 * n, 6);
  const Vector3 middle = middle_of_hit(problem, blocks);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!blocks.hit[static_cast<std::size_t>(i)]) continue;
    motions.block<3, 3>(3 * i, 0) = Matrix3::Identity();
    motions.block<3, 3>(3 * i, 3) = -skew(problem.nominal.target[static_cast<std::size_t>(i)].position_m - middle);
  }
  const Matrix6 gram = motions.transpose() * motions;
  const double variance = problem.sigmas.sensor_position_m * problem.sigmas.sensor_position_m;
  Eigen::MatrixXd prior = Eigen::MatrixXd::Identity(3 * n, 3 * n);
  prior -= motions * gram.ldlt().solve(motions.transpose());
  return variance * prior;
}

// Relative growth of the sensors that were hit as a linear function of all sensor coordinates.
Eigen::VectorXd growth(const BundleProblem& problem, const ParameterBlocks& blocks) {
  const std::size_t n = blocks.sensor.size();
  const Vector3 middle = middle_of_hit(problem, blocks);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * n));
  double square = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!blocks.hit[i]) continue;
    const Vector3 arm = problem.nominal.target[i].position_m - middle;
    out.segment<3>(static_cast<Eigen::Index>(3 * i)) = arm;
    square += arm.squaredNorm();
  }
  return out / square;
}

}  // namespace

Information::Information(const SparseRows& jacobian, const BundleProblem& problem, const ParameterBlocks& blocks)
    : jacobian_(jacobian), problem_(problem), blocks_(blocks) {
  // Scaled to a unit diagonal: metres and radians differ by orders of magnitude.
  Eigen::MatrixXd normal = Eigen::MatrixXd(SparseRows(jacobian.transpose() * jacobian));
  const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
  normal = scale.asDiagonal() * normal * scale.asDiagonal();
  covariance_ = normal.ldlt().solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
  covariance_ = scale.asDiagonal() * covariance_ * scale.asDiagonal();
}

double Information::leverage(std::size_t row) const {
  using Entry = SparseRows::InnerIterator;
  double sum = 0.0;
  for (Entry a(jacobian_, static_cast<Eigen::Index>(row)); a; ++a) {
    for (Entry b(jacobian_, static_cast<Eigen::Index>(row)); b; ++b) {
      sum += a.value() * covariance_(a.col(), b.col()) * b.value();
    }
  }
  return sum;
}

void Information::fill(BundleResult& result) const {
  const auto n = static_cast<Eigen::Index>(result.parameters.size());
  result.covariance = covariance_.topLeftCorner(n, n);
  const Eigen::MatrixXd sensor_prior = framed_prior(problem_, blocks_);
  const Eigen::Index sensors = sensor_prior.rows();
  const auto rotors = static_cast<Eigen::Index>(blocks_.rotor.size() * kAxes * kRotorParameters);
  for (Eigen::Index i = 0; i < n; ++i) {
    Parameter& parameter = result.parameters[static_cast<std::size_t>(i)];
    parameter.sigma = std::sqrt(std::max(result.covariance(i, i), 0.0));
    if (i < sensors) {
      parameter.prior_sigma = std::sqrt(sensor_prior(i, i));
    } else if (i < sensors + rotors) {
      parameter.prior_sigma = problem_.sigmas.rotor[static_cast<std::size_t>(i - sensors) % kRotorParameters];
    }
  }
  const Eigen::VectorXd grown = growth(problem_, blocks_);
  result.scale_prior_sigma = std::sqrt(grown.dot(sensor_prior * grown));
  result.scale_sigma = std::sqrt(grown.dot(result.covariance.topLeftCorner(sensors, sensors) * grown));
}

}  // namespace pharos::calibrate
