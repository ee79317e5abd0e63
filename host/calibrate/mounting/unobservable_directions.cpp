// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/mounting/unobservable_directions.hpp"

#include <array>
#include <cmath>

#include "host/linear/dense.hpp"
#include "host/support/rounded_number.hpp"

namespace pharos::calibrate {
namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

constexpr double kHardlyTold = 0.25;  // of the prior's variance: half of its sigma
constexpr double kInvolved = 0.15;    // of the direction's square: parts below are not named

struct Part {
  const char* words;
  Eigen::Index at;
};
constexpr std::array<Part, 4> kParts{{{"rotation of T_vehicle_sensor about ", 0},
                                      {"translation of T_vehicle_sensor along ", 3},
                                      {"rotation of T_target_feature about ", 6},
                                      {"translation of T_target_feature along ", 9}}};

std::string axis_text(const Vector3& axis) {
  std::string out = "(";
  for (int i = 0; i < 3; ++i) out += host::rounded_number(axis[i], 2) + (i < 2 ? ", " : ")");
  return out;
}

std::string direction_text(const Vector12& direction) {
  std::string out;
  for (const Part& part : kParts) {
    const Vector3 piece = direction.segment<3>(part.at);
    if (piece.squaredNorm() < kInvolved) continue;
    Eigen::Index largest = 0;
    piece.cwiseAbs().maxCoeff(&largest);
    const double sign = piece[largest] < 0.0 ? -1.0 : 1.0;
    out += (out.empty() ? "" : " with ") + std::string(part.words) + axis_text(sign * piece.normalized());
  }
  return out;
}

}  // namespace

std::vector<std::string> unobservable_directions(const UnknownSource& source, const SourceCovariance& covariance) {
  Matrix12 prior = Matrix12::Zero();
  prior.topLeftCorner<6, 6>() = source.prior_sensor_covariance;
  prior.bottomRightCorner<6, 6>() = source.prior_feature_covariance;
  const host::DenseEigen root = host::dense_eigen(prior);
  const Vector12 sigma = root.values.cwiseMax(1e-18).cwiseSqrt();
  const Matrix12 whiten = root.vectors * sigma.cwiseInverse().asDiagonal() * root.vectors.transpose();
  const host::DenseEigen eigen = host::dense_eigen(whiten * covariance.topLeftCorner<12, 12>() * whiten);
  std::vector<std::string> out;
  for (int i = 11; i >= 0 && eigen.values[i] > kHardlyTold; --i) {
    out.push_back(direction_text(eigen.vectors.col(i)));
  }
  if (covariance(12, 12) > kHardlyTold * source.prior_offset_sigma_s * source.prior_offset_sigma_s) {
    out.emplace_back("time offset");
  }
  return out;
}

}  // namespace pharos::calibrate
