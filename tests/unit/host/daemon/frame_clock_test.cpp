// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/frame_clock.hpp"

#include <gtest/gtest.h>

namespace pharos::host {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kPeriod = kSecond / 30;
constexpr std::int64_t kUtcZero = 1'700'000'000 * kSecond;

/// A camera whose frames arrive `latency` after their exposure. Times count from the first frame.
class FakeCamera {
 public:
  DepthFrame frame(std::int64_t at_ns, std::int64_t latency_ns = 5 * kMs) const {
    DepthFrame frame;
    frame.session = session;
    frame.clock = clock;
    frame.camera_ns = camera_zero_ns + at_ns + at_ns / 1'000'000 * drift_ppm;
    frame.arrival_monotonic_ns = 50 * kSecond + at_ns + latency_ns;
    frame.arrival_utc_ns = kUtcZero + at_ns + latency_ns;
    frame.complete_monotonic_ns = frame.arrival_monotonic_ns;
    return frame;
  }
  std::int64_t camera_zero_ns = 1000 * kSecond;
  std::int64_t drift_ppm = 0;
  std::uint32_t session = 1;
  CameraClock clock = CameraClock::kOwn;
};

TEST(FrameClock, MapsACameraThatDriftsByTheArrivalOfItsFrames) {
  FakeCamera camera;
  camera.drift_ppm = 80;
  FrameClock clock;
  std::int64_t at_ns = 0;
  std::optional<MappedTime> time;
  for (int i = 0; i < 900; ++i, at_ns += kPeriod) {
    time = clock.time_of(camera.frame(at_ns, (5 + i * 7 % 11) * kMs));  // 5 to 15 ms late
  }
  ASSERT_TRUE(time);
  // The minimum latency cannot be observed from arrivals alone.
  EXPECT_NEAR(static_cast<double>(time->utc_ns - (kUtcZero + at_ns - kPeriod)), 5.0 * kMs, 0.2 * kMs);
  EXPECT_NEAR(clock.map().drift_ppm(), 80.0, 5.0);
  EXPECT_FALSE(clock.by_ptp());
}

TEST(FrameClock, BeginsAnewWithEveryOpeningOfTheCamera) {
  FakeCamera camera;
  FrameClock clock;
  std::int64_t at_ns = 0;
  for (int i = 0; i < 30; ++i, at_ns += kPeriod) clock.time_of(camera.frame(at_ns));
  camera.session = 2;
  camera.camera_zero_ns = 3 * kSecond;  // it was switched off and on
  std::optional<MappedTime> time;
  int without = 0;
  for (int i = 0; i < 30; ++i, at_ns += kPeriod) {
    time = clock.time_of(camera.frame(at_ns));
    without += time ? 0 : 1;
  }
  EXPECT_LE(without, 7) << "0.2 s";
  ASSERT_TRUE(time);
  EXPECT_NEAR(static_cast<double>(time->utc_ns - (kUtcZero + at_ns - kPeriod)), 5.0 * kMs, 1.0 * kMs);
}

TEST(FrameClock, AcceptsPtpButForWholeSeconds) {
  for (const std::int64_t ahead_s : {0, 37}) {  // UTC, TAI
    FakeCamera camera;
    camera.clock = CameraClock::kPtp;
    camera.camera_zero_ns = kUtcZero + ahead_s * kSecond;
    FrameClock clock;
    std::optional<MappedTime> time;
    std::int64_t at_ns = 0;
    for (int i = 0; i < 60; ++i, at_ns += kPeriod) time = clock.time_of(camera.frame(at_ns, 12 * kMs));
    ASSERT_TRUE(time);
    EXPECT_TRUE(clock.by_ptp());
    EXPECT_NEAR(static_cast<double>(time->utc_ns - (kUtcZero + at_ns - kPeriod)), 0.0, 1e3);
    EXPECT_EQ(time->sigma_ns, FrameClock::kPtpSigma_ns);
    // Ages include the latency that arrivals do not show.
    EXPECT_NEAR(static_cast<double>(time->monotonic_ns - (50 * kSecond + at_ns - kPeriod)), 0.0, 1e3);
  }
}

// The camera's delay is not observable from arrivals; what PTP showed of it is not forgotten with its master.
TEST(FrameClock, KeepsTheDelayThatPtpShowedWhenTheCameraNoLongerFollowsIt) {
  FakeCamera camera;
  camera.clock = CameraClock::kPtp;
  camera.camera_zero_ns = kUtcZero + 37 * kSecond;
  camera.drift_ppm = 20;  // as of the master against this computer
  FrameClock clock;
  std::optional<MappedTime> time;
  std::int64_t at_ns = 0;
  for (int i = 0; i < 300; ++i, at_ns += kPeriod) clock.time_of(camera.frame(at_ns, (12 + i * 7 % 11) * kMs));
  ASSERT_TRUE(clock.by_ptp());
  camera.clock = CameraClock::kOwn;
  for (int i = 0; i < 300; ++i, at_ns += kPeriod) {
    time = clock.time_of(camera.frame(at_ns, (12 + i * 7 % 11) * kMs));
    ASSERT_TRUE(time);
    ASSERT_FALSE(clock.by_ptp());
    EXPECT_GT(time->sigma_ns, FrameClock::kPtpSigma_ns);
    ASSERT_NEAR(static_cast<double>(time->utc_ns - (kUtcZero + at_ns)), 0.0, 0.5 * kMs);
    ASSERT_NEAR(static_cast<double>(time->monotonic_ns - (50 * kSecond + at_ns)), 0.0, 0.5 * kMs);
  }
  camera.session = 2;  // perhaps in another mode, with another delay
  for (int i = 0; i < 30; ++i, at_ns += kPeriod) time = clock.time_of(camera.frame(at_ns, 12 * kMs));
  ASSERT_TRUE(time);
  EXPECT_NEAR(static_cast<double>(time->utc_ns - (kUtcZero + at_ns - kPeriod)), 12.0 * kMs, 1.0 * kMs);
}

TEST(FrameClock, RejectsPtpThatDisagreesWithArrivals) {
  FakeCamera camera;
  camera.clock = CameraClock::kPtp;
  camera.camera_zero_ns = kUtcZero + 400 * kMs;
  FrameClock clock;
  std::optional<MappedTime> time;
  for (std::int64_t at_ns = 0; at_ns < kSecond; at_ns += kPeriod) time = clock.time_of(camera.frame(at_ns));
  ASSERT_TRUE(time);
  EXPECT_FALSE(clock.by_ptp());
  EXPECT_GT(clock.ptp_doubted(), 0);
}

TEST(FrameClock, TakesTheTimeOfRecordedFramesAsItIs) {
  FrameClock clock;
  DepthFrame frame;
  frame.clock = CameraClock::kHost;
  frame.camera_ns = kUtcZero;
  frame.arrival_monotonic_ns = 7;
  const auto time = clock.time_of(frame);
  ASSERT_TRUE(time);
  EXPECT_EQ(time->utc_ns, kUtcZero);
  EXPECT_EQ(time->monotonic_ns, 7);
}

}  // namespace
}  // namespace pharos::host
