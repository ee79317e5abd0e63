// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/fusion/fusion_world.hpp"
#include "tools/evaluation/reproduce/fusion/fusion_run.hpp"

namespace pharos::tests {
namespace {

using fusion::FaultKind;
using fusion::Mode;
using fusion::Refusal;
using fusion::SourceState;
using fusion::TargetEstimator;
using fusion::TargetState;
using tools::measurement_of;
using tools::settings_of;

std::unique_ptr<TargetEstimator> estimator_of(const sim::WorldSettings& world) {
  return std::make_unique<TargetEstimator>(settings_of(world, 1e-3));
}

bool equal(const TargetState& a, const TargetState& b) {
  const auto& [x, y] = std::pair(a.kinematics, b.kinematics);
  return a.mode == b.mode && x.pose.R == y.pose.R && x.pose.t == y.pose.t && x.rate_rad_s == y.rate_rad_s &&
         x.velocity_m_s == y.velocity_m_s && a.covariance == b.covariance &&
         a.protection.position_m == b.protection.position_m && a.protection.rotation_rad == b.protection.rotation_rad;
}

double position_error(const TargetState& state, const sim::MeasuredWorld& world) {
  const auto index = static_cast<std::size_t>(static_cast<double>(state.time_ns) * 1e-9 * sim::kWorldRate_hz + 0.5);
  return (state.kinematics.pose.t - world.truth[index].pose.t).norm();
}

// Everything at its end: the state after the whole world.
TargetState after(const sim::WorldSettings& settings, double time_s) {
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  std::size_t next = 0;
  feed(*estimator, world, time_s, next);
  return estimator->state(ns(time_s));
}

TEST(TargetEstimator, SearchesUntilAPoseIsConfirmed) {
  const sim::WorldSettings settings = world_of(1, {kLighthouse});
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  std::size_t next = 0;
  EXPECT_EQ(estimator->state(0).mode, Mode::kSearching);
  feed(*estimator, world, 0.02, next);
  EXPECT_EQ(estimator->state(ns(0.02)).mode, Mode::kSearching);
  feed(*estimator, world, 0.5, next);
  EXPECT_EQ(estimator->state(ns(0.5)).mode, Mode::kSingle);
}

TEST(TargetEstimator, LateMeasurementsGiveTheResultOfTheRightOrderBitByBit) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    sim::WorldSettings settings = tools::close_range_world(seed);
    settings.duration_s = 4.0;
    const sim::MeasuredWorld late = sim::simulate_world(settings);
    sim::MeasuredWorld ordered = late;
    std::stable_sort(ordered.poses.begin(), ordered.poses.end(), [](const auto& a, const auto& b) {
      return measurement_of(a).time_ns != measurement_of(b).time_ns
                 ? measurement_of(a).time_ns < measurement_of(b).time_ns
                 : a.source < b.source;
    });
    const auto first = estimator_of(settings);
    const auto second = estimator_of(settings);
    for (const sim::SimulatedPose& pose : late.poses)
      EXPECT_EQ(first->push(measurement_of(pose)).refusal, Refusal::kNone);
    for (const sim::SimulatedPose& pose : ordered.poses) second->push(measurement_of(pose));
    EXPECT_GT(first->late(), 80u);
    EXPECT_EQ(second->late(), 0u);
    EXPECT_TRUE(equal(first->state(ns(4.0)), second->state(ns(4.0)))) << "seed " << seed;
    EXPECT_EQ(first->counters().used, second->counters().used);
  }
}

TEST(TargetEstimator, RefusesTimesThatGoBackAndFarAhead) {
  const sim::WorldSettings settings = world_of(2, {kLighthouse, kTof});
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  std::size_t next = 0;
  feed(*estimator, world, 2.0, next);
  fusion::Measurement m = measurement_of(world.poses[next]);
  const std::int64_t sound_ns = m.time_ns;
  m.time_ns = sound_ns - ns(1.0);
  EXPECT_EQ(estimator->push(m).refusal, Refusal::kTimeGoesBack);
  m.time_ns = sound_ns + ns(3600.0);
  EXPECT_EQ(estimator->push(m).refusal, Refusal::kTimeAhead);
  m.time_ns = sound_ns;
  EXPECT_EQ(estimator->push(m).refusal, Refusal::kNone);
  EXPECT_EQ(estimator->refused(Refusal::kTimeGoesBack), 1u);
  EXPECT_EQ(estimator->refused(Refusal::kTimeAhead), 1u);
  EXPECT_EQ(estimator->state(estimator->newest_ns()).mode, Mode::kFused);
}

TEST(TargetEstimator, FollowsAClockThatWasSetWhenNothingElseIsHeard) {
  const sim::WorldSettings settings = world_of(3, {kLighthouse});
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  std::size_t next = 0;
  feed(*estimator, world, 2.0, next);
  for (; next < world.poses.size(); ++next) {
    fusion::Measurement m = measurement_of(world.poses[next]);
    m.time_ns += ns(1000.0);
    estimator->push(m);
  }
  EXPECT_EQ(estimator->refused(Refusal::kTimeAhead), 4u);
  EXPECT_EQ(estimator->state(estimator->newest_ns()).mode, Mode::kSingle);
}

TEST(TargetEstimator, TwoSolutionsAreBothKeptUntilOneLoses) {
  const sim::WorldSettings settings = world_of(4, {kTof, kRing2});
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  // Tof sees a ring whose mark it may have taken for the opposite one; the wrong pose is the first.
  bool tracked_without_ring2 = false;
  std::size_t fed = 0;
  for (const sim::SimulatedPose& pose : world.poses) {
    fusion::Measurement m = measurement_of(pose);
    if (m.source == 0) {
      m.second = m.pose;
      m.pose.R = m.pose.R * rotation_exp(Vector3(0.5, 0, 0));  // mirrored about the line of sight
    } else if (pose.time_s < 3.0) {
      continue;
    }
    estimator->push(m);
    tracked_without_ring2 = tracked_without_ring2 || (pose.time_s < 3.0 && estimator->state(m.time_ns).valid);
    if (++fed > 120) break;
  }
  // Nothing tells the two apart but the other source.
  EXPECT_FALSE(tracked_without_ring2);
  const TargetState state = estimator->state(estimator->newest_ns());
  ASSERT_TRUE(state.valid);
  const auto index = static_cast<std::size_t>(static_cast<double>(state.time_ns) * 1e-9 * sim::kWorldRate_hz + 0.5);
  EXPECT_LT(rotation_angle_between(state.kinematics.pose.R, world.truth[index].pose.R), 0.02);
}

TEST(TargetEstimator, ASingleSourceHasNoProtectionLevel) {
  const TargetState state = after(world_of(5, {kTof}), 8.0);
  EXPECT_EQ(state.mode, Mode::kSingle);
  EXPECT_FALSE(state.protection.position_available);
  EXPECT_FALSE(state.protection.rotation_available);
}

TEST(TargetEstimator, CoastsWithGrowingSigmasAndIsLost) {
  const sim::WorldSettings settings = world_of(6, {kLighthouse, kTof});
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  std::size_t next = 0;
  feed(*estimator, world, 5.0, next);
  const TargetState fused = estimator->state(ns(5.0));
  const TargetState coasting = estimator->state(ns(8.0));
  EXPECT_EQ(fused.mode, Mode::kFused);
  EXPECT_EQ(coasting.mode, Mode::kCoasting);
  EXPECT_GT(coasting.covariance(3, 3), fused.covariance(3, 3));
  EXPECT_GT(coasting.protection.position_m, fused.protection.position_m);
  EXPECT_EQ(coasting.sources[0].state, SourceState::kSilent);
  EXPECT_EQ(estimator->state(ns(20.0)).mode, Mode::kLost);
  EXPECT_FALSE(estimator->state(ns(20.0)).valid);
}

// The turn about the ring's axis has two absolute witnesses.
TEST(TargetEstimator, AContradictionAboutTheTurnIsAConflict) {
  const sim::WorldSettings settings = world_of(7, {kLighthouse, kTof, kRing2});
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  for (const sim::SimulatedPose& pose : world.poses) {
    if (pose.time_s > 8.0) break;
    fusion::Measurement m = measurement_of(pose);
    if (m.source == kTof && pose.time_s > 5.0) m.pose.R = rotation_exp(0.1 * m.pose.R.col(2)) * m.pose.R;
    estimator->push(m);
  }
  const TargetState state = estimator->state(ns(8.0));
  // Half a second for the contradiction, one more until the side of the turned source follows it.
  EXPECT_EQ(state.mode, Mode::kConflict);
  EXPECT_EQ(state.sources[kLighthouse].state, SourceState::kConflict);
  EXPECT_EQ(state.sources[kTof].state, SourceState::kConflict);
  EXPECT_EQ(state.sources[kRing2].state, SourceState::kUsed);
  ASSERT_TRUE(state.conflict[0].valid && state.conflict[1].valid);
  EXPECT_NEAR(rotation_angle_between(state.conflict[0].pose.R, state.conflict[1].pose.R), 0.1, 0.01);
}

TEST(TargetEstimator, AnotherErrorOfTheSameSourceIsExcludedAndComesBackAfterProof) {
  sim::WorldSettings settings = world_of(8, {kLighthouse, kTof, kRing2});
  settings.duration_s = 14.0;
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  bool excluded = false;
  for (const sim::SimulatedPose& pose : world.poses) {
    fusion::Measurement m = measurement_of(pose);
    const bool faulty = pose.time_s > 5.0 && pose.time_s < 7.0;
    if (m.source == kTof && faulty) m.pose.t.x() += 0.05;
    estimator->push(m);
    const TargetState state = estimator->state(m.time_ns);
    excluded = excluded || state.sources[kTof].state == SourceState::kExcluded;
    if (state.valid && pose.time_s > 2.0) {
      EXPECT_LT(position_error(state, world), 0.01) << pose.time_s;
    }
  }
  EXPECT_TRUE(excluded);
  EXPECT_EQ(estimator->counters().exclusions, 1u);
  EXPECT_EQ(estimator->counters().readmissions, 1u);
  EXPECT_EQ(estimator->state(ns(14.0)).sources[kTof].state, SourceState::kUsed);
}

// Two sources are left and contradict each other; the third one, excluded for a fault that is over, agrees with one.
TEST(TargetEstimator, AnExcludedSourceThatIsSoundAgainEndsAConflict) {
  sim::WorldSettings settings = world_of(12, {kLighthouse, kTof, kRing2});
  settings.duration_s = 12.0;
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  bool conflict = false;
  for (const sim::SimulatedPose& pose : world.poses) {
    fusion::Measurement m = measurement_of(pose);
    if (m.source == kLighthouse && pose.time_s > 3.0 && pose.time_s < 5.0) m.pose.t.x() += 0.05;
    if (m.source == kTof && pose.time_s > 4.0) m.pose.t.y() -= 0.04;
    estimator->push(m);
    conflict = conflict || estimator->state(m.time_ns).mode == Mode::kConflict;
  }
  EXPECT_TRUE(conflict);
  const TargetState state = estimator->state(estimator->newest_ns());
  EXPECT_EQ(state.mode, Mode::kFused);
  EXPECT_EQ(state.sources[kTof].state, SourceState::kExcluded);
  EXPECT_EQ(state.sources[kLighthouse].state, SourceState::kUsed);
  EXPECT_EQ(state.sources[kRing2].state, SourceState::kUsed);
  EXPECT_LT(position_error(state, world), 0.01);
}

// A source drifts while the others are excluded for having been frozen, and is believed. They come back and say the
// same against the state, in which nothing is left that could tell.
TEST(TargetEstimator, TwoExcludedSourcesThatAgreeRefuteTheState) {
  sim::WorldSettings settings = world_of(13, {kLighthouse, kTof, kRing2});
  settings.duration_s = 14.0;
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  double worst_m = 0.0;
  std::array<std::optional<fusion::SensorPose>, 3> frozen;
  for (const sim::SimulatedPose& pose : world.poses) {
    fusion::Measurement m = measurement_of(pose);
    const double drift = std::clamp((pose.time_s - 4.0) / 3.0, 0.0, 1.0);
    if (m.source == kLighthouse) m.pose.t.x() += 0.06 * drift;
    if (m.source != kLighthouse && pose.time_s > 3.0 && pose.time_s < 4.2) {
      if (!frozen[m.source]) frozen[m.source] = m.pose;
      m.pose = *frozen[m.source];
    }
    estimator->push(m);
    const TargetState state = estimator->state(m.time_ns);
    if (state.valid && pose.time_s > 4.0) worst_m = std::max(worst_m, position_error(state, world));
  }
  EXPECT_GT(worst_m, 0.04);
  EXPECT_EQ(estimator->counters().refuted, 1u);
  const TargetState state = estimator->state(estimator->newest_ns());
  ASSERT_TRUE(state.valid);
  EXPECT_EQ(state.sources[kLighthouse].state, SourceState::kExcluded);
  EXPECT_LT(position_error(state, world), 0.01);
}

// Its poses from 5 s on are 0.4 m aside. Nothing tells whether they or those of before are wrong.
TEST(TargetEstimator, ALoneSourceThatContradictsItsTrackIsAConflictUntilAnotherConfirmsIt) {
  sim::WorldSettings settings = world_of(14, {kLighthouse, kTof});
  settings.duration_s = 16.0;
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  for (const sim::SimulatedPose& pose : world.poses) {
    fusion::Measurement m = measurement_of(pose);
    if (m.source == kLighthouse && pose.time_s > 5.0 && pose.time_s < 9.0) m.pose.t.x() += 0.4;
    if (m.source == kTof && pose.time_s < 11.0) continue;
    estimator->push(m);
    const TargetState state = estimator->state(m.time_ns);
    if (!state.valid || (state.mode != Mode::kSingle && state.mode != Mode::kFused)) continue;
    EXPECT_TRUE(pose.time_s < 5.1 || pose.time_s > 13.9) << pose.time_s << ": before tof has confirmed it";
    EXPECT_LT(position_error(state, world), 0.02) << pose.time_s;
  }
  EXPECT_EQ(estimator->counters().unresolved, 1u);
  const TargetState state = estimator->state(estimator->newest_ns());
  EXPECT_EQ(state.mode, Mode::kFused);
  EXPECT_TRUE(state.protection.position_available);
}

// It agrees with the track again before that is given up.
TEST(TargetEstimator, ALoneSourceThatAgreesAgainIsBelievedAfterProof) {
  const sim::WorldSettings settings = world_of(15, {kLighthouse});
  const auto estimator = estimator_of(settings);
  for (const sim::SimulatedPose& pose : sim::simulate_world(settings).poses) {
    fusion::Measurement m = measurement_of(pose);
    const bool faulty = pose.time_s > 4.0 && pose.time_s < 4.6;
    if (faulty) m.pose.t.x() += 0.4;
    estimator->push(m);
    const Mode mode = estimator->state(m.time_ns).mode;
    if (pose.time_s > 4.1 && pose.time_s < 7.5) {
      EXPECT_EQ(mode, Mode::kConflict) << pose.time_s;
    }
    if (pose.time_s > 8.0) {
      EXPECT_EQ(mode, Mode::kSingle) << pose.time_s;
    }
  }
}

TEST(TargetEstimator, AFrozenSourceIsExcludedAtItsThirdEqualPose) {
  sim::WorldSettings settings = world_of(9, {kLighthouse, kTof, kRing2});
  settings.fault = {sim::SourceFaultKind::kFreeze, kTof, 5.0, 1e9, 10.0};
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  std::size_t next = 0;
  feed(*estimator, world, 5.5, next);
  const TargetState state = estimator->state(ns(5.5));
  EXPECT_EQ(state.sources[kTof].state, SourceState::kExcluded);
  EXPECT_EQ(state.sources[kTof].reason, FaultKind::kFreeze);
  EXPECT_EQ(state.mode, Mode::kFused);
}

TEST(TargetEstimator, ASourceThatComesMovesTheStateByOneSigmaAtMost) {
  sim::WorldSettings settings = world_of(10, {kTof, kRing2, kLighthouse});
  settings.sources[2].from_s = 5.0;
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  std::size_t next = 0;
  feed(*estimator, world, 10.0, next);
  EXPECT_GT(estimator->counters().limited_steps, 0u);
  EXPECT_LE(estimator->counters().largest_hand_over_sigma, 1.0);
  EXPECT_EQ(estimator->state(ns(10.0)).mode, Mode::kFused);
}

TEST(TargetEstimator, EveryKindOfFaultStaysWithinTheLevel) {
  for (int kind = 1; kind <= 8; ++kind) {
    sim::WorldSettings world = world_of(static_cast<std::uint64_t>(20 + kind), {kLighthouse, kTof, kRing2, kSlam});
    world.duration_s = 16.0;
    world.fault = {static_cast<sim::SourceFaultKind>(kind), kTof, 8.0, 1e9, 25.0};
    fusion::Settings settings = settings_of(world, 0.0);
    for (auto& source : settings.sources) source.faults_per_hour[static_cast<std::size_t>(kind - 1)] = 1.0;
    const tools::RunFigures figures = tools::run_fusion(world, settings);
    EXPECT_EQ(figures.outside, 0u) << kind;
    EXPECT_EQ(figures.wrong_excluded, 0u) << kind;
    EXPECT_GT(figures.protected_looks, figures.looks / 3) << kind;
  }
}

TEST(TargetEstimator, ForgetsEverythingWhenItIsReset) {
  const sim::WorldSettings settings = world_of(11, {kLighthouse});
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  std::size_t next = 0;
  feed(*estimator, world, 1.0, next);
  estimator->reset();
  EXPECT_EQ(estimator->state(0).mode, Mode::kSearching);
  EXPECT_EQ(estimator->push(measurement_of(world.poses[0])).refusal, Refusal::kNone);
}

// As a daemon learns where the target is: what a mounting leaves is known with a source's first pose.
TEST(TargetEstimator, ABiasSetBeforeASourcesFirstPoseIsAsIfSetAtTheStart) {
  const sim::WorldSettings world = tools::close_range_world(3);
  const sim::MeasuredWorld measured = sim::simulate_world(world);
  fusion::Settings placeholders = settings_of(world, 1e-3);
  for (fusion::SourceSettings& source : placeholders.sources) {
    if (!source.relative) source.bias_covariance = Matrix6::Identity();
  }
  const auto known = estimator_of(world);
  const auto learning = std::make_unique<TargetEstimator>(placeholders);
  std::array<bool, fusion::kMaxSources> seen{};
  for (const auto& pose : measured.poses) {
    const fusion::Measurement m = measurement_of(pose);
    if (!seen[m.source]) {
      EXPECT_EQ(learning->set_bias_covariance(m.source, known->settings().sources[m.source].bias_covariance), true);
    }
    seen[m.source] = true;
    known->push(m);
    learning->push(m);
  }
  const std::int64_t end_ns = known->newest_ns();
  EXPECT_TRUE(equal(known->state(end_ns), learning->state(end_ns)));
  EXPECT_FALSE(learning->set_bias_covariance(0, Matrix6::Identity())) << "it was heard";
  EXPECT_FALSE(estimator_of(world)->set_bias_covariance(0, Matrix6::Zero()));
}

TEST(TargetEstimator, TellsNothingOfATimeLongBeforeTheLastMeasurement) {
  const sim::WorldSettings settings = world_of(1, {kLighthouse});
  const sim::MeasuredWorld world = sim::simulate_world(settings);
  const auto estimator = estimator_of(settings);
  std::size_t next = 0;
  feed(*estimator, world, 5.0, next);
  EXPECT_TRUE(estimator->state(ns(4.9)).valid);
  EXPECT_FALSE(estimator->state(ns(-3600.0)).valid);
}

}  // namespace
}  // namespace pharos::tests
