// SPDX-License-Identifier: Apache-2.0
// A million hostile datagrams to a camera's process while a lighthouse and the camera measure.
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "integration/camera/attacked_daemon.hpp"

namespace pharos::host {
namespace {

const ::testing::Environment* const kNetwork = ::testing::AddGlobalTestEnvironment(new NetworkNamespace);

/// VmHWM of a process, MiB: the most it had resident.
double peak_mib(pid_t process) {
  std::ifstream about("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(about, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::atof(line.c_str() + 6) / 1024.0;
  }
  return 0.0;
}

std::int64_t datagrams() {
  const char* asked = std::getenv("PHAROS_ATTACK_DATAGRAMS");
  return asked == nullptr ? 1'000'000 : std::atoll(asked);
}

class AttackCampaign : public AttackedDaemon {
 protected:
  /// Poses that are not true, of both.
  int false_poses() {
    int count = 0;
    for (const pose_t& pose : daemon.poses()) {
      const auto& truth = *sequence.frames[0].T_camera_target;
      const Vector3 expected = pose.target == kCamera ? truth.t : target.truth().t;
      const Vector3 position(pose.position_m[0], pose.position_m[1], pose.position_m[2]);
      count += pose.valid != 0 && (position - expected).norm() > 0.01 ? 1 : 0;
    }
    return count;
  }
};

TEST_F(AttackCampaign, DatagramsToACamerasPorts) {
  constexpr int kBurst = 40;
  start_both();
  ASSERT_TRUE(both_measure()) << daemon.process().text();
  HostileSender sender(1);
  std::atomic<bool> stop{false};
  std::thread attack([&] {
    while (!stop && sender.sent() < datagrams()) {
      for (const Attacker attacker : kAttackers) {
        for (const std::uint16_t port : ports_of_others()) sender.send(attacker, port, kBurst);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));  // the lighthouse's simulator needs its turn too
    }
    stop = true;
  });
  const bool ended = play_until([&] { return stop.load(); }, 1500.0);
  stop = true;
  attack.join();
  EXPECT_TRUE(ended);
  const std::int64_t began_ns = monotonic_now_ns();
  ASSERT_TRUE(camera_poses_come(3)) << daemon.process().text();
  const double back_s = static_cast<double>(monotonic_now_ns() - began_ns) * 1e-9;
  const std::int64_t lost = lighthouse_poses_lost();
  const int wrong = false_poses();
  const std::int64_t deaths = daemon.counter("device.camera_process_deaths", kCamera);
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(wrong, 0);
  std::printf("test                    | load                | false | lost | memory\n");
  std::printf("datagrams to a camera   | %9lld datagrams | %5d | %4lld | pharosd %.0f MiB, pharos-camera %.0f MiB\n",
              static_cast<long long>(sender.sent()), wrong, static_cast<long long>(lost),
              peak_mib(daemon.process().pid()), peak_mib(camera_process()));
  std::printf(
      "discarded by the kernel %lld, frames discarded %lld, process deaths %lld, camera poses %zu, back after %.1f s\n",
      static_cast<long long>(daemon.counter("device.datagrams_discarded", kCamera)),
      static_cast<long long>(daemon.counter("device.frames_out_of_order", kCamera)), static_cast<long long>(deaths),
      daemon.valid_poses(kCamera), back_s);
}

TEST_F(AttackCampaign, KillsOfACamerasProcess) {
  constexpr int kKills = 5;
  start_both();
  ASSERT_TRUE(both_measure()) << daemon.process().text();
  double longest_s = 0.0;
  for (int kill = 1; kill <= kKills; ++kill) {
    // As after a quiet time: else each restart waits twice as long as the one before.
    constexpr double kGoodLife_s = 10.5;
    play_until([] { return false; }, kGoodLife_s);
    const std::int64_t began_ns = monotonic_now_ns();
    ::kill(camera_process(), SIGKILL);
    ASSERT_TRUE(play_until([&] { return daemon.source(kCamera)->state == "gone"; }));
    ASSERT_TRUE(camera_poses_come(1)) << daemon.process().text();
    longest_s = std::max(longest_s, static_cast<double>(monotonic_now_ns() - began_ns) * 1e-9);
  }
  const std::int64_t lost = lighthouse_poses_lost();
  const int wrong = false_poses();
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(wrong, 0);
  std::printf("test                    | load                | false | lost | memory\n");
  std::printf("camera's process killed | %9d times     | %5d | %4lld | pharosd %.0f MiB\n", kKills, wrong,
              static_cast<long long>(lost), peak_mib(daemon.process().pid()));
  std::printf("kill to the next pose %.2f s at the most\n", longest_s);
}

}  // namespace
}  // namespace pharos::host
