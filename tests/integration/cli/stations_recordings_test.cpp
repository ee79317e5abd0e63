// SPDX-License-Identifier: Apache-2.0
// convert -> calibrate stations -> track --sweeps -> evaluate, on logs beside motion capture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/integration/cli/program.hpp"
#include "tests/support/real_data.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;

std::string converted(const Folder& folder, const std::string& set, const std::string& log) {
  const std::string from = (test::real_data("open") / "crazyflie" / set).string();
  const std::string to = folder.path(set);
  EXPECT_EQ(pharos("convert crazyflie " + from + "/" + log + " --config " + from + "/system-config.yaml --output " + to)
                .exit_code,
            0);
  return to;
}

// Times of the first and last event.
std::string marks_of(const std::string& folder) {
  const std::vector<Row> rows = rows_of(content_of(folder + "/events.csv"));
  return rows.front().at("time_s") + "," + rows.back().at("time_s");
}

TEST(CliStations, AGeometryLearntByHandScoresAFlightWithinACentimetre) {
  PHAROS_NEEDS_DATA("open");
  const Folder folder;
  const std::string carried = converted(folder, "lh1_crossingBeam_move", "log02");
  const std::string flight = converted(folder, "lh1_crossingBeam_flight", "log01");
  const std::string stations = folder.path("stations.toml"), poses = folder.path("poses.csv");
  const Outcome learnt = pharos("calibrate stations " + carried + "/sweeps.csv --target " + carried +
                                "/target.csv --stations " + carried + "/stations.toml --output " + stations);
  ASSERT_EQ(learnt.exit_code, 0) << learnt.err;
  EXPECT_THAT(learnt.err, HasSubstr("scale: from the target's size alone"));
  EXPECT_THAT(learnt.err, HasSubstr("station 1 plane y: residuals"));
  EXPECT_EQ(first_line(learnt.out), "parameter,prior,value,prior_sigma,sigma,told");
  ASSERT_EQ(pharos("track --sweeps " + flight + "/sweeps.csv --stations " + stations + " --target " + flight +
                   "/target.csv --output " + poses)
                .exit_code,
            0);
  const std::string truth =
      (test::real_data("open") / "crazyflie" / "lh1_crossingBeam_flight" / "mocap01.csv.gz").string();
  const Outcome scored = pharos("evaluate " + poses + " " + truth + " --clock-marks " + marks_of(flight) +
                                " --epochs " + flight + "/crossing_beam.csv --lever-arm estimate");
  ASSERT_EQ(scored.exit_code, 0) << scored.err;
  const Row row = rows_of(scored.out).at(0);
  EXPECT_LT(std::stod(row.at("pos_mean_mm")), 10.0);
  EXPECT_EQ(row.at("epochs_answered"), row.at("epochs"));
  const double nees = std::stod(row.at("pos_nees_per_dof"));
  EXPECT_GT(nees, 0.3);
  EXPECT_LT(nees, 1.5);
}

}  // namespace
}  // namespace pharos::cli_test
