// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/tof_pipeline.hpp"

#include <gtest/gtest.h>

#include "pharos/pose_t.hpp"
#include "unit/host/daemon/manual_clock.hpp"
#include "unit/host/publish/message_list.hpp"

namespace pharos::host {
namespace {

constexpr std::int64_t kFramePeriod_ns = 33'333'333;

TofConfig camera_config() {
  TofConfig config;
  config.name = "helios";
  config.target = "client";
  config.camera.intrinsics.width_px = 4;
  config.camera.intrinsics.height_px = 2;
  return config;
}

TofResult good_answer() {
  TofResult answer;
  answer.estimate.pose.t = Vector3(0.1, 0.2, 4.0);
  answer.estimate.covariance = Matrix6::Identity() * 1e-6;
  answer.observations = 321;
  return answer;
}

/// A pipeline with a scripted estimator, and a camera with its own clock whose frames are taken now.
class TofPipelineTest : public ::testing::Test {
 protected:
  TofPipelineTest() { make(camera_config()); }

  void make(const TofConfig& config) { pipeline.emplace(config, PublishConfig{}, "tof/helios", publisher, clock); }
  void take(const DepthFrame& frame) {
    const auto time = pipeline->take(frame);
    if (!time) return;
    measured.push_back(frame.camera_ns);
    clock.advance(busy_ns);
    pipeline->done({{std::make_unique<DepthFrame>(frame), *time}, next_answer, 0, busy_ns});
  }
  DepthFrame frame_now(CameraClock camera_clock = CameraClock::kHost) {
    clock.advance(kFramePeriod_ns);
    DepthFrame frame;
    frame.resize(4, 2);
    frame.session = 1;
    frame.clock = camera_clock;
    frame.arrival_utc_ns = clock.utc_ns();
    frame.arrival_monotonic_ns = frame.complete_monotonic_ns = clock.monotonic_ns();
    frame.camera_ns = frame.arrival_utc_ns;
    return frame;
  }
  std::vector<pose_t> poses() const { return sink.all<pose_t>("PHAROS_TOF_POSE"); }
  std::int64_t counter(const std::string& name, const FrameSourceStatus& camera = open_camera()) {
    for (const NamedCount& count : pipeline->health("dev", camera, clock.monotonic_ns()).counters) {
      if (count.name == name) return count.value;
    }
    return -1;
  }
  static FrameSourceStatus open_camera() {
    FrameSourceStatus status;
    status.state = CameraState::kOpen;
    status.identity = "Helios 1";
    return status;
  }

  MessageList sink;
  Publisher publisher{sink, "PHAROS_"};
  test::ManualClock clock;
  TofResult next_answer = good_answer();
  std::vector<std::int64_t> measured;
  std::int64_t busy_ns = 0;  // of the estimator
  std::optional<TofPipeline> pipeline;
};

TEST_F(TofPipelineTest, PublishesAPoseForAFrame) {
  const DepthFrame frame = frame_now();
  take(frame);
  ASSERT_EQ(poses().size(), 1u);
  const pose_t pose = poses()[0];
  EXPECT_EQ(pose.source, "tof/helios");
  EXPECT_EQ(pose.station_or_camera, "helios");
  EXPECT_EQ(pose.target, "client");
  EXPECT_EQ(pose.parent_frame, "camera");
  EXPECT_EQ(pose.child_frame, "target");
  EXPECT_EQ(pose.status, "ok");
  EXPECT_TRUE(pose.valid);
  EXPECT_EQ(pose.utime, frame.camera_ns / 1000);
  EXPECT_EQ(pose.latency_us, 0);
  EXPECT_EQ(pose.observations, 321);
  EXPECT_EQ(pose.position_m[2], 4.0);
  EXPECT_EQ(pose.residual_rms_rad, 0.0);
  EXPECT_EQ(pose.covariance[7], 1e-6);
}

TEST_F(TofPipelineTest, ReportsRefusedFramesWithTheirReason) {
  next_answer = {};
  next_answer.refusal = "no_ring_plane";
  next_answer.advice = "look at a ring";
  take(frame_now());
  ASSERT_EQ(poses().size(), 1u);
  EXPECT_EQ(poses()[0].status, "refused_no_ring_plane");
  EXPECT_FALSE(poses()[0].valid);
  EXPECT_EQ(poses()[0].orientation_wxyz[0], 0.0) << "no rotation";
  EXPECT_EQ(counter("frames_refused"), 1);
  EXPECT_EQ(counter("refused.no_ring_plane"), 1);
  const SourceHealth health = pipeline->health("dev", open_camera(), clock.monotonic_ns());
  EXPECT_EQ(health.state, SourceState::kWaiting);
  EXPECT_EQ(health.message, "no pose: no_ring_plane: look at a ring");
}

TEST_F(TofPipelineTest, ReportsTheTimeOfEachStageThatAFrameCameTo) {
  next_answer.stage_ns[static_cast<std::size_t>(tof::TofStage::kEdges)] = 2'000'000;
  for (int k = 0; k < 3; ++k) take(frame_now());
  EXPECT_EQ(counter("estimator.edges_max_us"), 2000);
  EXPECT_EQ(counter("estimator.edges_p50_us"), 2000);
  EXPECT_EQ(counter("estimator.face_max_us"), 0) << "no frame came to it";
}

TEST_F(TofPipelineTest, NeitherMeasuresNorSendsWhatIsStale) {
  DepthFrame frame = frame_now();
  const std::int64_t second = 1'000'000'000;
  frame.camera_ns -= second;
  frame.arrival_monotonic_ns -= second;
  take(frame);
  EXPECT_TRUE(poses().empty());
  EXPECT_TRUE(measured.empty());
  EXPECT_EQ(counter("frames_stale"), 1);
}

// A result that took too long is stale, even if its frame was fresh on arrival.
TEST_F(TofPipelineTest, SendsNothingThatBecameStaleWhileItWasMeasured) {
  constexpr std::int64_t kMillisecond_ns = 1'000'000;
  for (const std::int64_t work_ms : {150, 250}) {
    busy_ns = work_ms * kMillisecond_ns;
    take(frame_now());
  }
  ASSERT_EQ(poses().size(), 1u);
  EXPECT_EQ(poses()[0].latency_us, 150'000);
  EXPECT_EQ(measured.size(), 2u);
  EXPECT_EQ(counter("frames_ok"), 1);
  EXPECT_EQ(counter("frames_stale"), 1);
}

TEST_F(TofPipelineTest, CountsFramesWhoseTimeStandsOrGoesBack) {
  DepthFrame frame = frame_now();
  take(frame);
  take(frame);
  frame.camera_ns -= kFramePeriod_ns;
  take(frame);
  EXPECT_EQ(poses().size(), 1u);
  EXPECT_EQ(counter("frames_time_back"), 2);
}

TEST_F(TofPipelineTest, CountsFramesOfAnotherSize) {
  DepthFrame frame = frame_now();
  frame.resize(2, 2);
  take(frame);
  EXPECT_TRUE(poses().empty());
  EXPECT_EQ(counter("frames_wrong_size"), 1);
}

// No frame is lost without being counted: the pipeline's counters add up to the number of frames that it was given.
TEST_F(TofPipelineTest, CountsEveryFrameOfACameraWithAClockOfItsOwn) {
  constexpr int kFrames = 40;
  for (int i = 0; i < kFrames; ++i) {
    DepthFrame frame = frame_now(CameraClock::kOwn);
    frame.camera_ns = i == 30 ? 5 : 1'000'000'000'000 + i * kFramePeriod_ns;
    take(frame);
  }
  const TofCounters& counters = pipeline->counters();
  EXPECT_EQ(counters.frames_time_back, 1);
  EXPECT_GT(counters.frames_no_clock, 0);
  EXPECT_GT(counters.frames_ok, 0);
  std::int64_t sum = 0;
  for_each_counter(counters, [&](const char*, std::int64_t value) { sum += value; });
  EXPECT_EQ(sum, kFrames);
}

TEST_F(TofPipelineTest, NeverSendsWhatIsNotFinite) {
  next_answer.estimate.covariance(3, 3) = std::numeric_limits<double>::quiet_NaN();
  take(frame_now());
  EXPECT_TRUE(poses().empty());
  EXPECT_EQ(counter("frames_not_finite"), 1);
}

TEST_F(TofPipelineTest, SaysAmbiguousAndBothPoses) {
  next_answer.estimate.second = {next_answer.estimate.pose, 0.0};
  take(frame_now());
  ASSERT_EQ(poses().size(), 1u);
  EXPECT_EQ(poses()[0].status, "ambiguous");
  EXPECT_TRUE(poses()[0].has_second);
  EXPECT_EQ(counter("frames_ambiguous"), 1);
}

TEST_F(TofPipelineTest, RefusesAPoseThatTheLastOnesCannotHaveComeTo) {
  for (int i = 0; i < 5; ++i) take(frame_now());
  next_answer.estimate.pose.t.x() += 0.398;
  take(frame_now());
  next_answer = good_answer();
  take(frame_now());
  ASSERT_EQ(poses().size(), 7u);
  EXPECT_EQ(poses()[5].status, "refused_jump");
  EXPECT_FALSE(poses()[5].valid);
  EXPECT_EQ(poses()[6].status, "ok");
  EXPECT_EQ(counter("refused.jump"), 1);
}

TEST_F(TofPipelineTest, RecordedFramesMayShowDifferentViews) {
  TofConfig config = camera_config();
  config.frames = "recorded";
  make(config);
  for (int i = 0; i < 5; ++i) {
    next_answer.estimate.pose.t.x() = i;
    take(frame_now());
  }
  EXPECT_EQ(counter("frames_ok"), 5);
}

TEST_F(TofPipelineTest, SendsOneMeanForAWindowOfFrames) {
  TofConfig config = camera_config();
  config.average_frames = 5;
  make(config);
  for (int i = 0; i < 11; ++i) take(frame_now());
  ASSERT_EQ(poses().size(), 2u);
  EXPECT_EQ(poses()[0].sequence, 0);
  EXPECT_EQ(poses()[1].sequence, 1);
  EXPECT_NEAR(poses()[0].covariance[0], 1e-6 / 5, 1e-12);
  EXPECT_EQ(poses()[0].observations, 5 * 321);
  EXPECT_EQ(counter("frames_ok"), 11);
}

TEST_F(TofPipelineTest, ReportsTheCamerasErrorBeforeItsOwn) {
  FrameSourceStatus camera = open_camera();
  camera.state = CameraState::kTaken;
  camera.error = "another program controls it";
  camera.counters.camera_lost = 3;
  const SourceHealth health = pipeline->health("camera 7", camera, clock.monotonic_ns());
  EXPECT_EQ(health.state, SourceState::kError);
  EXPECT_EQ(health.message, "another program controls it");
  EXPECT_EQ(health.device, "camera 7");
  EXPECT_EQ(health.identity, "Helios 1");
  EXPECT_EQ(counter("device.camera_lost", camera), 3);
}

TEST_F(TofPipelineTest, AFifthOfTheFramesLostIsDegradedAndMostPosesRefusedAnError) {
  FrameSourceStatus camera = open_camera();
  constexpr int kFrames = 400;
  const auto play = [&](std::int64_t& lost, int of, int refused) {
    for (int i = 0; i < kFrames; ++i) {
      next_answer = good_answer();
      if (i % of < refused) next_answer.refusal = "no_ring_plane";
      take(frame_now());
      ++camera.counters.frames_received;
      lost += i % 4 == 0 ? 1 : 0;
      pipeline->state_changed(camera, clock.monotonic_ns());
    }
    return pipeline->health("dev", camera, clock.monotonic_ns());
  };
  const SourceHealth degraded = play(camera.counters.frames_missing, 10, 0);
  EXPECT_EQ(degraded.state, SourceState::kDegraded);
  EXPECT_EQ(degraded.message.rfind("80 % of the expected frames came", 0), 0u) << degraded.message;
  std::int64_t none = 0;
  const SourceHealth error = play(none, 10, 6);
  EXPECT_EQ(error.state, SourceState::kError);
  EXPECT_EQ(error.message.rfind("40 % of the expected poses came", 0), 0u) << error.message;
}

TEST_F(TofPipelineTest, IsNotOkHalfASecondAfterTheLastFrame) {
  for (int i = 0; i < 30; ++i) take(frame_now());
  EXPECT_TRUE(pipeline->state_changed(open_camera(), clock.monotonic_ns())) << "found";
  EXPECT_EQ(pipeline->health("dev", open_camera(), clock.monotonic_ns()).state, SourceState::kOk);
  clock.advance(400'000'000);
  EXPECT_TRUE(pipeline->state_changed(open_camera(), clock.monotonic_ns())) << "lost";
  const SourceHealth health = pipeline->health("dev", open_camera(), clock.monotonic_ns());
  EXPECT_EQ(health.state, SourceState::kStale);
  EXPECT_EQ(health.message, "no frame comes any more");
}

TEST(CameraOfFrame, TheCamerasOwnScaleGoesBeforeTheFiles) {
  DepthCamera by_file;
  by_file.depth_scale_m = 0.00025;
  by_file.depth_origin_z_m = 0.02;
  DepthFrame frame;
  EXPECT_EQ(camera_of(frame, by_file).depth_scale_m, 0.00025);
  frame.scale = CoordinateScale{{1e-3, 1e-3, 1e-4}, {-3.0, -3.0, 0.5}};
  const DepthCamera camera = camera_of(frame, by_file);
  EXPECT_NEAR(depth_z_m(camera, 10'000), 1.0 + 0.5 + 0.02, 1e-12);
}

}  // namespace
}  // namespace pharos::host
