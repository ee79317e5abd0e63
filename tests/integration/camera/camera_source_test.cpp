// SPDX-License-Identifier: Apache-2.0
// A camera on a real network: GigE Vision over loopback, with the simulated Helios.
#include "host/camera_link/camera_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <functional>

#include "host/runtime/now.hpp"
#include "integration/camera/network_namespace.hpp"
#include "tools/sim/camera/fake_helios.hpp"

namespace pharos::host {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;

const ::testing::Environment* const kNetwork = ::testing::AddGlobalTestEnvironment(new NetworkNamespace);

constexpr std::int32_t kWidth = 64;
constexpr std::int32_t kHeight = 48;
constexpr double kRange_m = 3.0;
constexpr std::int64_t kTimeout_ns = 20'000'000'000;

class CameraSourceTest : public ::testing::Test {
 protected:
  CameraSourceTest() {
    sequence.width_px = kWidth;
    sequence.height_px = kHeight;
    for (std::uint16_t i = 0; i < 3; ++i) {
      const std::size_t pixels = kWidth * kHeight;
      sequence.frames.push_back({std::vector<std::uint16_t>(pixels, static_cast<std::uint16_t>(1000 + i)),
                                 std::vector<std::uint16_t>(pixels, static_cast<std::uint16_t>(kRange_m / 0.00025)),
                                 std::nullopt});
    }
    settings.address = "127.0.0.1";
    settings.packet_size = 9000;
    settings.width_px = kWidth;
    settings.height_px = kHeight;
  }

  void serve() { camera.emplace(sequence, play, nullptr, monotonic_now_ns()); }

  /// Takes frames until `done`; false after a long time.
  bool run(CameraSource& source, const std::function<bool()>& done) {
    const std::int64_t until_ns = monotonic_now_ns() + kTimeout_ns;
    while (!done()) {
      if (monotonic_now_ns() > until_ns) return false;
      pollfd waiting{source.fd(), POLLIN, 0};
      ::poll(&waiting, 1, 20);
      if (DepthFramePtr frame = source.take()) {
        ++taken;
        last = *frame;
        bad_pixels += std::count_if(frame->intensity.begin(), frame->intensity.end(),
                                    [](std::uint16_t value) { return value < 1000 || value > 1002; });
        source.recycle(std::move(frame));
      }
    }
    return true;
  }
  bool frames_come(CameraSource& source, int count) {
    const int wanted = taken + count;
    return run(source, [&] { return taken >= wanted; });
  }
  bool wait_for_error(CameraSource& source, const std::string& words) {
    return run(source, [&] { return source.status().error.find(words) != std::string::npos; });
  }

  sim::FrameSequence sequence;
  sim::CameraPlay play;
  CameraSettings settings;
  std::optional<sim::FakeHelios> camera;
  int taken = 0;
  std::ptrdiff_t bad_pixels = 0;
  DepthFrame last;
};

TEST_F(CameraSourceTest, GivesWholeFramesInTheScaleOfTheModeThatItSet) {
  serve();
  settings.mode = "Distance3000mmSingleFreq";  // the camera starts in another, with another scale
  CameraSource source(settings, camera_program());
  ASSERT_TRUE(frames_come(source, 5)) << source.status().error;
  ASSERT_TRUE(last.scale);
  EXPECT_NEAR(last.depth[0] * last.scale->scale_m[2] + last.scale->offset_m[2], kRange_m, 1e-4);
  EXPECT_NEAR(last.scale->scale_m[2], play.fine_scale_m, 1e-12);
  EXPECT_LT(last.scale->offset_m[0], 0.0);
  EXPECT_FALSE(last.taken_in_turns);
  EXPECT_EQ(bad_pixels, 0);
  const FrameSourceStatus status = source.status();
  EXPECT_EQ(status.state, CameraState::kOpen);
  EXPECT_THAT(status.identity, HasSubstr("Distance3000mmSingleFreq, Coord3D_ABCY16, packets of 9000"));
  EXPECT_EQ(status.counters.frames_incomplete, 0);
}

TEST_F(CameraSourceTest, TakesDepthAndIntensityInTurnsWhereTheyComeApart) {
  play.depth_and_intensity_apart = true;
  serve();
  CameraSource source(settings, camera_program());
  ASSERT_TRUE(frames_come(source, 3)) << source.status().error;
  EXPECT_TRUE(last.taken_in_turns);
  EXPECT_NEAR(last.depth[0] * last.scale->scale_m[2], kRange_m, 1e-3);
  EXPECT_EQ(bad_pixels, 0);
  EXPECT_EQ(source.status().counters.frames_wrong_size, 0);
}

TEST_F(CameraSourceTest, AGreyCamerasSixteenBitsComeThroughAndOfMono8TheUpperEight) {
  play.grey = true;
  for (sim::SequenceFrame& frame : sequence.frames) std::fill(frame.intensity.begin(), frame.intensity.end(), 0x1234);
  serve();
  for (const auto& [format, value] : {std::pair{CameraFormat::kMono16, 0x1234}, {CameraFormat::kMono8, 0x1212}}) {
    settings.format = format;
    CameraSource source(settings, camera_program());
    ASSERT_TRUE(frames_come(source, 2)) << source.status().error;
    EXPECT_THAT(last.intensity, Each(value));
    EXPECT_EQ(source.status().counters.frames_wrong_size, 0);
  }
}

TEST_F(CameraSourceTest, FindsACameraByItsSerialNumberOrSaysWhichThereAre) {
  serve();
  settings.address.clear();
  settings.serial = "1234";
  {
    CameraSource other(settings, camera_program());
    EXPECT_TRUE(wait_for_error(other, "no camera with serial number 1234 answers; these do: " + play.serial));
    EXPECT_EQ(other.status().state, CameraState::kGone);
  }
  settings.serial = play.serial;
  CameraSource source(settings, camera_program());
  EXPECT_TRUE(frames_come(source, 2)) << source.status().error;
}

TEST_F(CameraSourceTest, SaysWhatIsWrongWithACameraThatIsNotAsConfigured) {
  serve();
  const auto error_of = [&](const CameraSettings& wrong, const std::string& words) {
    CameraSource source(wrong, camera_program());
    const bool came = wait_for_error(source, words);
    EXPECT_TRUE(came) << source.status().error;
    EXPECT_EQ(source.status().state, CameraState::kWrong);
  };
  CameraSettings wrong = settings;
  wrong.mode = "Distance9999mm";
  error_of(wrong, "does not take mode \"Distance9999mm\"; it knows Distance1250mmSingleFreq, ");
  wrong = settings;
  wrong.serial = "77";
  error_of(wrong, "has serial number " + play.serial + ", not 77");
  wrong = settings;
  wrong.width_px = 640;
  error_of(wrong, "gives 64 x 48 pixels, its camera file is for 640 x 48");
}

TEST_F(CameraSourceTest, WaitsForACameraThatAnotherProgramHolds) {
  serve();
  std::optional<CameraSource> other(std::in_place, settings, camera_program());
  ASSERT_TRUE(frames_come(*other, 1));
  taken = 0;
  CameraSource source(settings, camera_program());
  ASSERT_TRUE(wait_for_error(source, "another program controls the camera"));
  EXPECT_EQ(source.status().state, CameraState::kTaken);
  EXPECT_EQ(taken, 0);
  other.reset();
  EXPECT_TRUE(frames_come(source, 2)) << source.status().error;
}

TEST_F(CameraSourceTest, ComesBackWithTheCameraInANewSession) {
  serve();
  CameraSource source(settings, camera_program());
  ASSERT_TRUE(frames_come(source, 2));
  const std::uint32_t session = last.session;
  camera.reset();
  ASSERT_TRUE(run(source, [&] { return source.status().state != CameraState::kOpen; }));
  serve();
  ASSERT_TRUE(frames_come(source, 2)) << source.status().error;
  EXPECT_EQ(last.session, session + 1);
  EXPECT_EQ(bad_pixels, 0);
  const FrameSourceCounters counters = source.status().counters;
  EXPECT_EQ(counters.camera_lost + counters.camera_silences, 1);
}

TEST_F(CameraSourceTest, OpensASilentCameraAnew) {
  play.stalls.push_back({0.0, 1e6});
  serve();
  CameraSource source(settings, camera_program());
  EXPECT_TRUE(run(source, [&] { return source.status().counters.camera_opened >= 3; }));
  EXPECT_GE(source.status().counters.camera_silences, 2);
  EXPECT_EQ(source.status().counters.camera_lost, 0);
  EXPECT_EQ(taken, 0);
}

// Two packets of a hundred are lost, and resends are requested successfully: received frames are correct.
TEST_F(CameraSourceTest, CountsFramesWithLostPacketsAndGivesTheOthersUnharmed) {
  play.loss = 0.02;
  play.frame_rate_hz = 100.0;
  serve();
  settings.packet_size = 1400;
  CameraSource source(settings, camera_program());
  ASSERT_TRUE(run(source, [&] { return taken >= 30 && source.status().counters.frames_incomplete >= 5; }));
  EXPECT_EQ(bad_pixels, 0);
}

// The camera's clock is set while frames come, when it becomes a slave: that is no other sender.
TEST_F(CameraSourceTest, FollowsPtpByTheNamesThatTheCameraKnows) {
  play.ptp = true;
  for (const sim::PtpNames names : {sim::PtpNames::kNew, sim::PtpNames::kOld}) {
    play.ptp_names = names;
    play.ptp_masterless = {{0.0, 2.0}};
    last = {};
    serve();
    CameraSource source(settings, camera_program());
    ASSERT_TRUE(run(source, [&] { return source.status().ptp_state == PtpState::kListening; }));
    EXPECT_FALSE(source.status().ptp_fault);
    ASSERT_TRUE(run(source, [&] { return last.clock == CameraClock::kPtp; })) << source.status().identity;
    EXPECT_NEAR(static_cast<double>(last.camera_ns), static_cast<double>(last.arrival_utc_ns), 1e9);
    EXPECT_THAT(source.status().identity, HasSubstr(", PTP slave"));
    EXPECT_EQ(source.status().counters.camera_opened, 1);
    EXPECT_EQ(source.status().counters.camera_contested, 0);
    EXPECT_LE(source.status().counters.frames_wrong_time, 3);
    camera.reset();
  }
}

TEST_F(CameraSourceTest, ACameraThatLosesItsPtpMasterIsToldAndComesBack) {
  play.ptp = true;
  play.ptp_masterless = {{3.0, 3.0}};
  serve();
  CameraSource source(settings, camera_program());
  ASSERT_TRUE(run(source, [&] { return last.clock == CameraClock::kPtp; }));
  ASSERT_TRUE(run(source, [&] { return last.clock == CameraClock::kOwn; }));
  EXPECT_EQ(source.status().ptp_state, PtpState::kListening);
  EXPECT_TRUE(source.status().ptp_fault);
  EXPECT_EQ(source.status().counters.ptp_losses, 1);
  ASSERT_TRUE(run(source, [&] { return last.clock == CameraClock::kPtp; }));
  EXPECT_FALSE(source.status().ptp_fault);
  EXPECT_EQ(source.status().counters.camera_opened, 1);
}

TEST_F(CameraSourceTest, ACameraThatRefusesPtpOrHasNoneIsUsedByItsOwnClock) {
  play.ptp = true;
  for (const sim::PtpNames names : {sim::PtpNames::kNew, sim::PtpNames::kOld, sim::PtpNames::kNone}) {
    play.ptp_names = names;
    play.ptp_refused = true;
    const bool none = names == sim::PtpNames::kNone;
    serve();
    CameraSource source(settings, camera_program());
    ASSERT_TRUE(frames_come(source, 3)) << source.status().error;
    EXPECT_EQ(source.status().ptp_state, none ? PtpState::kAbsent : PtpState::kRefused);
    EXPECT_EQ(source.status().ptp_fault, !none);
    EXPECT_THAT(source.status().identity, HasSubstr(none ? ", PTP not offered" : ", PTP refused"));
    EXPECT_EQ(source.status().counters.ptp_refusals, none ? 0 : 1);
    EXPECT_EQ(last.clock, CameraClock::kOwn);
    camera.reset();
  }
}

TEST_F(CameraSourceTest, PtpThatIsNotAskedForIsNotSetAndNotTold) {
  play.ptp = true;
  settings.ptp = false;
  serve();
  CameraSource source(settings, camera_program());
  ASSERT_TRUE(frames_come(source, 40));  // a state is asked for once a second
  EXPECT_EQ(last.clock, CameraClock::kOwn);
  EXPECT_EQ(source.status().ptp, "");
}

}  // namespace
}  // namespace pharos::host
