// SPDX-License-Identifier: Apache-2.0
// The program pharosd with a directory in which a telescope's images arrive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "host/cameras/camera_file.hpp"
#include "integration/daemon_under_test.hpp"
#include "pharos/base/units.hpp"
#include "support/painted_panel.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr std::int64_t kTime_s = 1'700'000'000;
constexpr double kPointingTimeout_s = 60.0;  // allows for other load

class PharosdPointing : public ::testing::Test {
 protected:
  PharosdPointing() {
    fs::create_directories(images);
    CameraFile camera;
    camera.camera.intrinsics = scene.camera;
    std::ofstream(daemon.folder() / "dome.toml") << camera_text(camera);
    std::ofstream(images / "track.csv") << "image,time_s,azimuth_deg,elevation_deg\n";
    std::ofstream(daemon.folder() / "pharosd.toml")
        << "[lcm]\nurl = '" << daemon.url() << "'\n[publish]\nstatus_rate_hz = 10\n"
        << "[[telescope]]\nname = 'dome'\ntarget = 'client'\ncamera_file = 'dome.toml'\ndirectory = 'images'\n"
        << "latitude_deg = 34.27\nlongitude_deg = 108.95\n";
    daemon.start();
  }
  void add_row(const std::string& image, std::int64_t time_s) {
    std::ofstream(images / "track.csv", std::ios::app)
        << image << ',' << time_s << ',' << scene.sight.azimuth_rad * kDegPerRad << ','
        << scene.sight.elevation_rad * kDegPerRad << '\n';
  }
  /// An image and its row, written like a station's programs do.
  void arrive(const std::string& image, std::int64_t time_s) {
    write_grey_png((images / image).string(), scene.image().view(), 16);
    add_row(image, time_s);
  }
  bool come(std::size_t count) {
    return daemon.wait([&] { return daemon.pointings().size() >= count; }, kPointingTimeout_s);
  }
  /// Checks the panel's axis and the plane that contains it within the stated sigmas.
  void expect_true(const pointing_t& message) const {
    EXPECT_EQ(message.status, "ok");
    EXPECT_EQ(message.valid, 1);
    const Vector3& truth = scene.axis_station;
    const double axis_rad = Vector3(message.axis_station).cross(truth).norm();
    EXPECT_LT(axis_rad, 4.0 * message.sigma_axis_rad);
    EXPECT_LT(message.sigma_axis_rad, 0.01);
    EXPECT_LT(std::abs(Vector3(message.plane_normal_station).dot(truth)), 4.0 * message.sigma_plane_rad);
    EXPECT_LT(message.sigma_plane_rad, 1e-3);
    const Matrix3 R_earth_station = pointing::station_to_earth({34.27 * kRadPerDeg, 108.95 * kRadPerDeg, 0.0});
    EXPECT_LT((Vector3(message.axis_earth) - R_earth_station * Vector3(message.axis_station)).norm(), 1e-12);
  }

  DaemonUnderTest daemon;
  fs::path images = daemon.folder() / "images";
  testing::PaintedPanel scene;
};

TEST_F(PharosdPointing, ReportsTheAxisOfImagesThatArriveAndABrokenOneStopsNothing) {
  scene.set_axis(0.5, 0.3);
  arrive("0001.png", kTime_s);
  ASSERT_TRUE(come(1)) << daemon.process().text();
  expect_true(daemon.pointings()[0]);
  EXPECT_EQ(daemon.pointings()[0].source, "line/dome");
  EXPECT_EQ(daemon.pointings()[0].target, "client");
  EXPECT_EQ(daemon.pointings()[0].utime, 1'700'000'000'000'000) << "of the track's row";

  std::ofstream(images / "0002.png") << "no image";
  add_row("0002.png", kTime_s + 10);
  ASSERT_TRUE(daemon.wait([&] { return daemon.counter("refused.unreadable", "client") == 1; }, kPointingTimeout_s));
  EXPECT_THAT(daemon.source("client")->message, HasSubstr("0002.png"));
  ASSERT_TRUE(come(2));
  EXPECT_EQ(daemon.pointings()[1].status, "refused_unreadable");
  EXPECT_EQ(daemon.pointings()[1].valid, 0);

  scene.set_axis(-0.4, 0.2);
  arrive("0003.png", kTime_s + 20);
  ASSERT_TRUE(come(3)) << daemon.process().text();
  expect_true(daemon.pointings()[2]);
  EXPECT_TRUE(daemon.wait([&] { return daemon.counter("images_ok", "client") == 2; }, kPointingTimeout_s));
  EXPECT_EQ(daemon.source("client")->state, "ok");
  daemon.process().signal(SIGTERM);
  EXPECT_EQ(daemon.process().wait_exit(), 0);
}

}  // namespace
}  // namespace pharos::host
