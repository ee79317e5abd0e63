// SPDX-License-Identifier: Apache-2.0
// Frames of another sender: complete, with a target at some 17 cm from the true one.
#include "integration/camera/attacked_daemon.hpp"
#include "integration/camera/spoofed_frames.hpp"

namespace pharos::host {
namespace {

constexpr std::int32_t kShift_px = 34;
constexpr double kRate_hz = 20.0;            // so that a target may move by 5 cm from frame to frame
constexpr std::size_t kPacket_bytes = 9000;  // as in kByAddress
constexpr int kFrames = 6;

class SpoofedCamera : public AttackedDaemon {
 protected:
  void start_camera() {
    play.frame_rate_hz = kRate_hz;
    serve();
    served_ns_ = monotonic_now_ns();
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
  void send(int socket, const SpoofedHead& head) {
    const double scale_m = play.scale_m;
    const sim::WireScale scale{{scale_m, scale_m, scale_m}, {-32'768.0 * scale_m, -32'768.0 * scale_m, 0.0}};
    const SpoofedFrames frames(sequence, scale, kShift_px, kPacket_bytes);
    for (const std::uint16_t port : ports_of_others()) frames.send(socket, port, head);
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

TEST_F(SpoofedCamera, FramesFromAnotherAddressOrPortNeverReachTheLibrary) {
  start_camera();
  for (const char* address : {"127.0.0.3", "127.0.0.1"}) {
    const UniqueFd socket = bound_socket(address);
    const std::int64_t before = discarded("datagrams_discarded");
    for (int i = 0; i < kFrames; ++i) send(socket.get(), next_head(1));
    ASSERT_TRUE(daemon.wait([&] { return discarded("datagrams_discarded") > before + kFrames * 200; }))
        << address << counters();
  }
  EXPECT_EQ(discarded("frames_out_of_order"), 0);
  expect_truth_goes_on();
}

TEST_F(SpoofedCamera, FramesWithNumbersThatTheCameraCannotHaveCountedToAreDiscarded) {
  start_camera();
  for (int i = 0; i < kFrames; ++i) send(socket_of_simulated_camera(), next_head(20'000 + i));
  ASSERT_TRUE(daemon.wait([&] { return discarded("frames_out_of_order") > 0; }));
  expect_truth_goes_on();
}

TEST_F(SpoofedCamera, FramesWithTimesThatAreNotOfTheCamerasClockAreDiscarded) {
  start_camera();
  for (int i = 0; i < kFrames; ++i) {
    SpoofedHead head = next_head(3);
    head.camera_ns += 3'000'000'000;
    send(socket_of_simulated_camera(), head);
  }
  ASSERT_TRUE(daemon.wait([&] { return discarded("frames_wrong_time") > 0; }));
  expect_truth_goes_on();
}

// Address, port, number and time are the camera's: only the check for jumps of the target remains. Numbers are seven
// ahead, so that no frame has packets of both senders, which cannot be detected (SECURITY).
TEST_F(SpoofedCamera, FramesThatAreRightInEverythingButTheTargetsPlaceGiveNoPose) {
  start_camera();
  for (int i = 0; i < kFrames; ++i) send(socket_of_simulated_camera(), next_head(7));
  ASSERT_TRUE(daemon.wait([&] { return daemon.counter("refused.jump", kCamera) > 0; })) << counters();
  expect_truth_goes_on();
}

}  // namespace
}  // namespace pharos::host
