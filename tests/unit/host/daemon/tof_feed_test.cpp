// SPDX-License-Identifier: Apache-2.0
// Recorded depth frames in pharosd's event loop.
#include "host/daemon/tof_feed.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <string>

#include "host/images/grey_image.hpp"
#include "pharos/pose_t.hpp"
#include "unit/host/daemon/source_bench.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

// Bytes of a target's line that arrive while a frame is measured must be read then: their arrival is the target's time.
TEST(TofFeed, MeasuresNoFrameInTheEventLoop) {
  const fs::path folder = fs::temp_directory_path() / ("pharos_tof_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  TofConfig config;
  config.name = "helios";
  config.target = "client";
  config.frames = folder;
  config.device.width_px = config.camera.intrinsics.width_px = 64;
  config.device.height_px = config.camera.intrinsics.height_px = 48;
  const GreyImage flat{64, 48, 16, std::vector<std::uint16_t>(std::size_t{64} * 48, 8000)};
  for (const std::string name : {"0001", "0002", "0003"}) {
    write_grey_png((folder / (name + "_intensity.png")).string(), flat.view(), 16);
    write_grey_png((folder / (name + "_depth.png")).string(), flat.view(), 16);
  }
  test::SourceBench bench;
  bench.config.publish.max_age_s = 1e6;  // the frames have this computer's time, the bench its own
  TofFeed feed(bench.context, config);
  std::set<std::int64_t> in_work;  // frames that were read and not answered after a turn of the loop
  while (!bench.finished) {
    bench.loop.turn(20);
    const std::int64_t read = test::SourceBench::counter(feed, "device.frames_received");
    if (test::SourceBench::counter(feed, "frames_refused") < read) in_work.insert(read);
  }
  EXPECT_EQ(in_work, (std::set<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(bench.sink.all<pose_t>("PHAROS_TOF_POSE").size(), 3u);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace pharos::host
