// SPDX-License-Identifier: Apache-2.0
#include "host/frame_record/recorded_camera.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include "host/frame_record/frame_recorder.hpp"
#include "host/frame_record/recording_camera.hpp"
#include "host/record/recording_file.hpp"
#include "host/support/input_error.hpp"
#include "some_frames.hpp"
#include "support/temporary_folder.hpp"
#include "unit/host/daemon/manual_clock.hpp"

namespace pharos::host {
namespace {

using test::some_frame;

// Frames `first`, first + 2, ... below `end` as a camera gives them.
class SomeCamera final : public FrameSource {
 public:
  SomeCamera(int first, int end) : next_(first), end_(end) {}
  int fd() const override { return -1; }
  DepthFramePtr take() override {
    if (next_ >= end_) return nullptr;
    auto frame = std::make_unique<DepthFrame>(some_frame(next_));
    next_ += 2;
    return frame;
  }
  void recycle(DepthFramePtr) override {}
  FrameSourceStatus status() const override { return {}; }
  std::string device() const override { return "some camera"; }

 private:
  int next_, end_;
};

class RecordedCameras : public ::testing::Test {
 protected:
  void record(const std::string& name, int first, int end) {
    FrameRecorderOptions options;
    options.directory = folder_.path();
    options.camera = name;
    RecordingCamera camera(std::make_unique<SomeCamera>(first, end), options);
    while (const DepthFramePtr frame = camera.take()) {
      while (camera.status().recording->frames * 2 + first < static_cast<int>(frame->intensity[0]) / 1000) {
      }
    }
    while (camera.status().recording->frames * 2 + first < end) {
    }
    EXPECT_EQ(camera.status().recording->frames_lost, 0);
    EXPECT_EQ(camera.storage_error(), "");
  }
  std::unique_ptr<RecordedCamera> camera(const std::string& name) {
    return std::make_unique<RecordedCamera>(recording_files(folder_.path(), name, kFramesSuffix), settings_, timeline_,
                                            speed_);
  }
  CameraSettings settings_ = [] {
    CameraSettings settings;
    settings.width_px = 6;
    settings.height_px = 4;
    return settings;
  }();
  pharos::test::TemporaryFolder folder_;
  test::ManualClock clock_;
  ReplaySpeed speed_ = ReplaySpeed::kFastest;
  std::shared_ptr<ReplayTimeline> timeline_ = std::make_shared<ReplayTimeline>(clock_, speed_);
};

TEST_F(RecordedCameras, KeepStepAtFullSpeed) {
  record("a", 0, 20);
  record("b", 1, 20);
  auto a = camera("a"), b = camera("b");
  std::vector<int> played;
  while (!a->status().finished || !b->status().finished) {
    for (RecordedCamera* camera : {b.get(), a.get()}) {
      DepthFramePtr frame = camera->take();
      if (!frame) continue;
      const int k = frame->intensity[0] / 1000;
      EXPECT_TRUE(test::equal(*frame, some_frame(k)));
      EXPECT_EQ(timeline_->monotonic_ns(), frame->complete_monotonic_ns) << "the recording computer's clock";
      EXPECT_EQ(timeline_->utc_ns(), frame->arrival_utc_ns + 7'000'000);
      played.push_back(k);
      camera->recycle(std::move(frame));
    }
  }
  ASSERT_EQ(played.size(), 20u);
  for (int k = 0; k < 20; ++k) EXPECT_EQ(played[static_cast<std::size_t>(k)], k);
}

TEST_F(RecordedCameras, AreDueAtTheirTimesAtRealSpeed) {
  record("a", 0, 6);
  speed_ = ReplaySpeed::kReal;
  timeline_ = std::make_shared<ReplayTimeline>(clock_, speed_);
  auto a = camera("a");
  const std::int64_t began_ns = clock_.monotonic_ns();
  std::vector<std::int64_t> due_ns;
  while (!a->status().finished) {
    if (DepthFramePtr frame = a->take()) {
      due_ns.push_back(clock_.monotonic_ns() - began_ns);
      EXPECT_GE(timeline_->monotonic_ns(), frame->complete_monotonic_ns) << "nothing comes before its time";
      a->recycle(std::move(frame));
    }
    pollfd timer{a->fd(), POLLIN, 0};
    if (::poll(&timer, 1, 0) == 0) clock_.advance(1'000'000);
  }
  ASSERT_EQ(due_ns.size(), 3u);
  for (std::size_t k = 1; k < due_ns.size(); ++k) {
    EXPECT_GE(due_ns[k] - due_ns[0], static_cast<std::int64_t>(k) * 2 * test::kFramePeriod_ns);
  }
}

TEST_F(RecordedCameras, OfAnotherSizeOrKindAreRefused) {
  record("a", 0, 4);
  settings_.width_px = 8;
  EXPECT_THROW(camera("a"), InputError);
  settings_.width_px = 6;
  settings_.format = CameraFormat::kMono16;
  EXPECT_THROW(camera("a"), InputError);
}

TEST_F(RecordedCameras, AFileOfTheSeriesThatCannotBeReadIsToldAndPassedOver) {
  record("a", 0, 4);
  folder_.write("a_20251121T103001Z.phcam", "not a recording");
  auto a = camera("a");
  int frames = 0;
  while (!a->status().finished) {
    DepthFramePtr frame = a->take();
    if (!frame) continue;
    ++frames;
    a->recycle(std::move(frame));
  }
  EXPECT_EQ(frames, 2);
  EXPECT_EQ(a->status().recording->failures, 1);
  EXPECT_NE(a->status().remark.find("is no recording"), std::string::npos);
}

TEST(ReplayTimeline, CutsASilenceOfAllAndOfAllAlone) {
  constexpr std::int64_t kS = 1'000'000'000;
  test::ManualClock clock;
  ReplayTimeline timeline(clock, ReplaySpeed::kReal);
  const auto a = timeline.add(5 * kS), b = timeline.add(6 * kS);
  EXPECT_EQ(timeline.wait_ns(a), 0);
  EXPECT_EQ(timeline.wait_ns(b), kS);
  timeline.set_next(a, 1000 * kS);
  EXPECT_EQ(timeline.wait_ns(a), 995 * kS) << "b goes on meanwhile";
  timeline.set_next(b, 900 * kS);
  EXPECT_EQ(timeline.wait_ns(b), 895 * kS - 885 * kS);
  EXPECT_EQ(timeline.wait_ns(a), 110 * kS) << "in step";
  EXPECT_EQ(timeline.silences_cut(), 1);
  timeline.end(b);
  timeline.wait_ns(a);
  EXPECT_EQ(timeline.silences_cut(), 2) << "what has ended holds nothing up";
}

}  // namespace
}  // namespace pharos::host
