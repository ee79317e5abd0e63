// SPDX-License-Identifier: Apache-2.0
// A target of Lighthouse 2.0 from its light to poses on LCM: pharos sim serial, a pseudo-terminal, pharosd.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include "host/table/table_reader.hpp"
#include "integration/daemon_under_test.hpp"

namespace pharos::host {
namespace {

constexpr std::size_t kPoses = 60;
// A busy computer delivers late, and a pose is then stamped late, never early: the body was there within this time.
constexpr double kLate_s = 5.0;

struct TruePosition {
  double utc_s = 0.0;
  Vector3 position_m;
};

// The example scenario, so long, beside its target.
std::string scenario_of(const std::filesystem::path& folder, const std::string& name, const std::string& duration_s) {
  const std::string scenarios = PHAROS_SCENARIOS;
  std::ostringstream text;
  text << std::ifstream(scenarios + "/lh2.toml").rdbuf();
  std::string content = text.str();
  const auto replace = [&](const std::string& what, const std::string& with) {
    content.replace(content.find(what), what.size(), with);
  };
  replace("duration_s = 20.0", "duration_s = " + duration_s);
  replace("\"target12.csv\"", "\"" + scenarios + "/target12.csv\"");
  std::ofstream(folder / name) << content;
  return (folder / name).string();
}

std::vector<TruePosition> truth_of(const std::filesystem::path& file) {
  TableReader rows(ByteSource(file.string()), {"utime", "tx_m", "ty_m", "tz_m"});
  std::vector<TruePosition> out;
  while (rows.next()) out.push_back({rows.number(0) * 1e-6, {rows.number(1), rows.number(2), rows.number(3)}});
  return out;
}

double distance_from_path_m(const pose_t& pose, const std::vector<TruePosition>& truth) {
  const Vector3 t(pose.position_m[0], pose.position_m[1], pose.position_m[2]);
  const double utc_s = static_cast<double>(pose.utime) * 1e-6;
  double nearest_m = 1e9;
  for (const TruePosition& one : truth) {
    if (one.utc_s > utc_s + 0.002 || one.utc_s < utc_s - kLate_s) continue;
    nearest_m = std::min(nearest_m, (one.position_m - t).norm());
  }
  return nearest_m;
}

TEST(Lh2Live, ATargetOnASerialLineBecomesPosesInTheWorld) {
  DaemonUnderTest daemon;
  const std::filesystem::path& folder = daemon.folder();
  // The room's stations as they announce themselves: the same seed, the same room.
  ChildProcess room({PHAROS, "sim", "lighthouse", scenario_of(folder, "room.toml", "0.1"), "--seed", "4", "--output",
                     (folder / "room").string()});
  ASSERT_EQ(room.wait_exit(30.0), 0) << room.text();
  std::ofstream(folder / "pharosd.toml") << "[lcm]\nurl = '" << daemon.url()
                                         << "'\n[publish]\nmax_age_s = 10\n[[target]]\nname = 'dock'\nport = '"
                                         << daemon.port()
                                         << "'\nbaud = 12000000\ntarget_file = 'room/target.csv'\ngeneration = 2\n"
                                         << "stations_file = 'room/stations.toml'\n";
  ChildProcess target({PHAROS, "sim", "serial", scenario_of(folder, "live.toml", "60.0"), "--seed", "4", "--link",
                       daemon.port(), "--truth", (folder / "truth.csv").string()});
  ASSERT_TRUE(target.wait_for("/dev/pts/")) << target.text();
  daemon.start();
  ASSERT_TRUE(daemon.wait([&] { return daemon.valid_poses() >= kPoses; }, 40.0)) << daemon.process().text();
  target.signal(SIGINT);
  EXPECT_EQ(target.wait_exit(20.0), 0) << target.text();
  const std::vector<TruePosition> truth = truth_of(folder / "truth.csv");
  for (const pose_t& pose : daemon.poses()) {
    if (pose.status != "ok") continue;
    EXPECT_EQ(pose.parent_frame, "world");
    EXPECT_LT(distance_from_path_m(pose, truth), 0.006) << pose.utime;
    EXPECT_LT(pose.sigma_pos_m, 0.02);
  }
}

}  // namespace
}  // namespace pharos::host
