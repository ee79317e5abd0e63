// SPDX-License-Identifier: Apache-2.0
// Any bytes as observations of the frustum target, with or without a prior: a finite pose, or a refusal.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "pharos/pose/solve.hpp"
#include "support/require.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace {

using pharos::pose::Observation;
using pharos::test::require;

constexpr std::size_t kHeader = 4;       // start, residual, sigma, prior
constexpr std::size_t kObservation = 9;  // sensor and axis, theta

pharos::pose::SolveOptions options_from(const std::uint8_t* header) {
  pharos::pose::SolveOptions options;
  options.start = static_cast<pharos::pose::Start>(header[0] % 5);
  options.residual = static_cast<pharos::pose::Residual>(header[1] % 2);
  options.sigma_rad = pharos::kPaperSigma_rad * (1 + header[2]);
  options.rho = header[2] % 3 == 0 ? pharos::kPaperRho : 0.0;
  return options;
}

void check(const pharos::LighthousePoseEstimate& e) {
  require(e.pose.is_finite() && e.covariance.allFinite());
  require(std::isfinite(e.residual_rms) && std::isfinite(e.adop_deg_per_rad) && std::isfinite(e.pdop_m_per_rad));
  require((e.pose.R.transpose() * e.pose.R - pharos::Matrix3::Identity()).norm() < 1e-9);
  require(!e.second || (e.second->pose.is_finite() && e.second->delta_chi2 < pharos::kAmbiguousDeltaChi2));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kHeader) return 0;
  static const pharos::Target target = pharos::test::frustum_target();
  pharos::pose::Observations observations;
  for (std::size_t at = kHeader; at + kObservation <= size; at += kObservation) {
    Observation o;
    o.sensor = data[at] >> 1;
    o.axis = data[at] % 2 == 0 ? pharos::Axis::kX : pharos::Axis::kY;
    std::memcpy(&o.theta_rad, data + at + 1, sizeof o.theta_rad);
    observations.push_back(o);
  }
  const pharos::LighthouseFromBody prior{pharos::rotation_exp({data[3] * 0.02, 1.0, -0.5}), {0.1, -0.2, 2.0}};
  const auto solution =
      pharos::pose::solve(target, observations, options_from(data), data[3] % 2 == 0 ? nullptr : &prior);
  if (solution.ok()) {
    check(solution->estimate);
    require(static_cast<int>(solution->used.count()) == solution->estimate.observations);
  }
  return 0;
}
