// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "pharos/pose/solve.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"

namespace pharos::pose {
namespace {

class Refusals : public ::testing::Test {
 protected:
  Refusals() {
    test::PnpSet set;
    set.min_sensors = 6;
    problem_ = test::PnpGenerator(target_, set, 1).next();
  }

  // Exact bearings of all sensors of a target at a pose, whatever their direction.
  static Observations bearings_of(const Target& target, const LighthouseFromBody& pose) {
    Observations observations;
    for (const SensorPlacement& s : target) {
      for (const Axis axis : {Axis::kX, Axis::kY}) {
        observations.push_back({s.sensor, axis, test::bearing_of(pose * s.position_m, axis)});
      }
    }
    return observations;
  }

  const Target target_ = test::frustum_target();
  const LighthouseFromBody ahead_{rotation_exp({2.5, 0.3, 0.1}), {0.1, 0.2, 2.0}};
  test::PnpProblem problem_;
};

TEST_F(Refusals, TooFewSensorsBelowFour) {
  Observations three;
  for (std::size_t k = 0; k < 6; ++k) three.push_back(problem_.observations[k]);
  EXPECT_EQ(solve(target_, three, {}).error(), Refusal::kTooFewSensors);
  EXPECT_EQ(solve(target_, {}, {}).error(), Refusal::kTooFewSensors);
}

TEST_F(Refusals, TooFewSensorsBelowThreeEvenWithAPrior) {
  Observations two;
  for (std::size_t k = 0; k < 4; ++k) two.push_back(problem_.observations[k]);
  EXPECT_EQ(solve(target_, two, {}, &problem_.truth).error(), Refusal::kTooFewSensors);
}

TEST_F(Refusals, TooFewSensorsBelowSixAngles) {
  Observations five;
  for (const Observation& o : problem_.observations) {
    if (five.size() < 5 && o.axis == Axis::kX) five.push_back(o);
  }
  EXPECT_EQ(solve(target_, five, {}, &problem_.truth).error(), Refusal::kTooFewSensors);
}

TEST_F(Refusals, DegenerateWhereOnlyOneRotorWasSeen) {
  Observations one_rotor;
  for (const Observation& o : problem_.observations) {
    if (o.axis == Axis::kX) one_rotor.push_back(o);
  }
  EXPECT_EQ(solve(target_, one_rotor, {}).error(), Refusal::kDegenerate);
  EXPECT_EQ(solve(target_, one_rotor, {}, &problem_.truth).error(), Refusal::kDegenerate);
}

TEST_F(Refusals, SearchLimitWhereTheSearchMayNotGoOn) {
  Observations contradicting = problem_.observations;
  contradicting[0].theta_rad += 0.01;
  EXPECT_TRUE(solve(target_, contradicting, {}).ok());
  SolveOptions limited;
  limited.max_search_starts = 0;
  EXPECT_EQ(solve(target_, contradicting, limited).error(), Refusal::kSearchLimit);
  EXPECT_TRUE(solve(target_, problem_.observations, limited).ok());
}

TEST_F(Refusals, UnknownSensorsWhereTheKnownOnesAreTooFew) {
  Observations strangers = problem_.observations;
  for (std::size_t k = 6; k < strangers.size(); ++k) strangers[k].sensor = 200;
  EXPECT_EQ(solve(target_, strangers, {}).error(), Refusal::kUnknownSensors);
}

TEST_F(Refusals, UnknownSensorsAreLeftOutWhereTheKnownOnesSuffice) {
  Observations observations = problem_.observations;
  observations.push_back({31, Axis::kX, 1.2});
  const auto solution = solve(target_, observations, {});
  ASSERT_TRUE(solution.ok());
  EXPECT_FALSE(solution->used.test(observations.size() - 1));
}

TEST_F(Refusals, DegenerateWhereAllSensorsLieOnOneLine) {
  Target line;
  for (std::uint8_t k = 0; k < 6; ++k) line.push_back({k, {0.02 * k, 0.01 * k, 0.005 * k}, Vector3::Zero()});
  EXPECT_EQ(solve(line, bearings_of(line, ahead_), {}, &ahead_).error(), Refusal::kDegenerate);
}

TEST_F(Refusals, BadInputOutsideTheHalfTurn) {
  for (const double bad :
       {0.0, kPi, -0.1, 4.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Observations observations = problem_.observations;
    observations[2].theta_rad = bad;
    EXPECT_EQ(solve(target_, observations, {}).error(), Refusal::kBadInput) << bad;
  }
}

TEST_F(Refusals, PoorFitWhereNothingRigidFits) {
  test::PnpGenerator generator(target_, {}, 2);
  int refused = 0;
  constexpr int kProblems = 200;
  for (int k = 0; k < kProblems; ++k) {
    Observations noise;
    for (std::uint8_t s = 0; s < 12; ++s) {
      for (const Axis axis : {Axis::kX, Axis::kY}) noise.push_back({s, axis, generator.uniform(0.6, 2.5)});
    }
    const auto solution = solve(target_, noise, {});
    refused += !solution.ok() && (solution.error() == Refusal::kPoorFit || solution.error() == Refusal::kNotConverged);
  }
  EXPECT_EQ(refused, kProblems);
}

TEST_F(Refusals, PoorFitAboveTheReducedChi2Allowed) {
  SolveOptions strict;
  strict.max_reduced_chi2 = 1e-3;
  EXPECT_EQ(solve(target_, problem_.observations, strict).error(), Refusal::kPoorFit);
}

TEST_F(Refusals, NotConvergedWhereNoIterationIsAllowed) {
  SolveOptions none;
  none.max_iterations = 0;
  EXPECT_EQ(solve(target_, problem_.observations, none).error(), Refusal::kNotConverged);
}

TEST_F(Refusals, BehindStationWhereTheTangentsFitThere) {
  // The paper's tangents are the same for a point and its mirror image through the station; the angles are not.
  const LighthouseFromBody behind{ahead_.R, -ahead_.t};
  Observations mirrored;
  for (const SensorPlacement& s : target_) {
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      mirrored.push_back({s.sensor, axis, test::bearing_of(-(behind * s.position_m), axis)});
    }
  }
  SolveOptions tangent;
  tangent.residual = Residual::kTangent;
  EXPECT_EQ(solve(target_, mirrored, tangent, &behind).error(), Refusal::kBehindStation);
}

TEST(RefusalNames, AreOneWordEachAndDistinct) {
  std::set<std::string> names;
  for (int k = 0; k <= static_cast<int>(Refusal::kBadInput); ++k) names.insert(name_of(static_cast<Refusal>(k)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(Refusal::kBadInput) + 1);
  for (const std::string& name : names)
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos);
}

}  // namespace
}  // namespace pharos::pose
