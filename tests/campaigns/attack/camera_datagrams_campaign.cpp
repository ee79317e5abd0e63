// SPDX-License-Identifier: Apache-2.0
// A million hostile datagrams to a camera's process while a lighthouse and the camera measure.
#include <atomic>
#include <csignal>
#include <thread>

#include "campaigns/attack/campaign_table.hpp"
#include "integration/camera/attacked_daemon.hpp"

namespace pharos::host {
namespace {

class AttackedCamera : public AttackedDaemon {
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
  std::string memory() { return peak_memory("pharosd", daemon.process().pid()); }
};

TEST_F(AttackedCamera, DatagramsToItsPorts) {
  constexpr int kBurst = 40;
  const std::int64_t datagrams = campaign_size("PHAROS_ATTACK_DATAGRAMS", 1'000'000);
  start_both();
  ASSERT_TRUE(both_measure()) << daemon.process().text();
  HostileSender sender(1);
  std::atomic<bool> stop{false};
  std::thread attack([&] {
    while (!stop && sender.sent() < datagrams) {
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
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(daemon.counter("device.camera_process_deaths", kCamera), 0);
  add_row({"datagrams to a camera",
           std::to_string(sender.sent()) + " hostile datagrams, " +
               std::to_string(daemon.counter("device.datagrams_discarded", kCamera)) +
               " discarded by the kernel; camera back after " + seconds_text(back_s),
           wrong, lost, memory() + ", " + peak_memory("pharos-camera", camera_process())});
}

TEST_F(AttackedCamera, KillsOfItsProcess) {
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
  add_row({"camera's process killed",
           std::to_string(kKills) + " SIGKILL; at most " + seconds_text(longest_s) + " to the next pose", wrong, lost,
           memory()});
}

}  // namespace
}  // namespace pharos::host
