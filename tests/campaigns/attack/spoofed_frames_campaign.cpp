// SPDX-License-Identifier: Apache-2.0
// Whole frames of another sender, with a target at some 17 cm from the true one, while a lighthouse measures.
#include "campaigns/attack/campaign_table.hpp"
#include "integration/camera/spoofed_camera.hpp"

namespace pharos::host {
namespace {

class SpoofedCameraCampaign : public SpoofedCamera {
 protected:
  /// Sends `count` frames, each after some of the camera's own.
  template <class Head>
  void spoof_often(int socket, int count, const Head& head) {
    for (int i = 0; i < count; ++i) {
      spoof(socket, head(i));
      const std::int64_t end_ns = monotonic_now_ns() + 100'000'000;
      play_until([&] { return monotonic_now_ns() >= end_ns; });
    }
  }
  /// Adds the row; false poses.
  int report(const std::string& test, int frames) {
    EXPECT_TRUE(camera_poses_come(5)) << counters();
    const int wrong = false_poses();
    const std::int64_t lost = lighthouse_poses_lost();
    EXPECT_EQ(lost, 0);
    add_row(
        {test,
         std::to_string(frames) + " frames; " + std::to_string(daemon.valid_poses(kCamera)) + " poses of the camera",
         wrong, lost,
         peak_memory("pharosd", daemon.process().pid()) + ", " + peak_memory("pharos-camera", camera_process())});
    return wrong;
  }
  int false_poses() const {
    const auto& truth = *sequence.frames[0].T_camera_target;
    int count = 0;
    for (const pose_t& pose : daemon.poses()) {
      if (pose.valid == 0 || pose.target != kCamera) continue;
      const Vector3 position(pose.position_m[0], pose.position_m[1], pose.position_m[2]);
      count += (position - truth.t).norm() > 0.01 ? 1 : 0;
    }
    return count;
  }
};

TEST_F(SpoofedCameraCampaign, FramesThatCanBeTold) {
  const int count = static_cast<int>(campaign_size("PHAROS_ATTACK_FRAMES", 60));
  start_camera(true);
  ASSERT_TRUE(both_measure()) << daemon.process().text();
  const UniqueFd other_address = bound_socket("127.0.0.3");
  const UniqueFd other_port = bound_socket("127.0.0.1");
  spoof_often(other_address.get(), count, [&](int) { return next_head(1); });
  spoof_often(other_port.get(), count, [&](int) { return next_head(1); });
  spoof_often(socket_of_simulated_camera(), count, [&](int i) { return next_head(20'000 + i); });
  spoof_often(socket_of_simulated_camera(), count, [&](int) {
    SpoofedHead head = next_head(3);
    head.camera_ns += 3'000'000'000;
    return head;
  });
  EXPECT_EQ(report("spoofed frames: other address, port, number, time", 4 * count), 0) << counters();
}

// Bursts shorter than half a second: longer ones replace the camera, which no check detects (SECURITY.md).
TEST_F(SpoofedCameraCampaign, FramesThatAreWrongInTheTargetsPlaceOnly) {
  constexpr int kBurst = 6;
  const int bursts = static_cast<int>(campaign_size("PHAROS_ATTACK_FRAMES", 60)) / kBurst;
  start_camera(true);
  ASSERT_TRUE(both_measure()) << daemon.process().text();
  for (int burst = 0; burst < bursts; ++burst) {
    spoof_often(socket_of_simulated_camera(), kBurst, [&](int) { return next_head(7); });
    ASSERT_TRUE(camera_poses_come(20)) << counters();
  }
  EXPECT_EQ(report("spoofed frames: other place, six in a row", bursts * kBurst), 0) << counters();
}

}  // namespace
}  // namespace pharos::host
