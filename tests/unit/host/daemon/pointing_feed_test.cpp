// SPDX-License-Identifier: Apache-2.0
// Images that arrive in a directory, processed in pharosd's event loop.
#include "host/daemon/pointing_feed.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <vector>

#include "host/publish/messages.hpp"
#include "pharos/preview_t.hpp"
#include "support/painted_panel.hpp"
#include "unit/host/daemon/source_bench.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;

class PointingFeedTest : public ::testing::Test {
 protected:
  PointingFeedTest() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() / ("pharos_telescope_" + std::to_string(::getpid()) + test->name());
    fs::create_directories(folder);
    scene.set_axis(0.5, 0.3);
    config.name = "dome";
    config.target = "client";
    config.camera = scene.camera;
    config.directory = folder;
    config.track_file = folder / "track.csv";
    config.station = {0.6, 1.9, 100.0};
    std::ofstream(config.track_file) << "image,time_s,azimuth_deg,elevation_deg\n";
  }
  ~PointingFeedTest() override { fs::remove_all(folder); }

  void add_row(const std::string& image, double time_s) {
    std::ofstream(config.track_file, std::ios::app)
        << image << ',' << time_s << ',' << scene.sight.azimuth_rad * 180.0 / 3.14159265358979323846 << ','
        << scene.sight.elevation_rad * 180.0 / 3.14159265358979323846 << '\n';
  }
  void write_image(const std::string& name) { write_grey_png((folder / name).string(), scene.image().view(), 16); }
  void until(const std::function<bool()>& what) { bench.run_until(*feed, what); }
  void start() { feed.emplace(bench.context, config); }
  std::vector<pointing_t> messages() const { return bench.sink.all<pointing_t>("PHAROS_LINE_POINTING"); }
  void wait_for(std::size_t count) {
    bench.run_until(*feed, [&] { return messages().size() >= count; });
  }
  SourceHealth health() { return feed->health().at(0); }
  std::int64_t counter(const std::string& name) { return test::SourceBench::counter(*feed, name); }

  testing::PaintedPanel scene;
  fs::path folder;
  PointingConfig config;
  test::SourceBench bench;
  std::optional<PointingFeed> feed;
};

TEST_F(PointingFeedTest, ReportsTheAxisOfAnImageThatArrives) {
  start();
  add_row("a.png", 1.7e9);
  write_image("a.png");
  wait_for(1);
  const pointing_t message = messages()[0];
  EXPECT_EQ(message.status, "ok");
  EXPECT_EQ(message.source, "line/dome");
  EXPECT_EQ(message.utime, 1'700'000'000'000'000);
  EXPECT_EQ(message.from_pass, 0);
  const Vector3 axis(message.axis_station);
  EXPECT_LT(axis.cross(scene.axis_station).norm(), 0.005);
  EXPECT_GE(axis.z(), 0.0);
  EXPECT_NEAR(Vector3(message.axis_earth).norm(), 1.0, 1e-12);
  EXPECT_GT(message.sigma_axis_rad, 0.0);
  EXPECT_EQ(health().state, SourceState::kOk);
}

TEST_F(PointingFeedTest, SendsAPictureOfAnImageWithItsAnswerAndOfOneWithout) {
  bench.config.publish.previews = true;
  PreviewStage previews(bench.loop, bench.publisher, bench.config.publish, bench.clock);
  bench.context.previews = &previews;
  start();
  const auto pictures = [this] { return bench.sink.all<preview_t>("PHAROS_PREVIEW"); };
  add_row("a.png", 5.0);
  write_image("a.png");
  until([&] { return pictures().size() == 1; });
  EXPECT_EQ(pictures()[0].source, "line/dome");
  EXPECT_EQ(pictures()[0].status, "ok");
  EXPECT_EQ(pictures()[0].utime, messages()[0].utime);
  bench.clock.advance(PreviewStage::kPeriod_ns);
  const GreyImage dark{64, 48, 16, std::vector<std::uint16_t>(std::size_t{64} * 48, 100)};
  add_row("dark.png", 6.0);
  write_grey_png((folder / "dark.png").string(), dark.view(), 16);
  until([&] { return pictures().size() == 2; });
  EXPECT_EQ(pictures()[1].status, messages()[1].status);
  EXPECT_EQ(pictures()[1].status.rfind("refused_", 0), 0u);
  EXPECT_EQ(pictures()[1].width_px, 64);
}

TEST_F(PointingFeedTest, AwaitsTheRestOfAFileAndTheRowOfAnImage) {
  start();
  const fs::path whole = folder / "whole.part";
  write_grey_png(whole.string(), scene.image().view(), 16);
  std::ifstream in(whole, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::ofstream out(folder / "a.png", std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size() / 2)).flush();
  add_row("a.png", 5.0);
  until([&] { return counter("files_arrived") >= 1; });
  EXPECT_TRUE(messages().empty());
  out.write(bytes.data() + bytes.size() / 2, static_cast<std::streamsize>(bytes.size() - bytes.size() / 2));
  out.close();
  wait_for(1);
  fs::rename(whole, folder / "b.png");  // complete at once, before its row of the track file
  until([&] { return health().message.find("wait") != std::string::npos; });
  add_row("b.png", 6.0);
  wait_for(2);
  EXPECT_EQ(messages()[0].status, "ok");
  EXPECT_EQ(messages()[1].status, "ok");
}

TEST_F(PointingFeedTest, CountsAndNamesWhatIsNoImageOrHasNoAnswer) {
  start();
  for (const char* name : {"broken.png", "dark.png", "gap.png"}) {
    if (std::string(name) == "gap.png") {
      std::ofstream(config.track_file, std::ios::app) << "gap.png,,10,20\n";
    } else {
      add_row(name, std::string(name) == "dark.png" ? 2.0 : 1.0);
    }
  }
  std::ofstream(folder / "broken.png") << "no image";
  scene.light = 0.0;
  write_image("dark.png");
  write_image("gap.png");
  std::ofstream(folder / "notes.txt") << "words";
  wait_for(3);
  for (const pointing_t& message : messages()) {
    EXPECT_EQ(message.valid, 0);
    EXPECT_EQ(Vector3(message.axis_station).norm(), 0.0);
  }
  until([&] { return counter("files_no_image") == 1; });
  EXPECT_EQ(counter("refused.unreadable"), 1);
  EXPECT_EQ(counter("refused.black"), 1);
  EXPECT_EQ(counter("refused.track_gap"), 1);
  EXPECT_NE(health().message, "");
}

TEST_F(PointingFeedTest, ReportsAPassOnceWhenItIsOver) {
  config.law = pointing::AttitudeLaw::kInertial;
  config.pass_gap_s = 30.0;
  start();
  for (int k = 0; k < 4; ++k) {
    const std::string name = std::to_string(k) + ".png";
    add_row(name, k < 3 ? 100.0 + 0.01 * k : 200.0);
    write_image(name);
    wait_for(static_cast<std::size_t>(k) + 1);
  }
  wait_for(5);
  const pointing_t pass = messages().back();
  EXPECT_EQ(pass.from_pass, 1);
  EXPECT_EQ(pass.images, 3);
  EXPECT_EQ(pass.status, "ok");
  EXPECT_EQ(pass.utime, 100'010'000);
  EXPECT_LT(Vector3(pass.axis_station).cross(scene.axis_station).norm(), 0.005);
  EXPECT_EQ(counter("passes_ok"), 1);
}

TEST_F(PointingFeedTest, SilenceEndsAPass) {
  config.law = pointing::AttitudeLaw::kInertial;
  config.pass_gap_s = 30.0;
  start();
  for (int k = 0; k < 3; ++k) {
    const std::string name = std::to_string(k) + ".png";
    add_row(name, 100.0 + 0.01 * k);
    write_image(name);
    wait_for(static_cast<std::size_t>(k) + 1);
  }
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  bench.clock.advance(30 * kSecond_ns);
  feed->attend();
  EXPECT_EQ(messages().size(), 3u) << "an image may still come";
  bench.clock.advance(kSecond_ns);
  wait_for(4);
  EXPECT_EQ(messages().back().from_pass, 1);
  EXPECT_EQ(messages().back().images, 3);
}

TEST_F(PointingFeedTest, ADirectoryThatIsMissingIsReportedAndTakenUpWhenItComes) {
  config.directory = folder / "later";
  config.track_file = folder / "track.csv";
  start();
  EXPECT_EQ(health().state, SourceState::kGone);
  EXPECT_NE(health().message, "");
  fs::create_directories(config.directory);
  until([&] { return health().state != SourceState::kGone; });
  add_row("a.png", 1.0);
  write_image("later/a.png");
  wait_for(1);
  EXPECT_EQ(messages()[0].status, "ok");
}

}  // namespace
}  // namespace pharos::host
