// SPDX-License-Identifier: Apache-2.0
// Recorded pairs in pharosd's event loop: simulated images of docking ring and nozzle with known truth.
#include "host/daemon/stereo/stereo_feed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>

#include "host/frame_record/frame_recorder.hpp"
#include "host/images/picture.hpp"
#include "host/record/recording_file.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/ring2/ring2_pose.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "support/painted_ring_pair.hpp"
#include "unit/host/daemon/source_bench.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

constexpr double kDeg = 0.017453292519943295;

class StereoFeedTest : public ::testing::Test {
 protected:
  StereoFeedTest() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() / ("pharos_stereo_" + std::to_string(::getpid()) + test->name());
    fs::create_directories(folder);
    config.name = "bow";
    config.target = "client";
    config.rig = painted.file();
    config.frames = folder;
    config.ring2 = true;
    for (CameraSettings& device : config.devices) {
      device.width_px = 640;
      device.height_px = 512;
    }
  }
  ~StereoFeedTest() override { fs::remove_all(folder); }

  void write(const std::string& name, const sim::RingAndNozzle& target) {
    for (std::size_t side = 0; side < 2; ++side) {
      const GreyImage image = painted.image(target, side, 7 + side);
      write_grey_png((folder / (name + (side == 0 ? "_left.png" : "_right.png"))).string(), image.view(), 8);
    }
  }
  void play() {
    feed.emplace(bench.context, config);
    bench.run_until(*feed, [this] { return bench.finished; });
    EXPECT_TRUE(feed->finished());
  }
  std::vector<pose_t> poses() const { return bench.sink.all<pose_t>("PHAROS_RING2_POSE"); }
  SourceHealth health() { return feed->health().at(0); }
  std::int64_t counter(const std::string& name) { return test::SourceBench::counter(*feed, name); }

  pharos::test::PaintedRig painted;
  fs::path folder;
  StereoConfig config;
  test::SourceBench bench;
  std::optional<StereoFeed> feed;
};

TEST_F(StereoFeedTest, ReportsTheRingsPoseOfEveryPairInOrder) {
  const std::vector<sim::RingAndNozzle> truths{pharos::test::ring_at({0.03, -0.02, 2.6}, 9.0 * kDeg, -11.0 * kDeg),
                                               pharos::test::ring_at({-0.05, 0.04, 2.8}, -7.0 * kDeg, 14.0 * kDeg)};
  for (std::size_t k = 0; k < truths.size(); ++k) write("170000000" + std::to_string(k) + "000000000", truths[k]);
  play();
  ASSERT_EQ(poses().size(), truths.size());
  for (std::size_t k = 0; k < truths.size(); ++k) {
    const pose_t pose = poses()[k];
    EXPECT_EQ(pose.status, "ok");
    EXPECT_EQ(pose.source, "ring2/bow");
    EXPECT_EQ(pose.station_or_camera, "bow");
    EXPECT_EQ(pose.target, "client");
    EXPECT_EQ(pose.parent_frame, "rig");
    EXPECT_EQ(pose.child_frame, "target");
    EXPECT_EQ(pose.utime, 1'700'000'000'000'000 + static_cast<std::int64_t>(k) * 1'000'000) << "of the file's name";
    EXPECT_EQ(pose.flags, "no_connector");
    EXPECT_GT(pose.observations, 500);
    EXPECT_GT(pose.residual_rms_rad, 0.0);
    const Matrix3 R = Quaternion(pose.orientation_wxyz[0], pose.orientation_wxyz[1], pose.orientation_wxyz[2],
                                 pose.orientation_wxyz[3])
                          .toRotationMatrix();
    const Vector3 normal = R.col(2), error = Vector3(pose.position_m) - truths[k].ring_centre_m;
    EXPECT_LT(normal.cross(truths[k].normal).norm(), 0.1 * kDeg);
    EXPECT_LT(error.norm(), 0.003);
    const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> covariance(pose.covariance);
    const Matrix3 position = covariance.bottomRightCorner<3, 3>();
    EXPECT_LT(error.dot(position.inverse() * error), 40.0) << "as far as it says";
    EXPECT_NEAR(normal.dot(covariance.topLeftCorner<3, 3>() * normal), 9.8696 / 3.0, 1e-3) << "any turn";
    EXPECT_LT(normal.unitOrthogonal().dot(covariance.topLeftCorner<3, 3>() * normal.unitOrthogonal()), 1e-5);
  }
  EXPECT_EQ(counter("pairs_ok"), 2);
  EXPECT_EQ(counter("device.pairs_read"), 2);
  EXPECT_GT(counter("estimator_p50_us"), 0);
}

TEST_F(StereoFeedTest, CountsRefusalsByTheirReasonAndPassesOverWhatIsNoPair) {
  write("0001", pharos::test::ring_at({0.0, 0.0, 2.7}, 0.1, 0.1));
  for (const char* name : {"0002_left.png", "0003_right.png"}) {
    fs::copy_file(folder / "0001_left.png", folder / name);
  }
  const GreyImage dark{640, 512, 16, std::vector<std::uint16_t>(std::size_t{640} * 512, 100)};
  write_grey_png((folder / "0002_right.png").string(), dark.view(), 16);
  std::ofstream(folder / "0003_left.png") << "no image";
  play();
  ASSERT_EQ(poses().size(), 2u);
  EXPECT_EQ(poses()[1].status, "refused_right_black");
  EXPECT_EQ(poses()[1].orientation_wxyz[0], 0.0) << "no rotation";
  EXPECT_EQ(poses()[1].sequence, poses()[0].sequence + 1);
  EXPECT_EQ(counter("refused.right_black"), 1);
  EXPECT_EQ(counter("pairs_refused"), 1);
  EXPECT_EQ(counter("device.pairs_unreadable"), 1);
  EXPECT_EQ(health().state, SourceState::kStale) << "come to its end";
}

// The ring's circle is green in both pictures where the truth's points are, which the estimator did not draw.
TEST_F(StereoFeedTest, PicturesOfBothViewsShowTheRingWhereItIs) {
  bench.config.publish.previews = true;
  PreviewStage previews(bench.loop, bench.publisher, bench.config.publish, bench.clock);
  bench.context.previews = &previews;
  const sim::RingAndNozzle truth = pharos::test::ring_at({0.03, -0.02, 2.6}, 9.0 * kDeg, -11.0 * kDeg);
  write("0001", truth);
  play();
  const auto pictures = [this] { return bench.sink.all<preview_t>("PHAROS_PREVIEW"); };
  bench.run_until(*feed, [&] { return pictures().size() >= 2; });
  for (std::size_t side = 0; side < 2; ++side) {
    const preview_t message = pictures()[side];
    EXPECT_EQ(message.source, "ring2/bow");
    EXPECT_EQ(message.view, side == 0 ? "left" : "right");
    EXPECT_EQ(message.utime, poses()[0].utime);
    EXPECT_EQ(message.status, "ok");
    const Picture picture = decode_picture(message.data, "preview");
    ASSERT_EQ(picture.width_px, 640);
    ASSERT_EQ(picture.height_px, 512);
    const RigCamera& camera = side == 0 ? config.rig.left : config.rig.right;
    const Vector3 first = truth.normal.unitOrthogonal(), second = truth.normal.cross(first);
    int green = 0;
    for (int k = 0; k < 60; ++k) {
      const double angle = 6.0 * k * kDeg;
      const Vector3 point =
          truth.ring_centre_m + truth.ring_radius_m * (std::cos(angle) * first + std::sin(angle) * second);
      const auto pixel = project(camera.intrinsics, camera.pose().inverse() * point);
      ASSERT_TRUE(static_cast<bool>(pixel));
      bool near = false;
      for (int v = -2; v <= 2; ++v) {
        for (int u = -2; u <= 2; ++u) {
          const std::uint16_t* rgb = &picture.values[3 * (static_cast<std::size_t>(std::lround(pixel->y()) + v) * 640 +
                                                          static_cast<std::size_t>(std::lround(pixel->x()) + u))];
          near = near || (rgb[1] > rgb[0] + 60 * 257 && rgb[1] > rgb[2] + 15 * 257);  // not the contour, light blue
        }
      }
      green += near ? 1 : 0;
    }
    EXPECT_GE(green, 57) << "of 60";
  }
}

TEST_F(StereoFeedTest, RefusesADirectoryWithoutPairs) { EXPECT_THROW(StereoFeed(bench.context, config), InputError); }

/// Returns a result only after release().
class SlowEstimator : public PairEstimator {
 public:
  PairResult measure(const StereoPair& pair) override {
    std::unique_lock lock(mutex);
    changed.wait(lock, [this] { return let > 0; });
    --let;
    PairResult answer;
    answer.refusal = std::to_string(pair.offset_ns);
    return answer;
  }
  Ring2Pose no_pose() const override { return Ring2PoseEstimate{}; }
  void release(int count) {
    const std::lock_guard lock(mutex);
    let += count;
    changed.notify_all();
  }
  std::mutex mutex;
  std::condition_variable changed;
  int let = 0;
};

StereoPairPtr numbered(std::int64_t number) {
  auto pair = std::make_shared<StereoPair>();
  pair->offset_ns = number;
  return pair;
}

TEST(PairWorker, WorksOnOneAndKeepsTheNewestOfTheRest) {
  const auto slow = std::make_shared<SlowEstimator>();
  SlowEstimator& estimator = *slow;
  PairWorker worker = pair_worker(slow);
  EXPECT_TRUE(worker.idle());
  std::int64_t dropped = 0;
  for (std::int64_t k = 0; k < 50; ++k) {
    if (const auto discarded = worker.post(numbered(k))) {
      EXPECT_LT((*discarded)->offset_ns, k);
      ++dropped;
    }
  }
  EXPECT_GE(dropped, 48) << "one is worked on, one waits";
  EXPECT_FALSE(worker.idle());
  estimator.release(2);
  std::vector<std::string> answered;
  while (!worker.idle()) {
    while (auto done = worker.take()) answered.push_back(done->answer.refusal);
  }
  ASSERT_EQ(static_cast<std::int64_t>(answered.size()) + dropped, 50);
  EXPECT_EQ(answered.back(), "49");
  estimator.release(1);
}

/// Throws for the first two pairs.
class FaultyEstimator : public PairEstimator {
 public:
  PairResult measure(const StereoPair& pair) override {
    if (pair.offset_ns == 0) throw std::out_of_range("the seventh of six");
    if (pair.offset_ns == 1) throw 42;
    PairResult answer;
    answer.refusal = "no_ring";
    answer.pose = no_pose();
    return answer;
  }
  Ring2Pose no_pose() const override { return type; }

  Ring2Pose type;
};

TEST_F(StereoFeedTest, AnInternalErrorRefusesThatPairAndTheNextHasAPose) {
  PairWorker worker = pair_worker(std::make_shared<FaultyEstimator>());
  StereoPipeline pipeline(config, PublishConfig{}, "ring2/bow", bench.publisher, bench.clock);
  for (std::int64_t k = 0; k < 3; ++k) {
    StereoPairPtr pair = numbered(k);
    pair->time = {bench.clock.utc_ns(), bench.clock.monotonic_ns(), 0};
    worker.post(pair);
    while (!worker.idle()) {
      if (const auto done = worker.take()) pipeline.done(*done, false);
    }
    if (k == 0) {
      EXPECT_THAT(pipeline.health("", {}, bench.clock.monotonic_ns()).counters,
                  Contains(AllOf(Field(&NamedCount::name, "refused.internal_error"), Field(&NamedCount::value, 1))));
      PairSourceStatus open;
      open.state = CameraState::kOpen;
      pipeline.take(*pair);
      EXPECT_THAT(pipeline.health("", open, bench.clock.monotonic_ns()).message, HasSubstr("the seventh of six"));
    }
  }
  ASSERT_EQ(poses().size(), 3u);
  EXPECT_EQ(poses()[0].status, "refused_internal_error");
  EXPECT_EQ(poses()[1].status, "refused_internal_error");
  EXPECT_EQ(poses()[2].status, "refused_no_ring");
}

TEST_F(StereoFeedTest, AFaultOfSlamGoesOutOnSlamsChannel) {
  const auto faulty = std::make_shared<FaultyEstimator>();
  faulty->type = SlamPoseEstimate{};
  PairWorker worker = pair_worker(faulty);
  StereoPipeline pipeline(config, PublishConfig{}, "slam/bow", bench.publisher, bench.clock);
  StereoPairPtr pair = numbered(0);
  pair->time = {bench.clock.utc_ns(), bench.clock.monotonic_ns(), 0};
  worker.post(pair);
  while (!worker.idle()) {
    if (const auto done = worker.take()) pipeline.done(*done, false);
  }
  EXPECT_TRUE(poses().empty()) << "ring2 has nothing to do with it";
  const auto of_slam = bench.sink.all<pose_t>("PHAROS_SLAM_POSE");
  ASSERT_EQ(of_slam.size(), 1u);
  EXPECT_EQ(of_slam[0].status, "refused_internal_error");
  EXPECT_EQ(of_slam[0].parent_frame, "camera");
}

TEST(RingPose, TakesTiltCentreAndTheSecondSolutionIntoTheTargetsFrame) {
  ring2::Ring2Estimate circles;
  circles.normal = Vector3(0.1, -0.2, -1.0).normalized();
  circles.ring_centre_m = Vector3(0.1, 0.2, 3.0);
  circles.tilt_axes[0] = circles.normal.unitOrthogonal();
  circles.tilt_axes[1] = circles.normal.cross(circles.tilt_axes[0]);
  circles.covariance(0, 0) = 1e-6;
  circles.covariance(1, 1) = 4e-6;
  circles.covariance(2, 2) = 9e-6;
  circles.rms_px = 0.5;
  circles.second = {Vector3(0.0, 0.0, -1.0), Vector3(0.0, 0.0, 3.0), 2.0};
  const auto pose = ring2_pose(circles, 1000.0);
  EXPECT_LT((pose.pose.R.col(2) - circles.normal).norm(), 1e-12);
  EXPECT_NEAR(pose.pose.R.determinant(), 1.0, 1e-12);
  EXPECT_GT(pose.pose.R(0, 0), 0.9) << "X' near the rig's x";
  const Matrix3 rotation = pose.covariance.topLeftCorner<3, 3>();
  EXPECT_NEAR(circles.tilt_axes[0].dot(rotation * circles.tilt_axes[0]), 1e-6, 1e-12);
  EXPECT_NEAR(circles.tilt_axes[1].dot(rotation * circles.tilt_axes[1]), 4e-6, 1e-12);
  EXPECT_DOUBLE_EQ(pose.covariance(3, 3), 9e-6);
  EXPECT_DOUBLE_EQ(pose.residual_rms, 5e-4);
  ASSERT_TRUE(pose.ambiguous());
  EXPECT_EQ(pose.second->pose.R, Matrix3(Vector3(1.0, -1.0, -1.0).asDiagonal())) << "facing: no angle at all";
}

// Both cameras as [recording] writes them, each with a clock of its own, the right one's frames 4 ms later complete.
void record_cameras(const fs::path& folder, const pharos::test::PaintedRig& painted, int pairs) {
  constexpr std::int64_t kUtc_ns = 1'700'000'000'000'000'000, kPeriod_ns = 100'000'000, kTransport_ns = 9'000'000;
  for (std::size_t side = 0; side < 2; ++side) {
    const GreyImage image = painted.image(pharos::test::ring_at({0.03, -0.02, 2.6}, 9.0 * kDeg, -11.0 * kDeg), side, 7);
    FrameRecorderOptions options;
    options.directory = folder;
    options.camera = side_name("bow", side);
    FrameRecorder recorder(options);
    for (int k = 0; k < pairs; ++k) {
      DepthFrame frame;
      frame.width_px = image.width_px;
      frame.height_px = image.height_px;
      frame.intensity = image.pixels;
      frame.session = 1;
      frame.camera_ns = static_cast<std::int64_t>(side + 1) * 77'000'000'000 + k * kPeriod_ns;
      frame.arrival_utc_ns = kUtc_ns + k * kPeriod_ns;
      frame.arrival_monotonic_ns = 500'000'000'000 + k * kPeriod_ns;
      frame.complete_monotonic_ns =
          frame.arrival_monotonic_ns + kTransport_ns + static_cast<std::int64_t>(side) * 4'000'000;
      recorder.append(frame);
      while (recorder.counters().frames <= k) ::usleep(100);
    }
  }
}

TEST_F(StereoFeedTest, CamerasAreReplayedAsTheyWereRecorded) {
  constexpr int kPairs = 12;
  record_cameras(folder, painted, kPairs);
  config.replays_camera = true;
  play();
  const std::vector<pose_t> first = poses();
  EXPECT_EQ(counter("device.pairs") + counter("device.frames_no_clock") / 2, kPairs)
      << "as with the cameras themselves";
  EXPECT_EQ(counter("device.pairs"), static_cast<std::int64_t>(first.size())) << "at full speed none is left out";
  EXPECT_EQ(counter("left.recording.frames"), kPairs);
  EXPECT_EQ(counter("left.recording.frames_lost"), 0);
  ASSERT_GE(first.size(), 10u);
  for (const pose_t& pose : first) EXPECT_EQ(pose.status, "ok");
  EXPECT_NEAR(static_cast<double>(first.back().utime - first.front().utime),
              1e5 * static_cast<double>(first.size() - 1), 1e3)
      << "the recorded times";
  test::SourceBench again;
  feed.emplace(again.context, config);
  again.run_until(*feed, [&] { return again.finished; });
  const std::vector<pose_t> second = again.sink.all<pose_t>("PHAROS_RING2_POSE");
  ASSERT_EQ(second.size(), first.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(second[k].utime, first[k].utime);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(second[k].position_m[i], first[k].position_m[i]) << "bit by bit";
    for (int i = 0; i < 4; ++i) EXPECT_EQ(second[k].orientation_wxyz[i], first[k].orientation_wxyz[i]);
  }
  feed.reset();  // before the bench that it ran in
}

}  // namespace
}  // namespace pharos::host
