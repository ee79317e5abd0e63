// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <vector>

#include "host/cameras/rig_file.hpp"
#include "host/table/table_reader.hpp"
#include "integration/daemon_under_test.hpp"
#include "pharos/base/units.hpp"
#include "pharos/pose_t.hpp"
#include "support/painted_ring_pair.hpp"
#include "support/temporary_folder.hpp"

namespace pharos::host {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

LighthouseFromBody some_pose() { return {rotation_exp(Vector3(0.2, -0.3, 0.5)), Vector3(0.3, -0.2, 2.0)}; }

// True poses of a stationary target, from long before to long after this test.
void write_truth(const std::filesystem::path& file) {
  const Quaternion q = some_pose().quaternion();
  std::ofstream out(file);
  out.precision(17);
  out << "utime,qw,qx,qy,qz,tx_m,ty_m,tz_m\n";
  for (const char* utime : {"0", "9000000000000000"}) {
    out << utime << ',' << q.w() << ',' << q.x() << ',' << q.y() << ',' << q.z() << ",0.3,-0.2,2\n";
  }
}

TEST(Listen, SummarisesPosesAgainstTheTruthAndEndsWith0) {
  DaemonUnderTest daemon;
  PseudoTerminal line;
  daemon.plug_in(line);
  daemon.write_config();
  daemon.start();
  write_truth(daemon.folder() / "truth.csv");
  ChildProcess listen({PHAROS, "listen", "--url", daemon.url(), "--truth", (daemon.folder() / "truth.csv").string(),
                       "--summary", "--count", "20"});
  StationaryTarget target(some_pose());
  int exit_code = -1;
  daemon.play(
      target, line, [&] { return (exit_code = listen.wait_exit(0.0)) >= 0; }, 20.0);
  EXPECT_EQ(exit_code, 0) << listen.text();
  EXPECT_THAT(listen.text(), AllOf(HasSubstr("target dock, station 0:"), HasSubstr("age on arrival"),
                                   HasSubstr("deg RMS"), HasSubstr("0 refused, 0 lost")));
}

TEST(Listen, ShowsBothSystemsOfAStereoRig) {
  DaemonUnderTest daemon;
  const test::PaintedRig painted;
  std::ofstream(daemon.folder() / "rig.toml") << rig_text(painted.file());
  std::filesystem::create_directories(daemon.folder() / "pairs");
  for (std::size_t side = 0; side < 2; ++side) {
    const GreyImage image = painted.image(test::ring_at({0.0, 0.0, 2.6}, 0.1, -0.1), side, side);
    write_grey_png((daemon.folder() / "pairs" / (side == 0 ? "0_left.png" : "0_right.png")).string(), image.view(), 8);
  }
  std::ofstream(daemon.folder() / "pharosd.toml")
      << "[lcm]\nurl = '" << daemon.url() << "'\n[publish]\nmax_age_s = 10\n[[stereo]]\nname = 'bow'\n"
      << "target = 'client'\nrig_file = 'rig.toml'\nsystems = ['ring2', 'slam']\nframes = 'pairs'\n";
  ChildProcess listen({PHAROS, "listen", "PHAROS_(RING2|SLAM)_POSE", "--url", daemon.url(), "--csv"});
  ASSERT_TRUE(listen.wait_for("utime,source"));
  EXPECT_EQ(daemon.start().wait_exit(60.0), 0) << "at the recording's end";
  EXPECT_TRUE(listen.wait_for(",ring2/bow,client,")) << listen.text();
  EXPECT_TRUE(listen.wait_for(",ok,no_connector,")) << "the turn about the axis is not told";
  EXPECT_TRUE(listen.wait_for(",slam/bow,client,")) << listen.text();
}

TEST(Listen, EndsWith1WhenNoPoseCame) {
  DaemonUnderTest silence;
  ChildProcess listen({PHAROS, "listen", "--url", silence.url(), "--duration", "0.2"});
  EXPECT_EQ(listen.wait_exit(), 1);
  EXPECT_THAT(listen.text(), HasSubstr("nothing was received"));
}

TEST(Listen, ACsvTableHasItsHeaderAlsoWhenNothingComes) {
  DaemonUnderTest silence;
  ChildProcess listen({PHAROS, "listen", "--url", silence.url(), "--csv"});
  EXPECT_TRUE(listen.wait_for("utime,source,target,station,"));
  listen.signal(SIGINT);
  EXPECT_EQ(listen.wait_exit(), 1);
}

TEST(Listen, EndsWith2AtOnceForABrokenRegularExpression) {
  DaemonUnderTest silence;
  ChildProcess listen({PHAROS, "listen", "PHAROS_(", "--url", silence.url()});
  EXPECT_EQ(listen.wait_exit(), 2);
  EXPECT_THAT(listen.text(), HasSubstr("pharos listen: CHANNEL 'PHAROS_(' is not a regular expression"));
}

TEST(Listen, ListenersStartedAtOnceAllHear) {
  DaemonUnderTest daemon;
  PseudoTerminal line;
  daemon.plug_in(line);
  daemon.write_config();
  daemon.start();
  std::vector<std::unique_ptr<ChildProcess>> listeners;
  for (int i = 0; i < 6; ++i) {
    listeners.push_back(std::make_unique<ChildProcess>(
        std::vector<std::string>{PHAROS, "listen", "--url", daemon.url(), "--summary", "--count", "20"}));
  }
  const auto all_ended = [&] {
    return std::all_of(listeners.begin(), listeners.end(),
                       [](auto& listener) { return listener->wait_exit(0.0) >= 0; });
  };
  StationaryTarget target(some_pose());
  EXPECT_TRUE(daemon.play(target, line, all_ended, 20.0));
  for (const auto& listener : listeners) EXPECT_EQ(listener->wait_exit(0.0), 0) << listener->text();
}

TEST(Listen, ARecordedFileEndsWhereItEndsAndTellsOldAges) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("poses.lcm");
  {
    lcm::LogFile log(file, "w");
    for (int i = 0; i < 5; ++i) {
      pose_t pose{};
      pose.utime = 1'000'000 + i;  // 1970
      pose.sequence = i;
      pose.valid = 1;
      pose.orientation_wxyz[0] = 1.0;
      std::vector<char> bytes(static_cast<std::size_t>(pose.getEncodedSize()));
      pose.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
      lcm::LogEvent event{i, pose.utime, "PHAROS_LIGHTHOUSE_POSE", static_cast<int>(bytes.size()), bytes.data()};
      ASSERT_EQ(log.writeEvent(&event), 0);
    }
  }
  ChildProcess listen({PHAROS, "listen", "--url", "file://" + file + "?mode=r", "--summary"});
  EXPECT_EQ(listen.wait_exit(20.0), 0) << listen.text();
  EXPECT_THAT(listen.text(), HasSubstr(": 5 poses in"));
  EXPECT_THAT(listen.text(), ::testing::ContainsRegex("age on arrival: [0-9]{13,}"));
}

// A log of poses of two sources, with a covariance whose elements tell their place; every third one is refused.
void write_log_of_poses(const std::string& file) {
  lcm::LogFile log(file, "w");
  for (int i = 0; i < 9; ++i) {
    pose_t pose{};
    pose.utime = 1'700'000'000'000'000 + 10'000 * i;
    pose.sequence = i;
    pose.source = i == 8 ? "lighthouse/other" : "lighthouse/chaser";
    pose.valid = i % 3 == 2 ? 0 : 1;
    pose.status = pose.valid == 0 ? "refused_too_few" : i == 4 ? "ambiguous" : "ok";
    if (i == 8) pose.valid = 1, pose.status = "ok";
    pose.orientation_wxyz[0] = 1.0;
    pose.position_m[2] = 2.0 + i;
    for (int k = 0; k < 36; ++k) pose.covariance[k] = k % 7 == 0 ? 1e-6 * (k + 1) : 0.0;
    pose.sigma_rot_rad = std::sqrt(1e-6 * (1 + 8 + 15));
    pose.sigma_pos_m = std::sqrt(1e-6 * (22 + 29 + 36));
    std::vector<char> bytes(static_cast<std::size_t>(pose.getEncodedSize()));
    pose.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    lcm::LogEvent event{i, pose.utime, "PHAROS_LIGHTHOUSE_POSE", static_cast<int>(bytes.size()), bytes.data()};
    ASSERT_EQ(log.writeEvent(&event), 0);
  }
}

TEST(Listen, TheCovarianceOfATableIsThatOfTheMessages) {
  const test::TemporaryFolder folder;
  write_log_of_poses(folder.path("poses.lcm"));
  ChildProcess listen(
      {PHAROS, "listen", "--url", "file://" + folder.path("poses.lcm") + "?mode=r", "--format", "csv", "--covariance"});
  EXPECT_EQ(listen.wait_exit(20.0), 0) << listen.text();
  const std::string text = listen.text();
  const std::string table =
      folder.write("poses.csv", text.substr(text.find("utime,"), text.find("PHAROS_LIGHT") - text.find("utime,")));
  TableReader rows(ByteSource(table), {"cov_rx_rx_rad2", "cov_ry_ry_rad2", "cov_rz_rz_rad2", "cov_tx_tx_m2",
                                       "cov_ty_ty_m2", "cov_tz_tz_m2", "sigma_rot_deg", "sigma_pos_mm", "tz_m"});
  int poses = 0, refused = 0;
  while (rows.next()) {
    if (rows.empty(8)) {
      EXPECT_TRUE(rows.empty(0));
      ++refused;
      continue;
    }
    EXPECT_DOUBLE_EQ(std::sqrt(rows.number(0) + rows.number(1) + rows.number(2)) * kDegPerRad, rows.number(6));
    EXPECT_DOUBLE_EQ(std::sqrt(rows.number(3) + rows.number(4) + rows.number(5)) * kMmPerM, rows.number(7));
    ++poses;
  }
  EXPECT_EQ(poses, 7);
  EXPECT_EQ(refused, 2);
}

TEST(Listen, TumHoldsTheGoodPosesOfOneSourceAndSaysWhatItLeavesOut) {
  const test::TemporaryFolder folder;
  write_log_of_poses(folder.path("poses.lcm"));
  ChildProcess listen({PHAROS, "listen", "--url", "file://" + folder.path("poses.lcm") + "?mode=r", "--format", "tum"});
  EXPECT_EQ(listen.wait_exit(20.0), 0) << listen.text();
  EXPECT_THAT(listen.text(), HasSubstr("1700000000.01 0.0 0.0 3.0 0.0 0.0 0.0 1.0\n"));
  EXPECT_THAT(listen.text(),
              HasSubstr("4 rows have no TUM line: 2 refused, 1 ambiguous, 1 of another station or source"));
}

TEST(Listen, EndsWith2WithoutLcmOrTruthFile) {
  ChildProcess no_lcm({PHAROS, "listen", "--url", "nowhere://", "--duration", "0.2"});
  EXPECT_EQ(no_lcm.wait_exit(), 2);
  ChildProcess no_truth({PHAROS, "listen", "--truth", "/nowhere/truth.csv"});
  EXPECT_EQ(no_truth.wait_exit(), 2);
  EXPECT_THAT(no_truth.text(), HasSubstr("/nowhere/truth.csv: cannot be opened"));
}

}  // namespace
}  // namespace pharos::host
