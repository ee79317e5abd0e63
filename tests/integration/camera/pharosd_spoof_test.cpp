// SPDX-License-Identifier: Apache-2.0
// Frames of another sender: complete, with a target at some 17 cm from the true one.
#include "integration/camera/spoofed_camera.hpp"

namespace pharos::host {
namespace {

constexpr int kFrames = 6;

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
