// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/fault_injection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/linear/dense.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/approach/source_errors.hpp"

namespace pharos::sim {
namespace {

constexpr double kBurstRatio = 0.5;
constexpr double kOtherTarget_m = 0.8;
constexpr double kOtherTargetTurn_rad = 40.0 * kRadPerDeg;
constexpr double kOtherTargetSpeed_m_s = 0.005;

// A vector of `sigmas` in the metric of the covariance, in a random direction of those that were measured.
Vector6 error_of(const ApproachMeasurement& m, double sigmas, const Vector6& direction) {
  const host::DenseEigen eigen = host::dense_eigen(m.covariance);
  const Vector6 root = eigen.values.cwiseMax(0.0).cwiseSqrt();
  return eigen.vectors * root.cwiseProduct(sigmas * (eigen.vectors.transpose() * direction));
}

class Injection {
 public:
  Injection(const DrawnFault& fault, double ramp_s, std::uint64_t seed)
      : fault_(fault),
        ramp_s_(ramp_s),
        random_(seed, "fault"),
        direction_(normal6(random_).normalized()),
        aside_(normal3(random_).normalized()),
        turn_(normal3(random_).normalized()) {}

  void apply(ApproachMeasurement& m) {
    if (!first_error_) first_error_ = error_of(m, fault_.amount, direction_);
    m.faulty = true;
    const double since_s = m.true_time_s - fault_.from_s;
    switch (fault_.kind) {
      case ApproachFaultKind::kStep:
        return move(m, *first_error_);
      case ApproachFaultKind::kRamp:
        return move(m, std::min(since_s / ramp_s_, 1.0) * *first_error_);
      case ApproachFaultKind::kFreeze:
        return freeze(m);
      case ApproachFaultKind::kWrongTime:
        m.time_s += fault_.amount;
        return;
      case ApproachFaultKind::kScale:
        m.pose.t *= 1.0 + fault_.amount;
        if (m.second) m.second->t *= 1.0 + fault_.amount;
        return;
      case ApproachFaultKind::kMirrored:
        m.pose = mirrored(m.pose, 0.0).value_or(m.pose);
        m.second.reset();
        return;
      case ApproachFaultKind::kWrongTarget:
        m.second.reset();
        m.pose.R = rotation_exp(kOtherTargetTurn_rad * turn_) * m.pose.R;
        m.pose.t += (kOtherTarget_m + kOtherTargetSpeed_m_s * since_s) * aside_;
        return;
      case ApproachFaultKind::kBurst:
        burst(m);
    }
  }

  void before(const ApproachMeasurement& m) { frozen_ = m; }

 private:
  static void move(ApproachMeasurement& m, const Vector6& error) {
    m.pose = m.pose.moved_by(error);
    if (m.second) m.second = m.second->moved_by(error);
  }
  void freeze(ApproachMeasurement& m) {
    if (!frozen_) frozen_ = m;
    m.pose = frozen_->pose;
    m.covariance = frozen_->covariance;
    m.second = frozen_->second;
    m.delta_chi2 = frozen_->delta_chi2;
  }
  void burst(ApproachMeasurement& m) {
    const bool wrong = random_.chance(kBurstRatio);
    const Vector6 direction = normal6(random_).normalized();
    m.faulty = wrong;
    if (wrong) move(m, error_of(m, fault_.amount, direction));
  }

  const DrawnFault& fault_;
  double ramp_s_;
  RandomStream random_;
  Vector6 direction_;
  Vector3 aside_, turn_;
  std::optional<Vector6> first_error_;
  std::optional<ApproachMeasurement> frozen_;
};

}  // namespace

void inject(const DrawnFault& fault, double ramp_s, std::uint64_t seed,
            std::vector<ApproachMeasurement>& measurements) {
  Injection injection(fault, ramp_s, seed);
  for (ApproachMeasurement& m : measurements) {
    if (!m.seen) continue;
    if (m.true_time_s < fault.from_s) injection.before(m);
    if (m.true_time_s < fault.from_s || m.true_time_s >= fault.to_s) continue;
    injection.apply(m);
    if (!m.has_turn) m.pose = without_turn(m.pose);
  }
}

}  // namespace pharos::sim
