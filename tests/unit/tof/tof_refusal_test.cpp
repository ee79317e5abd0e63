// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "pharos/tof/tof_pose.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

using test::facing;
using test::render;
using test::SyntheticFrame;
using test::SyntheticRing;

class TofRefusal : public testing::Test {
 protected:
  std::string outcome(const SyntheticFrame& frame) const { return outcome(frame.view()); }
  std::string outcome(const TofFrame& frame) const {
    const auto pose = measure_tof_pose(frame, camera_, TofSettings{}, *workspace_);
    return pose.ok() ? "a pose" : name_of(pose.error());
  }
  SyntheticFrame good() const { return render(SyntheticRing{}, pose_, camera_); }

  DepthCamera camera_ = test::small_camera();
  CameraFromTarget pose_ = facing({0.05, 0.0, 2.3}, {0.2, 0.1, 0.4});
  std::unique_ptr<TofWorkspace> workspace_ = std::make_unique<TofWorkspace>();
};

TEST_F(TofRefusal, ImagesOfUnlikeSize) {
  const SyntheticFrame frame = good();
  TofFrame view = frame.view();
  view.depth.height_px -= 1;
  EXPECT_EQ(outcome(view), "frame_size");
  EXPECT_EQ(outcome(TofFrame{}), "frame_size");
  view = frame.view();
  view.depth.width_px = view.intensity.width_px = kMaxWidth_px + 1;
  EXPECT_EQ(outcome(view), "frame_size");
}

TEST_F(TofRefusal, CameraFileOfAnotherResolution) {
  const SyntheticFrame frame = good();
  camera_.intrinsics.width_px = 640;
  EXPECT_EQ(outcome(frame), "camera_size");
}

TEST_F(TofRefusal, CameraThatCannotBe) {
  const SyntheticFrame frame = good();
  camera_.intrinsics.distortion = {-3.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(outcome(frame), "camera_unusable");
  camera_ = test::small_camera();
  camera_.depth_scale_m = 0.0;
  EXPECT_EQ(outcome(frame), "camera_unusable");
}

TEST_F(TofRefusal, AllPixelsInvalid) {
  SyntheticFrame frame = good();
  std::fill(frame.depth.begin(), frame.depth.end(), kNoDepthLow);
  EXPECT_EQ(outcome(frame), "no_depth");
  std::fill(frame.depth.begin(), frame.depth.end(), kNoDepthHigh);
  EXPECT_EQ(outcome(frame), "no_depth");
}

TEST_F(TofRefusal, AllPixelsSaturated) {
  SyntheticFrame frame = good();
  std::fill(frame.depth.begin(), frame.depth.end(), kNoDepthLow);
  std::fill(frame.intensity.begin(), frame.intensity.end(), std::uint16_t{65535});
  EXPECT_EQ(outcome(frame), "saturated");
}

TEST_F(TofRefusal, HalfTheRowsStale) {
  const SyntheticFrame first = test::with_noise(good(), 10.0, 30.0, 1);
  SyntheticFrame second = test::with_noise(good(), 10.0, 30.0, 2);
  EXPECT_EQ(outcome(first), "a pose");
  const auto half = static_cast<std::ptrdiff_t>(first.depth.size() / 2);
  std::copy(first.depth.begin() + half, first.depth.end(), second.depth.begin() + half);
  std::copy(first.intensity.begin() + half, first.intensity.end(), second.intensity.begin() + half);
  EXPECT_EQ(outcome(second), "stale_rows");
  EXPECT_EQ(outcome(test::with_noise(good(), 10.0, 30.0, 3)), "a pose");
}

TEST_F(TofRefusal, AFrameThatRepeatsAsAWholeIsOldButTrue) {
  const SyntheticFrame frame = good();
  EXPECT_EQ(outcome(frame), "a pose");
  EXPECT_EQ(outcome(frame), "a pose");
}

TEST_F(TofRefusal, NothingRoundInTheImage) {
  SyntheticRing scene;
  scene.ring_grey = scene.wall_grey;
  scene.wall_z_m = 0.0;
  scene.plates.clear();
  EXPECT_EQ(outcome(render(scene, pose_, camera_)), "no_ellipses");
}

TEST_F(TofRefusal, CirclesPaintedOnAWall) {
  SyntheticRing scene;
  scene.wall_z_m = 0.0;
  EXPECT_EQ(outcome(render(scene, pose_, camera_)), "no_step");
  EXPECT_EQ(outcome(test::with_noise(render(scene, pose_, camera_), 15.0, 50.0, 1)), "no_step");
}

TEST_F(TofRefusal, ARingOfANozzlesSize) {
  SyntheticRing scene;
  scene.outer_radius_m = 0.2;
  scene.inner_radius_m = 0.17;
  EXPECT_EQ(outcome(render(scene, facing({0.0, 0.0, 1.5}, {0.1, 0.0, 0.0}), camera_)), "ring_size");
}

// The simulated satellite with its ring taken off: body, foil, connectors and a nozzle that stands out of the face.
TEST_F(TofRefusal, ARingThatLeavesTheImage) {
  const std::string why = outcome(render(SyntheticRing{}, facing({0.72, 0.0, 2.3}, {0.1, 0.1, 0.0}), camera_));
  EXPECT_EQ(why, "ring_leaves_image");
}

TEST_F(TofRefusal, DepthThatWraps) {
  // Everything beyond 2.2 m begins again at 0: parts of the tilted ring lie on two planes.
  SyntheticFrame frame = good();
  for (std::uint16_t& counts : frame.depth) counts = static_cast<std::uint16_t>(counts % 8800);
  EXPECT_NE(outcome(frame), "a pose");
  // The whole ring wraps: its plane is far too near for circles of that size.
  frame = good();
  for (std::uint16_t& counts : frame.depth) counts = static_cast<std::uint16_t>(counts % 6000);
  EXPECT_EQ(outcome(frame), "ring_size");
}

TEST_F(TofRefusal, EveryFailureHasItsWords) {
  for (int k = 0; k <= static_cast<int>(TofFailure::kRingInconsistent); ++k) {
    const auto failure = static_cast<TofFailure>(k);
    EXPECT_NE(std::string(name_of(failure)), "");
    EXPECT_NE(std::string(stage_of(failure)), "");
    EXPECT_NE(std::string(describe(failure)), "");
  }
}

}  // namespace
}  // namespace pharos::tof
