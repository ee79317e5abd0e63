// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/proof.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/fusion/chi_squared.hpp"
#include "pharos/geometry/symmetric.hpp"

namespace pharos::fusion {
namespace {

constexpr double kOffsetProbability = 1e-3;  // of a sound source's offset being refused, each time that it has proved
constexpr double kBesideNis = 2.0;  // a freedom: errors that last for a second are 18 draws in a proof, 3 sigma

// d^T M^-1 d of the measured directions.
double distance_squared(const Directions& directions, const Vector6& d, const Matrix6& M) {
  Matrix6 measured = Matrix6::Identity();
  measured.topLeftCorner(directions.rank, directions.rank) = M.topLeftCorner(directions.rank, directions.rank);
  Vector6 along = directions.rows * d;
  for (int i = directions.rank; i < 6; ++i) along[i] = 0.0;
  return mahalanobis_squared<6>(along, measured);
}

}  // namespace

void Proof::add(std::int64_t time_ns) {
  if (count == 0) since_ns = time_ns;
  ++count;
}

void Proof::add(const Innovation& in, const TargetMeasurement& m) {
  add(m.time_ns);
  nis += in.nis;
  dof += in.rank;
  const Vector6 from_mean = in.residual - mean;
  mean += from_mean / count;
  if (count == 1) return;
  const Matrix6 S = Matrix6(in.factor.lazyProduct(in.factor.transpose()));
  scatter += distance_squared(m.directions, from_mean, S) * (count - 1.0) / count;
  scatter_dof += in.rank;
}

bool Proof::long_enough(std::int64_t time_ns, const DetectionSettings& detection) const {
  return count >= detection.proof_measurements && static_cast<double>(time_ns - since_ns) * 1e-9 >= detection.proof_s;
}

bool Proof::is_sound(const Innovation& last, const TargetMeasurement& m) const {
  if (!(scatter < scatter_dof * (1.0 + 3.0 * std::sqrt(2.0 / scatter_dof)))) return false;
  const Matrix6 S = Matrix6(last.factor.lazyProduct(last.factor.transpose()));
  const Matrix6 noise = Matrix6(m.directions.rows * m.covariance * m.directions.rows.transpose());
  const Matrix6 of_mean = S - noise * (1.0 - std::min(1.0, m.correlation / count));
  return distance_squared(m.directions, mean, of_mean) < chi_squared_bound(kOffsetProbability, last.rank);
}

bool Proof::fits_beside() const { return nis < dof * kBesideNis; }

}  // namespace pharos::fusion
