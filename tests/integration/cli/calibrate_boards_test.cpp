// SPDX-License-Identifier: Apache-2.0
// The commands pharos calibrate camera and stereo.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "host/cameras/camera_file.hpp"
#include "host/cameras/rig_file.hpp"
#include "host/images/grey_image.hpp"
#include "pharos/geometry/rotation.hpp"
#include "tests/integration/cli/program.hpp"
#include "tools/sim/board/board_poses.hpp"

namespace pharos::cli_test {
namespace {

using testing::HasSubstr;

const sim::Lens kSmallLens{320, 240, 300.0, 301.0, 161.0, 118.0, {-0.2, 0.08, 0.002, -0.0002, 0.0}};
const sim::BoardSheet kSmallSheet{true, 6, 5, 0.03, 0.008, -1};
const std::string kBoard = " --columns 6 --rows 5 --pitch-mm 30 --radius-mm 8 --hold-k3";
const Pose<frame::Camera, frame::Camera> kRig{rotation_exp({0.0, -0.05, 0.0}), {0.06, 0.0, 0.0}};

// Rendered images: left0.png, right0.png, …
class BoardImages : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }

  void render(const std::string& name, const Pose<frame::Camera, frame::Board>& T) const {
    static const sim::BoardRenderer renderer(kSmallLens);
    sim::Exposure exposure;
    exposure.noise = 100.0;
    host::write_grey_png(path(name), renderer.render(kSmallSheet, T, exposure, 1).view());
  }
  void render_tilted(int count) const {
    const std::vector<Vector3> tilts{{0.5, 0.0, 0.0}, {-0.3, 0.5, 0.0}, {0.0, -0.5, 0.2}, {-0.5, -0.2, 0.0}};
    for (int i = 0; i < count; ++i) {
      const auto T = sim::board_at(kSmallSheet, {0.02, 0.0, 0.3 + 0.02 * i}, tilts[static_cast<std::size_t>(i)]);
      render("left" + std::to_string(i) + ".png", T);
      render("right" + std::to_string(i) + ".png", kRig.inverse() * T);
    }
  }
  std::string list(const std::string& side, int count) const {
    std::string names;
    for (int i = 0; i < count; ++i) names += " " + path(side + std::to_string(i) + ".png");
    return names;
  }

  Folder folder_;
};

TEST_F(BoardImages, GiveACameraFileOverlaysAndTheStatusOfEachImage) {
  render_tilted(4);
  const std::vector<std::uint16_t> dark(320 * 240);
  host::write_grey_png(path("dark.png"), {dark.data(), 320, 240});
  const Outcome run = pharos("calibrate camera" + list("left", 4) + " " + path("dark.png") + kBoard + " --output " +
                             path("camera.toml") + " --images " + path("fates.csv") + " --overlay " + path("overlay") +
                             " --points " + path("points.csv"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, testing::StartsWith("parameter,value,sigma\nfx_px,"));
  EXPECT_THAT(run.err, HasSubstr("5 images: 1 no_board, 4 used"));
  EXPECT_THAT(run.err, HasSubstr("dark.png: no_board: no dots"));
  EXPECT_THAT(run.err, HasSubstr("k3 was held"));
  const host::CameraFile file = host::read_camera_file(path("camera.toml"));
  EXPECT_NEAR(file.camera.intrinsics.fx_px, kSmallLens.fx_px, 0.5);
  ASSERT_TRUE(file.calibration);
  EXPECT_EQ(file.calibration->images, 4);
  EXPECT_EQ(file.calibration->points, 4 * 30);
  EXPECT_EQ(file.calibration->parameters.size(), 8U);
  EXPECT_TRUE(std::filesystem::exists(path("overlay/left0.png")));
  EXPECT_TRUE(std::filesystem::exists(path("overlay/dark.png")));
  const std::vector<Row> outcomes = rows_of(content_of(path("fates.csv")));
  ASSERT_EQ(outcomes.size(), 5U);
  EXPECT_EQ(outcomes[0].at("status"), "used");
  EXPECT_EQ(outcomes[4].at("status"), "no_board");
  EXPECT_EQ(outcomes[4].at("rms_px"), "");
  double square = 0.0;  // of the first image
  const std::vector<Row> points = rows_of(content_of(path("points.csv")));
  ASSERT_EQ(points.size(), 4U * 30U);
  for (const Row& point : points) {
    if (point.at("image") != outcomes[0].at("image")) continue;
    square += std::pow(std::stod(point.at("du_px")), 2) + std::pow(std::stod(point.at("dv_px")), 2);
  }
  const double rms_px = std::stod(outcomes[0].at("rms_px"));
  EXPECT_NEAR(std::sqrt(square / 30.0), rms_px, 1e-9 * rms_px);
}

TEST_F(BoardImages, AreSearchedByOtsusThresholdOnRequest) {
  render_tilted(4);
  const std::string command = "calibrate camera" + list("left", 4) + kBoard + " --output " + path("camera.toml");
  const Outcome run = pharos(command + " --dot-threshold otsu");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("4 images: 4 used"));
  EXPECT_NEAR(host::read_camera_file(path("camera.toml")).camera.intrinsics.fx_px, kSmallLens.fx_px, 0.5);
  EXPECT_EQ(pharos(command + " --dot-threshold mean").exit_code, 2);
}

TEST_F(BoardImages, ThatCannotBeReadAreLeftOutAndKeepTheirRow) {
  render_tilted(4);
  folder_.write("broken.tif", std::string("II*\0", 4));
  const std::string outcomes = path("fates.csv");
  const Outcome run = pharos("calibrate camera " + path("broken.tif") + list("left", 4) + kBoard + " --output " +
                             path("camera.toml") + " --images " + outcomes + " --overlay " + path("overlay"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("broken.tif: damaged TIFF"));
  EXPECT_THAT(run.err, HasSubstr("5 images: 1 unreadable, 4 used"));
  EXPECT_THAT(run.err, HasSubstr("1 of 5 images could not be used"));
  ASSERT_EQ(rows_of(content_of(outcomes)).size(), 5U);
  EXPECT_EQ(rows_of(content_of(outcomes))[0].at("status"), "unreadable");

  const Outcome rig =
      pharos("calibrate stereo --left" + list("left", 4) + " " + path("broken.tif") + " --right" + list("right", 4) +
             " " + path("right0.png") + kBoard + " --output " + path("rig.toml") + " --images " + outcomes);
  ASSERT_EQ(rig.exit_code, 0) << rig.err;
  const std::vector<Row> rows = rows_of(content_of(outcomes));
  ASSERT_EQ(rows.size(), 10U);
  EXPECT_EQ(rows[4].at("status"), "unreadable");
  EXPECT_EQ(rows[9].at("status"), "no_partner");

  const Outcome none = pharos("calibrate camera " + path("broken.tif") + " " + path("gone.png") + kBoard +
                              " --output " + path("none.toml"));
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(path("none.toml")));
}

TEST_F(BoardImages, GiveARigFile) {
  render_tilted(4);
  const Outcome run = pharos("calibrate stereo --left" + list("left", 4) + " --right" + list("right", 4) + kBoard +
                             " --output " + path("rig.toml"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("epipolar rms"));
  const host::RigFile rig = host::read_rig_file(path("rig.toml"));
  EXPECT_LT((rig.left.pose().t).norm(), 1e-15);
  EXPECT_LT((rig.right.pose().t - kRig.t).norm(), 5e-4);
  EXPECT_LT(rotation_angle_between(rig.right.pose().R, kRig.R), 2e-3);
}

TEST_F(BoardImages, OfOnePoseAreRefusedAndNoFileIsWritten) {
  render_tilted(1);
  const std::string same = list("left", 1);
  const Outcome run = pharos("calibrate camera" + same + same + same + kBoard + " --output " + path("camera.toml"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("no camera: "));
  EXPECT_FALSE(std::filesystem::exists(path("camera.toml")));
}

TEST_F(BoardImages, WrongUsageIsReportedInOneLine) {
  const std::string output = " --output " + path("camera.toml");
  const auto message = [&](const std::string& arguments) {
    const Outcome run = pharos("calibrate " + arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    return run.err;
  };
  EXPECT_THAT(message("camera nothing.png" + output), HasSubstr("nothing.png"));
  EXPECT_THAT(message("camera a.png --board chessboard" + output), HasSubstr("needs --columns, --rows"));
  EXPECT_THAT(message("camera a.png --radius-mm 10" + output), HasSubstr("touch"));
  EXPECT_THAT(message("stereo --left a.png b.png --right c.png" + output), HasSubstr("2 left and 1 right"));
}

}  // namespace
}  // namespace pharos::cli_test
