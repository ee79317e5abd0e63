// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "host/cameras/camera_file.hpp"
#include "host/runtime/now.hpp"
#include "integration/camera/network_namespace.hpp"
#include "integration/daemon_under_test.hpp"
#include "tools/sim/camera/fake_helios.hpp"
#include "tools/sim/camera/make_sequence.hpp"

namespace pharos::host {

inline constexpr double kTimeout_s = 60.0;  // allows for other load
inline constexpr const char* kByAddress = "address = '127.0.0.1'\npacket_size = 9000\n";

/// pharosd and the simulated Helios with the simulated satellite.
class PharosdTofTest : public ::testing::Test {
 protected:
  void render(const std::string& scenario, std::size_t frames) {
    sequence = sim::sequence_of_scenario(std::string(PHAROS_SCENARIOS) + "/" + scenario, 1, frames,
                                         daemon.folder() / "helios.toml", [] {});
  }
  void serve() { camera.emplace(sequence, play, nullptr, monotonic_now_ns()); }
  void start(const std::string& source, const std::string& more = "") {
    std::ofstream(daemon.folder() / "pharosd.toml")
        << "[lcm]\nurl = '" << daemon.url() << "'\n[publish]\nstatus_rate_hz = 10\nmax_age_s = 5.0\n"
        << "[[camera]]\nname = 'helios'\ntarget = 'client'\ncamera_file = 'helios.toml'\n"
        << source << more;
    daemon.start();
  }
  bool poses_come(std::size_t count) {
    const std::size_t wanted = daemon.valid_poses("client") + count;
    return daemon.wait([&] { return daemon.valid_poses("client") >= wanted; }, kTimeout_s);
  }
  /// Checks that every valid pose is near the truth: within 10 mm and 2 deg.
  void expect_true_poses() {
    const auto& truth = *sequence.frames[0].T_camera_target;
    for (const pose_t& pose : daemon.poses()) {
      if (pose.valid == 0 || pose.target != "client") continue;
      const Quaternion q(pose.orientation_wxyz[0], pose.orientation_wxyz[1], pose.orientation_wxyz[2],
                         pose.orientation_wxyz[3]);
      const Pose<frame::Camera, frame::Target> measured{
          q.toRotationMatrix(), Vector3(pose.position_m[0], pose.position_m[1], pose.position_m[2])};
      const Vector6 error = pose_difference(measured, truth);
      EXPECT_LT(error.tail<3>().norm(), 0.01);
      EXPECT_LT(error.head<3>().norm(), 0.035);
    }
  }

  DaemonUnderTest daemon;
  sim::FrameSequence sequence;
  sim::CameraPlay play;
  std::optional<sim::FakeHelios> camera;
};

}  // namespace pharos::host
