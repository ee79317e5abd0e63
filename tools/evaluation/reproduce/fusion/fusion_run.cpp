// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/fusion/fusion_run.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "pharos/geometry/symmetric.hpp"
#include "tools/evaluation/reproduce/fusion/fusion_scenario.hpp"

namespace pharos::tools {
namespace {

constexpr int kLooks_hz = 20;
constexpr double kSettled_s = 5.0;

using fusion::Mode;
using fusion::SourceState;

// One look at the state beside the truth of that instant.
class Judge {
 public:
  Judge(const sim::SourceFault& fault, std::size_t sources) : fault_(fault), sources_(sources) {}

  void look(const fusion::TargetState& state, const sim::TruthState& truth, RunFigures& out) {
    if (!state.valid && out.looks == 0) return;
    if (out.looks++ == 0) first_s_ = truth.time_s;
    look_at_sources(state, truth.time_s, out);
    if (!state.valid) return;
    ++out.answered;
    out.fused += state.mode == Mode::kFused ? 1 : 0;
    const Vector6 error = pose_difference(truth.pose, state.kinematics.pose);
    const double rotation = error.head<3>().norm();
    const double position = error.tail<3>().norm();
    const fusion::ProtectionLevel& level = state.protection;
    const double ratio = std::max(level.rotation_available ? rotation / level.rotation_rad : 0.0,
                                  level.position_available ? position / level.position_m : 0.0);
    const bool both = level.rotation_available && level.position_available;
    out.protected_looks += both ? 1 : 0;
    out.position_levels += level.position_available ? 1 : 0;
    out.largest_ratio = std::max(out.largest_ratio, ratio);
    out.outside += ratio > 1.0 ? 1 : 0;
    if (state.mode != Mode::kFused || truth.time_s - first_s_ < kSettled_s) return;
    ++out.settled;
    Vector6 rates;
    rates << truth.rate_rad_s - state.kinematics.rate_rad_s, truth.velocity_m_s - state.kinematics.velocity_m_s;
    const Matrix6 P = state.covariance.topLeftCorner<6, 6>();
    const Matrix6 Q = state.covariance.bottomRightCorner<6, 6>();
    out.pose_nees += mahalanobis_squared<6>(error, P);
    out.rate_nees += mahalanobis_squared<6>(rates, Q);
    out.position_m2 += position * position;
    out.rotation_rad2 += rotation * rotation;
    out.rate_rad2_s2 += rates.head<3>().squaredNorm();
    out.velocity_m2_s2 += rates.tail<3>().squaredNorm();
    if (!both) return;
    ++out.settled_levels;
    out.level_position_m += level.position_m;
    out.level_rotation_rad += level.rotation_rad;
  }

 private:
  void look_at_sources(const fusion::TargetState& state, double time_s, RunFigures& out) const {
    const bool faulty = fault_.kind != sim::SourceFaultKind::kNone && time_s >= fault_.from_s;
    bool wrong = false;
    for (std::size_t s = 0; s < sources_; ++s) {
      if (state.sources[s].state != SourceState::kExcluded) continue;
      if (faulty && s == fault_.source) {
        if (!out.excluded_after_s) {
          out.excluded_after_s = time_s - fault_.from_s;
          out.reason = state.sources[s].reason;
        }
      } else {
        wrong = true;
      }
    }
    out.wrong_excluded += wrong ? 1 : 0;
    if (state.mode != Mode::kConflict) return;
    ++out.conflict;
    if (faulty && !out.conflict_after_s) out.conflict_after_s = time_s - fault_.from_s;
  }

  sim::SourceFault fault_;
  std::size_t sources_;
  double first_s_ = 0.0;
};

}  // namespace

RunFigures run_fusion(const sim::WorldSettings& settings, const fusion::Settings& fusion_settings) {
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = std::make_unique<fusion::TargetEstimator>(fusion_settings);
  RunFigures out;
  Judge judge(settings.fault, settings.sources.size());
  constexpr std::size_t kStep = sim::kWorldRate_hz / kLooks_hz;
  std::size_t next = 0;
  for (const sim::SimulatedPose& pose : world.poses) {
    for (; next < world.truth.size() && world.truth[next].time_s < pose.arrival_s; next += kStep) {
      judge.look(estimator->state(std::llround(world.truth[next].time_s * 1e9)), world.truth[next], out);
    }
    estimator->push(measurement_of(pose));
  }
  out.counters = estimator->counters();
  return out;
}

}  // namespace pharos::tools
