// SPDX-License-Identifier: Apache-2.0
// Recorded pairs of a tumbling satellite in pharosd's event loop: what the pictures for people show.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "host/daemon/preview_stage.hpp"
#include "host/daemon/stereo/stereo_feed.hpp"
#include "host/images/picture.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "support/temporary_folder.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"
#include "unit/host/daemon/source_bench.hpp"

namespace pharos::host {
namespace {

constexpr std::int32_t kWidth_px = 480, kHeight_px = 360;

/// Whether anything within 3 px of a pixel is brighter than the sky.
class LitPlaces {
 public:
  explicit LitPlaces(const GreyImage& image) : image_(image) {}
  bool near(std::int32_t u_px, std::int32_t v_px) const {
    for (std::int32_t v = std::max(v_px - 3, 0); v <= std::min(v_px + 3, kHeight_px - 1); ++v) {
      for (std::int32_t u = std::max(u_px - 3, 0); u <= std::min(u_px + 3, kWidth_px - 1); ++u) {
        if (image_.pixels[static_cast<std::size_t>(v * kWidth_px + u)] > kSky) return true;
      }
    }
    return false;
  }
  double fraction() const {
    int lit = 0;
    for (std::int32_t v = 0; v < kHeight_px; ++v) {
      for (std::int32_t u = 0; u < kWidth_px; ++u) lit += near(u, v) ? 1 : 0;
    }
    return static_cast<double>(lit) / (kWidth_px * kHeight_px);
  }

 private:
  static constexpr std::uint16_t kSky = 20 * 256;  // of 8 bits, with its noise
  const GreyImage& image_;
};

// Points of the map are green: on the satellite wherever it has turned to, and none in the sky.
TEST(SlamFeed, PicturesShowTheMapsPointsOnTheTarget) {
  const sim::TumblingScenario scenario{
      .turn_deg = 8.0, .step_deg = 2.0, .width_px = kWidth_px, .height_px = kHeight_px, .stars = 0, .povray = false};
  const pharos::test::TemporaryFolder folder;
  sim::write_tumbling(scenario, 5, folder.path().string(), [] {});
  sim::TumblingSequence sequence(scenario, 5);
  StereoConfig config;
  config.name = "bow";
  config.target = "client";
  config.rig = sequence.rig();
  config.frames = folder.path();
  for (CameraSettings& device : config.devices) {
    device.width_px = kWidth_px;
    device.height_px = kHeight_px;
  }
  config.slam.emplace().settings.features = 800;

  test::SourceBench bench;
  bench.config.publish.previews = true;
  bench.config.publish.max_age_s = 1000.0;  // the clock runs ahead of the work
  PreviewStage previews(bench.loop, bench.publisher, bench.config.publish, bench.clock);
  bench.context.previews = &previews;
  StereoFeed feed(bench.context, config);
  bench.run_until(feed, [&] {
    bench.clock.advance(PreviewStage::kPeriod_ns);  // so that every pair's is due
    return bench.finished;
  });
  const auto pictures = [&] { return bench.sink.all<preview_t>("PHAROS_PREVIEW"); };
  const auto poses = bench.sink.all<pose_t>("PHAROS_SLAM_POSE");
  ASSERT_EQ(poses.size(), static_cast<std::size_t>(sequence.frames()));
  bench.run_until(feed, [&] { return pictures().size() >= poses.size(); });

  for (std::size_t k = 0; k < poses.size(); ++k) {
    const preview_t message = pictures()[k];
    EXPECT_EQ(message.source, "slam/bow");
    EXPECT_EQ(message.view, "left");
    EXPECT_EQ(message.status, "ok");
    EXPECT_EQ(message.utime, poses[k].utime);
    const Picture picture = decode_picture(message.data, "preview");
    ASSERT_EQ(picture.width_px, kWidth_px);
    ASSERT_EQ(picture.height_px, kHeight_px);
    const GreyImage image = sequence.image(static_cast<int>(k), 0);
    const LitPlaces lit(image);
    EXPECT_LT(lit.fraction(), 0.6) << "so that a misplaced dot can be seen";
    int green = 0, in_the_sky = 0;
    for (std::int32_t v = 0; v < kHeight_px; ++v) {
      for (std::int32_t u = 0; u < kWidth_px; ++u) {
        const std::uint16_t* rgb = &picture.values[3 * static_cast<std::size_t>(v * kWidth_px + u)];
        if (rgb[1] < rgb[0] + 80 * 257 || rgb[1] < rgb[2] + 30 * 257) continue;
        ++green;
        in_the_sky += lit.near(u, v) ? 0 : 1;
      }
    }
    if (k == 0) continue;  // the map begins with this pair
    EXPECT_GT(green, 400) << "at least 50 dots of some 8 pixels, pair " << k;
    EXPECT_LT(in_the_sky, green / 50) << "pair " << k;
  }
}

}  // namespace
}  // namespace pharos::host
