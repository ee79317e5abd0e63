// SPDX-License-Identifier: Apache-2.0
// Hard kills of pharosd, unplugged lines, a full disk.
#include <sched.h>
#include <sys/mount.h>

#include <csignal>
#include <random>

#include "campaigns/attack/attacked_lighthouse.hpp"
#include "campaigns/attack/command.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecorded = "[recording]\ndirectory = 'raw'\n";
constexpr const char* kRemembered = "state_directory = 'state'\n";
constexpr std::uint32_t kStation = 0xBEC08E38;

class AttackedService : public AttackedLighthouse {
 protected:
  void send_calibration() {
    for (int i = 0; i < 2; ++i) line.write(target.ootx(0, kStation));
  }
};

// Killed at any instant, also while it records and remembers: it starts again, and what was recorded is readable.
TEST_F(AttackedService, HardKills) {
  const auto kills = static_cast<int>(campaign_size("PHAROS_ATTACK_KILLS", 20));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> life_s(0.0, 1.0);
  start(kRecorded, kRemembered);
  std::int64_t unreadable = 0;
  for (int kill = 0; kill < kills; ++kill) {
    if (kill > 0) daemon.start();
    send_calibration();
    ASSERT_TRUE(poses_come(5)) << daemon.process().text();
    play_for(life_s(random));
    daemon.process().signal(SIGKILL);
    daemon.process().wait_exit();
  }
  std::size_t files = 0;
  for (const auto& file : fs::directory_iterator(daemon.folder() / "raw")) {
    const CommandResult read = run_command({PHAROS, "decode", file.path()});
    unreadable += read.exit_code == 0 ? 0 : 1;
    ++files;
  }
  EXPECT_FALSE(fs::exists(daemon.folder() / "state" / "stations.toml.damaged"));
  EXPECT_EQ(unreadable, 0);
  daemon.start();
  EXPECT_TRUE(measures()) << daemon.process().text();
  play_for(2.0);
  const int wrong = false_poses();
  const std::int64_t lost = lost_poses();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(lost, 0);
  add_row({"hard kills of pharosd",
           std::to_string(kills) + " SIGKILL; " + std::to_string(files) + " recordings, " + std::to_string(unreadable) +
               " unreadable",
           wrong, lost, memory()});
}

TEST_F(AttackedService, Unplugs) {
  const auto unplugs = static_cast<int>(campaign_size("PHAROS_ATTACK_UNPLUGS", 20));
  daemon.write_config();
  daemon.start();
  for (int unplug = 0; unplug < unplugs; ++unplug) {
    PseudoTerminal other;
    daemon.plug_in(other);
    ASSERT_TRUE(poses_come(20, other)) << daemon.process().text();
    StationaryTarget::Bytes half = target.hello("cut in the middle");
    half.resize(half.size() / 2);
    other.write(half);
    daemon.pull_out();
  }
  daemon.plug_in(line);
  EXPECT_TRUE(measures()) << daemon.process().text();
  EXPECT_TRUE(daemon.wait([&] { return daemon.counter("port.lost") == unplugs; }));
  play_for(2.0);
  const int wrong = false_poses();
  const std::int64_t lost = lost_poses();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(lost, 0);
  add_row({"unplugged in the middle of a frame", std::to_string(unplugs) + " times", wrong, lost, memory()});
}

// A file system of 64 KiB if this process may mount one, otherwise files limited to 8 KiB.
TEST_F(AttackedService, FullDisk) {
  const fs::path disk = daemon.folder() / "disk";
  fs::create_directories(disk);
  const bool mounted = ::unshare(CLONE_NEWNS) == 0 &&
                       ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                       ::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") == 0;
  start("[recording]\ndirectory = 'disk/raw'\n", "state_directory = 'disk/state'\n", mounted ? 0 : 8192);
  send_calibration();
  ASSERT_TRUE(measures()) << daemon.process().text();
  ASSERT_TRUE(play_until([&] { return daemon.counter("recording.bytes_lost") > 0; })) << daemon.process().text();
  EXPECT_NE(daemon.status()->state, "ok");
  restart_count();
  play_for(10.0);
  const int wrong = false_poses();
  const std::int64_t lost = lost_poses();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(lost, 0);
  add_row({"full disk: recording and state",
           std::string(mounted ? "64 KiB" : "files of 8 KiB at most") + ", " + std::to_string(sweeps_sent()) +
               " sweeps after it was full; " + std::to_string(daemon.counter("recording.bytes_lost")) +
               " bytes counted as not recorded",
           wrong, lost, memory()});
  EXPECT_EQ(stop(), 0);
  if (mounted) ::umount2(disk.c_str(), MNT_DETACH);
}

}  // namespace
}  // namespace pharos::host
