// SPDX-License-Identifier: Apache-2.0
#include "host/mounting/mounting_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/support/input_error.hpp"
#include "pharos/geometry/rotation.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/temporary_folder.hpp"

namespace pharos::host {
namespace {

Matrix6 some_covariance(double sigma) {
  Matrix6 factor = sigma * Matrix6::Identity();
  factor(3, 0) = 0.4 * sigma;
  factor(5, 1) = -0.3 * sigma;
  return factor * factor.transpose();
}

SourceMounting given_lighthouse() {
  SourceMounting source;
  source.name = "lighthouse";
  source.time_offset_origin = MountingOrigin::kGiven;
  source.T_vehicle_sensor.origin = MountingOrigin::kGiven;
  source.T_target_feature.emplace();
  source.T_target_feature->origin = MountingOrigin::kGiven;
  return source;
}

SourceMounting estimated_tof() {
  SourceMounting source;
  source.name = "tof";
  source.kind = SourceKind::kTof;
  source.T_vehicle_sensor.origin = MountingOrigin::kEstimated;
  source.T_vehicle_sensor.set(VehicleFromSensor{rotation_exp({0.1, -0.2, 0.3}), {0.25, 1.0 / 3.0, -0.1}});
  source.T_vehicle_sensor.covariance = some_covariance(1e-3);
  source.T_target_feature.emplace();
  source.T_target_feature->origin = MountingOrigin::kEstimated;
  source.T_target_feature->set(TargetFromFeature{rotation_exp({3.1, 0.0, 0.1}), {0.0, 0.02, 0.4}});
  source.T_target_feature->covariance = some_covariance(2e-3);
  source.cross_covariance(0, 0) = 1e-6;
  source.time_offset_s = -0.043;
  source.time_offset_sigma_s = 2e-4;
  source.time_offset_origin = MountingOrigin::kEstimated;
  source.scale_sigma = 1e-3;
  source.noise_time_s = 0.19;
  source.slow_error = SlowError{0.2, 1.0 / 3.0, 45.0};
  source.unobservable = {"translation along the \"turn\" axis\n"};
  return source;
}

SourceMounting slam_of_unknown_feature() {
  SourceMounting source;
  source.name = "slam";
  source.kind = SourceKind::kSlam;
  source.T_vehicle_sensor.covariance = some_covariance(1e-2);
  source.time_offset_sigma_s = 0.01;
  return source;
}

Mounting some_mounting() { return {"bench 2", {given_lighthouse(), estimated_tof(), slam_of_unknown_feature()}}; }

std::string message(const Mounting& mounting) {
  return test::error_of([&] { (void)parse_mounting(mounting_text(mounting), "mounting.toml"); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? "no " + from : text.replace(at, from.size(), to);
}

std::string message_where(const std::string& from, const std::string& to) {
  return test::error_of(
      [&] { (void)parse_mounting(replaced(mounting_text(some_mounting()), from, to), "mounting.toml"); });
}

TEST(MountingFile, ReadsBackExactlyWhatItWrites) {
  const Mounting written = some_mounting();
  const Mounting read = parse_mounting(mounting_text(written), "mounting.toml");
  ASSERT_EQ(read.sources.size(), 3u);
  EXPECT_EQ(read.rig, "bench 2");
  const SourceMounting& tof = *read.find("tof");
  const SourceMounting& wanted = written.sources[1];
  EXPECT_EQ(tof.kind, SourceKind::kTof);
  EXPECT_EQ(tof.T_vehicle_sensor.origin, MountingOrigin::kEstimated);
  EXPECT_EQ(tof.T_vehicle_sensor.rotation_wxyz, wanted.T_vehicle_sensor.rotation_wxyz);
  EXPECT_EQ(tof.T_vehicle_sensor.position_m, wanted.T_vehicle_sensor.position_m);
  EXPECT_EQ(tof.T_vehicle_sensor.covariance, wanted.T_vehicle_sensor.covariance);
  EXPECT_EQ(tof.T_target_feature->covariance, wanted.T_target_feature->covariance);
  EXPECT_EQ(tof.cross_covariance, wanted.cross_covariance);
  EXPECT_EQ(tof.time_offset_s, wanted.time_offset_s);
  EXPECT_EQ(tof.time_offset_sigma_s, wanted.time_offset_sigma_s);
  EXPECT_EQ(tof.scale_sigma, wanted.scale_sigma);
  EXPECT_EQ(tof.noise_time_s, wanted.noise_time_s);
  ASSERT_TRUE(tof.slow_error);
  EXPECT_EQ(tof.slow_error->rotation_ratio, wanted.slow_error->rotation_ratio);
  EXPECT_EQ(tof.slow_error->position_ratio, wanted.slow_error->position_ratio);
  EXPECT_EQ(tof.slow_error->time_constant_s, wanted.slow_error->time_constant_s);
  EXPECT_FALSE(read.find("lighthouse")->slow_error);
  EXPECT_EQ(tof.unobservable, wanted.unobservable);
  EXPECT_FALSE(read.find("slam")->T_target_feature);
  EXPECT_EQ(read.find("nobody"), nullptr);
  EXPECT_EQ(mounting_text(read), mounting_text(written));
}

TEST(MountingFile, IsWrittenAtOnceAndReadFromDisk) {
  const test::TemporaryFolder folder;
  write_mounting_file(folder.path("mounting.toml"), some_mounting());
  EXPECT_EQ(mounting_text(read_mounting_file(folder.path("mounting.toml"))), mounting_text(some_mounting()));
  EXPECT_EQ(folder.files().size(), 1u);
}

TEST(MountingFile, ComposesTheTargetsPoseInTheVehicleFrame) {
  SourceMounting source = estimated_tof();
  const SensorFromFeature measured{rotation_exp({0.5, 2.0, -0.3}), {0.1, 0.2, 3.0}};
  const Vector3 p_feature(0.3, -0.1, 0.2);
  const Vector3 p_target = *source.target_from_feature() * p_feature;
  const Vector3 expected = source.vehicle_from_sensor() * (measured * p_feature);
  EXPECT_LT((*vehicle_from_target(source, measured) * p_target - expected).norm(), 1e-12);
  source.T_target_feature.reset();
  EXPECT_FALSE(vehicle_from_target(source, measured));
}

TEST(MountingFile, TakesAQuaternionOfFourDigitsAndMakesItARotation) {
  Mounting mounting = some_mounting();
  mounting.sources[1].T_vehicle_sensor.rotation_wxyz = {0.7071, 0.0, 0.7071, 0.0};
  const Matrix3 R = parse_mounting(mounting_text(mounting), "m").sources[1].vehicle_from_sensor().R;
  EXPECT_LT((R * R.transpose() - Matrix3::Identity()).norm(), 1e-12);
}

TEST(MountingFile, RefusesASlowErrorThatIsNoneOrNotWhole) {
  EXPECT_NE(message_where("rotation_ratio = 0.2", "rotation_ratio = -0.2").find("rotation_ratio"), std::string::npos);
  EXPECT_NE(message_where("time_constant_s = 45.0", "time_constant_s = 0.0").find("time_constant_s"),
            std::string::npos);
  EXPECT_NE(message_where("time_constant_s = 45.0", "").find("time_constant_s"), std::string::npos);
}

TEST(MountingFile, RefusesARotationThatIsNoneWithItsLine) {
  Mounting mounting = some_mounting();
  mounting.sources[0].T_vehicle_sensor.rotation_wxyz = {0.9, 0.0, 0.0, 0.0};
  EXPECT_EQ(
      message(mounting),
      "mounting.toml:15: source[0].T_vehicle_sensor.rotation_wxyz: is no rotation: the four numbers' squares must "
      "add up to 1");
}

TEST(MountingFile, RefusesACovarianceThatIsNone) {
  Mounting negative = some_mounting(), zero = some_mounting(), skewed = some_mounting(), indefinite = some_mounting();
  negative.sources[1].T_vehicle_sensor.covariance(2, 2) = -1e-6;
  zero.sources[1].T_vehicle_sensor.covariance.row(2).setZero();
  zero.sources[1].T_vehicle_sensor.covariance.col(2).setZero();
  skewed.sources[1].T_vehicle_sensor.covariance(0, 3) *= 1.1;
  Matrix6& matrix = indefinite.sources[1].T_vehicle_sensor.covariance;
  matrix = Matrix6::Identity();
  matrix(0, 1) = matrix(1, 0) = matrix(0, 2) = matrix(2, 0) = 0.9;
  matrix(1, 2) = matrix(2, 1) = -0.9;
  EXPECT_NE(message(negative).find("row 3, column 3 is not positive"), std::string::npos) << message(negative);
  EXPECT_NE(message(zero).find("row 3, column 3 is not positive"), std::string::npos) << message(zero);
  EXPECT_NE(message(skewed).find("not symmetric in row 4, column 1"), std::string::npos) << message(skewed);
  EXPECT_NE(message(indefinite).find("negative eigenvalue"), std::string::npos) << message(indefinite);
}

TEST(MountingFile, RefusesACrossCovarianceThatTheTwoPosesCannotHave) {
  Mounting mounting = some_mounting();
  mounting.sources[1].cross_covariance(0, 0) = 1e-2;
  EXPECT_NE(message(mounting).find("cross_covariance: the correlation in row 7, column 1 is above 1"),
            std::string::npos)
      << message(mounting);
  mounting.sources[1].T_target_feature.reset();
  EXPECT_NE(message(mounting).find("cross_covariance: must be absent"), std::string::npos) << message(mounting);
}

TEST(MountingFile, RefusesWhatIsNotFinite) {
  EXPECT_NE(message_where("-0.043", "nan").find("time_offset_s: must be a finite number"), std::string::npos)
      << message_where("-0.043", "nan");
  EXPECT_NE(message_where("[0.25,", "[inf,").find("position_m"), std::string::npos);
  EXPECT_NE(message_where("[0.25,", "[2500.0,").find("position_m"), std::string::npos);
}

TEST(MountingFile, RefusesANameTwiceAndNamesOfOtherCharacters) {
  Mounting mounting = some_mounting();
  mounting.sources[2].name = "tof";
  EXPECT_TRUE(message(mounting).ends_with("source[2].name: source \"tof\" comes twice")) << message(mounting);
  mounting.sources[2].name = "Slam 1";
  EXPECT_NE(message(mounting).find("source[2].name: must be 1 to 32"), std::string::npos) << message(mounting);
}

TEST(MountingFile, RefusesUnknownKeysKindsAndOrigins) {
  EXPECT_NE(message_where("scale_sigma", "scale_sgima").find("did you mean \"scale_sigma\""), std::string::npos)
      << message_where("scale_sigma", "scale_sgima");
  EXPECT_NE(message_where("kind = \"tof\"", "kind = \"sonar\"").find("kind"), std::string::npos);
  EXPECT_NE(message_where("origin = \"estimated\"", "origin = \"told\"").find("origin"), std::string::npos);
}

TEST(MountingFile, RefusesAnEstimateWithoutUncertainty) {
  Mounting mounting = some_mounting();
  mounting.sources[1].T_vehicle_sensor.covariance.setZero();
  EXPECT_NE(message(mounting).find("covariance: is missing"), std::string::npos) << message(mounting);
  mounting = some_mounting();
  mounting.sources[1].time_offset_sigma_s = 0.0;
  EXPECT_NE(message(mounting).find("time_offset_sigma_s: must be positive"), std::string::npos) << message(mounting);
}

TEST(MountingFile, RefusesAFileWithoutSourcesAndWithTooMany) {
  EXPECT_NE(test::error_of([] { (void)parse_mounting("rig = \"a\"\n", "m.toml"); }).find("m.toml:"), std::string::npos);
  Mounting mounting = some_mounting();
  for (std::size_t i = 0; i < kMaxMountedSources; ++i) {
    mounting.sources.push_back(slam_of_unknown_feature());
    mounting.sources.back().name = "slam" + std::to_string(i);
  }
  EXPECT_NE(message(mounting).find("more than 16"), std::string::npos) << message(mounting);
}

}  // namespace
}  // namespace pharos::host
