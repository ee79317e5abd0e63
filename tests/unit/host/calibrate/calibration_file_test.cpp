// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/calibration_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "host/support/input_error.hpp"
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
    calibration_ = new LighthouseCalibration(calibrate_lighthouse(material_of(simulator, session.seed)));
  }
  static void TearDownTestSuite() {
    delete nominal_;
    delete calibration_;
  }
  CalibrationFile read(const std::string& text) const {
    std::ofstream(path_) << text;
    return read_calibration_file(path_);
  }
  std::string error_of(const std::string& text) const {
    try {
      read(text);
    } catch (const host::InputError& error) {
      return error.what();
    }
    return "";
  }
  std::string refusal_of(const Target& target) const {
    try {
      calibrated_target(read(calibration_text(*calibration_, *nominal_)), target);
    } catch (const host::InputError& error) {
      return error.what();
    }
    return "";
  }
  void TearDown() override { std::remove(path_.c_str()); }

  static Target* nominal_;
  static LighthouseCalibration* calibration_;
  std::string path_ = ::testing::TempDir() + "pharos_calibration_" +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml";
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
  EXPECT_THAT(error_of("[calibration]\nscale = \"guessed\"\n"), HasSubstr(".toml:2: calibration.scale"));
  EXPECT_THAT(error_of("[calibration]\nparameters = [\"a\"]\ncovariance = [[1.0, 2.0]]\n"), HasSubstr("covariance"));
  EXPECT_THAT(error_of("[calibration]\nparameters = [\"a\"]\ncovariance = []\n"), HasSubstr("covariance"));
  EXPECT_THAT(error_of("[[sensor]]\nsensor = 1\nposition_m = [0.0, 0.0, 0.0]\n"), HasSubstr("nominal_m"));
  EXPECT_THAT(error_of("[[sensor]]\nsensor = 1\nposition_m = [0.0, 0.0, 0.0]\nnominal_m = [0.0, 0.0, 0.0]\n"),
              HasSubstr("no target"));
  EXPECT_THAT(error_of("[[sensor]]\nsensr = 1\n"), HasSubstr("sensor"));
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
