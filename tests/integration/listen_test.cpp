// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <vector>

#include "host/cameras/rig_file.hpp"
#include "integration/daemon_under_test.hpp"
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

TEST(Listen, EndsWith2WithoutLcmOrTruthFile) {
  ChildProcess no_lcm({PHAROS, "listen", "--url", "nowhere://", "--duration", "0.2"});
  EXPECT_EQ(no_lcm.wait_exit(), 2);
  ChildProcess no_truth({PHAROS, "listen", "--truth", "/nowhere/truth.csv"});
  EXPECT_EQ(no_truth.wait_exit(), 2);
  EXPECT_THAT(no_truth.text(), HasSubstr("/nowhere/truth.csv: cannot be opened"));
}

}  // namespace
}  // namespace pharos::host
