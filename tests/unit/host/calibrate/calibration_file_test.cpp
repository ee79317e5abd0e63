// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/calibration_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/temporary_file.hpp"
#include "unit/host/calibrate/simulated_session.hpp"

namespace pharos::calibrate::test {
namespace {

using ::testing::HasSubstr;

class CalibrationFileTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    Session session;
    session.poses = 8;
    session.rest_s = 1.0;
    session.stations = 2;
    sim::LighthouseSimulator simulator(scenario_of(session), session.seed);
    nominal_ = new Target(simulator.nominal_target());
    calibration_ = new LighthouseCalibration(calibrate_lighthouse(calibration_input(simulator, session.seed)));
  }
  static void TearDownTestSuite() {
    delete nominal_;
    delete calibration_;
  }
  CalibrationFile read(const std::string& text) const {
    file_.write(text);
    return read_calibration_file(file_.path());
  }
  std::string error_of(const std::string& text) const {
    return pharos::test::error_of([&] { read(text); });
  }
  std::string refusal_of(const Target& target) const {
    return pharos::test::error_of([&] { calibrated_target(read(calibration_text(*calibration_, *nominal_)), target); });
  }
  static Target* nominal_;
  static LighthouseCalibration* calibration_;
  pharos::test::TemporaryFile file_;
};
Target* CalibrationFileTest::nominal_ = nullptr;
LighthouseCalibration* CalibrationFileTest::calibration_ = nullptr;

TEST_F(CalibrationFileTest, ReadsBackExactlyWhatItWrites) {
  const BundleResult& bundle = calibration_->bundle;
  const CalibrationFile file = read(calibration_text(*calibration_, *nominal_));
  ASSERT_EQ(file.stations.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(file.stations[i].calibration, bundle.unknowns.station[i]);
  EXPECT_EQ(file.scale_sigma, bundle.scale_sigma);
  EXPECT_EQ(file.model_form, 1);
  const Target target = calibrated_target(file, *nominal_);
  for (std::size_t i = 0; i < target.size(); ++i) {
    EXPECT_EQ(target[i].position_m, bundle.unknowns.target[i].position_m);
    EXPECT_EQ(target[i].normal, (*nominal_)[i].normal);
  }
  ASSERT_EQ(file.covariance.size(), bundle.parameters.size());
  for (std::size_t i = 0; i < file.covariance.size(); ++i) {
    EXPECT_EQ(file.parameters[i], bundle.parameters[i].name);
    for (std::size_t j = 0; j < file.covariance.size(); ++j) {
      EXPECT_EQ(file.covariance[i][j], bundle.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
}

TEST_F(CalibrationFileTest, ReadsBackWhereTheSecondStationStands) {
  const BundleResult& bundle = calibration_->bundle;
  const CalibrationFile file = read(calibration_text(*calibration_, *nominal_));
  ASSERT_TRUE(file.pair && bundle.unknowns.T_reference_station.at(1));
  EXPECT_EQ(file.pair->reference, bundle.unknowns.station[0].id);
  EXPECT_EQ(file.pair->station, bundle.unknowns.station[1].id);
  EXPECT_LT(pose_difference(file.pair->T_reference_station, *bundle.unknowns.T_reference_station[1]).norm(), 1e-14);
  // The pair's rows are the last six parameters.
  EXPECT_EQ(file.pair->covariance, bundle.covariance.bottomRightCorner(6, 6));
  EXPECT_GT(file.pair->covariance.diagonal().minCoeff(), 0.0);

  const auto same = relative_pose(*file.pair, file.pair->reference, file.pair->station);
  const auto turned = relative_pose(*file.pair, file.pair->station, file.pair->reference);
  ASSERT_TRUE(same && turned);
  EXPECT_EQ(same->T_0_1.t, file.pair->T_reference_station.t);
  EXPECT_LT((turned->T_0_1 * same->T_0_1).t.norm(), 1e-14);
  EXPECT_FALSE(relative_pose(*file.pair, file.pair->reference, 0x0BADCAFEu));
}

TEST_F(CalibrationFileTest, SaysWhatIsWrongWithAPair) {
  const std::string good = calibration_text(*calibration_, *nominal_);
  const std::size_t at = good.find("[[pair]]");
  ASSERT_NE(at, std::string::npos);
  const std::string pair = good.substr(at);
  EXPECT_THAT(error_of(good + pair), HasSubstr("a second [[pair]]"));
  const auto instead = [&](const std::string& key, const std::string& value) {
    const std::size_t line = pair.find("\n" + key + " = ") + 1;
    return good.substr(0, at) + pair.substr(0, line) + key + " = " + value + pair.substr(pair.find('\n', line));
  };
  EXPECT_THAT(error_of(instead("orientation_wxyz", "[1.0, 0.5, 0.0, 0.0]")), HasSubstr("unit quaternion"));
  EXPECT_THAT(error_of(instead("position_m", "[1.0, 0.5]")), HasSubstr("position_m"));
  EXPECT_THAT(error_of(instead("station", "\"0BADCAFE\"")), HasSubstr("does not tell how well its pose is known"));
  EXPECT_THAT(error_of(instead("reference", "\"somewhere\"")), HasSubstr("reference"));
}

TEST_F(CalibrationFileTest, IsRefusedForAnotherTarget) {
  EXPECT_EQ(refusal_of(*nominal_), "");
  Target fewer = *nominal_;
  fewer.pop_back();
  EXPECT_THAT(refusal_of(fewer), HasSubstr("another target: its sensor 11"));
  Target renumbered = *nominal_;
  renumbered[2].sensor = 20;
  EXPECT_THAT(refusal_of(renumbered), HasSubstr("another target: sensor 20"));
  Target moved = *nominal_;
  moved[3].position_m.x() += 2e-3;
  EXPECT_THAT(refusal_of(moved), HasSubstr("another target: sensor 3 stands elsewhere"));
}

TEST_F(CalibrationFileTest, OfStationsOnlyLeavesTheTargetAlone) {
  const CalibrationFile file = read("[[station]]\nslot = 0\nphase_rad = [0.01, 0.02]\n");
  EXPECT_FALSE(file.has_target());
  EXPECT_EQ(calibrated_target(file, *nominal_)[5].position_m, (*nominal_)[5].position_m);
  EXPECT_EQ(file.scale_sigma, 0.0);
}

TEST_F(CalibrationFileTest, NamesLineAndKeyOfWhatItCannotUse) {
  EXPECT_THAT(error_of("[calibration]\nscale = \"guessed\"\n"), HasSubstr(":2: calibration.scale"));
  EXPECT_THAT(error_of("[calibration]\nparameters = [\"a\"]\ncovariance = [[1.0, 2.0]]\n"), HasSubstr("covariance"));
  EXPECT_THAT(error_of("[calibration]\nparameters = [\"a\"]\ncovariance = []\n"), HasSubstr("covariance"));
  EXPECT_THAT(error_of("[[sensor]]\nsensor = 1\nposition_m = [0.0, 0.0, 0.0]\n"), HasSubstr("nominal_m"));
  EXPECT_THAT(error_of("[[sensor]]\nsensor = 1\nposition_m = [0.0, 0.0, 0.0]\nnominal_m = [0.0, 0.0, 0.0]\n"),
              HasSubstr("no target"));
  EXPECT_THAT(error_of("[[sensor]]\nsensr = 1\n"), HasSubstr("sensor"));
}

TEST_F(CalibrationFileTest, SaysWhatItLeavesWrong) {
  CalibrationFile file = read(calibration_text(*calibration_, *nominal_));
  const motion::SystematicErrors left = systematic_errors(file);
  // Much smaller than without a calibration, and at least some arcsec and micrometres.
  EXPECT_LT(left.sensor_position_m, 0.1 * motion::kUncalibratedErrors.sensor_position_m);
  EXPECT_GT(left.sensor_position_m, 0.2e-6);
  EXPECT_LT(left.rotor_rad, 0.5 * motion::kUncalibratedErrors.rotor_rad);
  EXPECT_GT(left.rotor_rad, 2.0 * kRadPerArcsec);
  // These are standard deviations: four times the covariance gives twice their value.
  for (std::vector<double>& row : file.covariance) {
    for (double& value : row) value *= 4.0;
  }
  file.scale_sigma *= 2.0;
  EXPECT_NEAR(systematic_errors(file).rotor_rad, 2.0 * left.rotor_rad, 1e-9 * left.rotor_rad);
  EXPECT_NEAR(systematic_errors(file).sensor_position_m, 2.0 * left.sensor_position_m, 1e-9 * left.sensor_position_m);
  file.covariance.clear();
  EXPECT_EQ(systematic_errors(file).rotor_rad, motion::kCalibratedErrors.rotor_rad);
  EXPECT_EQ(systematic_errors(parse_calibration("[[station]]\nslot = 0\n", "stations")).rotor_rad,
            motion::kUncalibratedErrors.rotor_rad);
}

TEST(WidenByScale, AddsTheRangesShareAndNothingAcross) {
  LighthousePoseEstimate estimate;
  estimate.pose.t = {0.0, 0.0, 3.0};
  estimate.covariance = Matrix6::Identity() * 1e-8;
  widen_by_scale(estimate, 0.0026);
  EXPECT_NEAR(std::sqrt(estimate.covariance(5, 5)), 7.8e-3, 1e-5);
  EXPECT_EQ(estimate.covariance(3, 3), 1e-8);
  EXPECT_EQ(estimate.covariance(0, 0), 1e-8);
}

}  // namespace
}  // namespace pharos::calibrate::test
