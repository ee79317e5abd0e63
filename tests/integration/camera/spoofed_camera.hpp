// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include "integration/camera/attacked_daemon.hpp"
#include "integration/camera/spoofed_frames.hpp"

namespace pharos::host {

/// pharosd and a camera for which another sender poses: complete frames, with a target at some 17 cm from the true one.
class SpoofedCamera : public AttackedDaemon {
 protected:
  static constexpr std::int32_t kShift_px = 34;
  static constexpr double kRate_hz = 20.0;            // so that a target may move by 5 cm from frame to frame
  static constexpr std::size_t kPacket_bytes = 9000;  // as in kByAddress

  void start_camera(bool with_lighthouse = false) {
    play.frame_rate_hz = kRate_hz;
    served_ns_ = monotonic_now_ns();
    if (with_lighthouse) {
      start_both();
      return;
    }
    serve();
    start(kByAddress);
    ASSERT_TRUE(poses_come(3)) << daemon.process().text();
  }
  std::int64_t camera_time_ns() const {
    return std::llround(play.clock_start_s * 1e9) + monotonic_now_ns() - served_ns_;
  }
  SpoofedHead next_head(int ahead) const {
    constexpr int kFirst = 65'400;  // of Aravis' simulated camera
    constexpr int kNumbers = 65'535;
    const int number = (kFirst - 1 + static_cast<int>(camera->frames()) + ahead) % kNumbers;
    return {static_cast<std::uint16_t>(number == 0 ? kNumbers : number), camera_time_ns()};
  }
  /// Sends a frame to every port of the camera's process.
  void spoof(int socket, const SpoofedHead& head) {
    const double scale_m = play.scale_m;
    const sim::WireScale scale{{scale_m, scale_m, scale_m}, {-32'768.0 * scale_m, -32'768.0 * scale_m, 0.0}};
    const SpoofedFrames frames(sequence, scale, kShift_px, kPacket_bytes);
    for (const std::uint16_t port : ports_of_others()) frames.send(socket, port, head);
  }
  void send(int socket, const SpoofedHead& head) {
    spoof(socket, head);
    daemon.wait([] { return false; }, 0.15);
  }
  std::int64_t discarded(const char* counter) { return daemon.counter(std::string("device.") + counter, kCamera); }
  std::string counters() {
    std::string text = daemon.process().text();
    for (const counter_t& counter : daemon.source(kCamera)->counters) {
      if (counter.value != 0) text += "\n" + counter.name + ' ' + std::to_string(counter.value);
    }
    return text;
  }
  void expect_truth_goes_on() {
    EXPECT_TRUE(poses_come(5)) << daemon.process().text();
    expect_true_poses();
    EXPECT_EQ(discarded("camera_process_deaths"), 0);
  }

  std::int64_t served_ns_ = 0;
};

}  // namespace pharos::host
