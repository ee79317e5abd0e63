// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// A short pass of a target that keeps its attitude among the stars; some 90 px of panel.
constexpr const char* kPass =
    "[camera]\nwidth_px = 256\nheight_px = 256\nfocal_px = 3.4e6\n"
    "[imaging]\nbits = 16\nstars = 8\ntracking_px = 2.0\n"
    "[trajectory]\nkind = \"pass\"\naltitude_m = 440.0e3\nside_deg = 1.2\nimages = 5\nspacing_s = 30.0\n"
    "law = \"inertial\"\naxis = [0.5, -0.6, 0.62]\n";

// Rendered once: four seconds.
class CliPointing : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder;
    made_ = new Outcome(pharos("sim line - --output " + folder_->path("pass"), kPass));
  }
  static void TearDownTestSuite() {
    delete made_;
    delete folder_;
  }
  static std::string file(const std::string& name) { return folder_->path("pass/" + name); }
  static std::string track_command() {
    return "line --track " + file("track.csv") + " --camera " + file("camera.toml");
  }

  static Folder* folder_;
  static Outcome* made_;
};
Folder* CliPointing::folder_ = nullptr;
Outcome* CliPointing::made_ = nullptr;

// Degrees between two axes that have no sign, of columns sx, sy, sz.
double between_deg(const Row& a, const Row& b) {
  double dot = 0.0, aa = 0.0, bb = 0.0;
  for (const char* column : {"sx", "sy", "sz"}) {
    const double x = std::stod(a.at(column)), y = std::stod(b.at(column));
    dot += x * y;
    aa += x * x;
    bb += y * y;
  }
  return std::acos(std::min(1.0, std::abs(dot) / std::sqrt(aa * bb))) * 57.29577951308232;
}

TEST_F(CliPointing, TheSimulatorWritesAPassWithItsTruth) {
  ASSERT_EQ(made_->exit_code, 0) << made_->err;
  EXPECT_THAT(made_->err, HasSubstr("track.csv"));
  const auto track = rows_of(content_of(file("track.csv"))), truth = rows_of(content_of(file("truth.csv")));
  ASSERT_EQ(track.size(), 5U);
  ASSERT_EQ(truth.size(), 5U);
  for (std::size_t k = 0; k < track.size(); ++k) {
    EXPECT_EQ(track[k].at("image"), truth[k].at("image"));
    EXPECT_TRUE(std::filesystem::exists(file(track[k].at("image"))));
  }
}

TEST_F(CliPointing, APassEndsWithTheAxisOfAllItsImages) {
  const Outcome run = pharos(track_command() + " --law inertial");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("image,pitch_deg,yaw_deg,sx,sy,sz,ex,ey,ez,earth_pitch_deg,earth_yaw_deg,sigma_deg,"
                                  "plane_nx,plane_ny,plane_nz,sigma_plane_deg,status"));
  const auto rows = rows_of(run.out), truth = rows_of(content_of(file("truth.csv")));
  ASSERT_EQ(rows.size(), 6U);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(rows[k].at("status"), "ok");
    EXPECT_THAT(rows[k].at("flags"), HasSubstr("plane_only"));
    double off = 0.0;
    for (const auto& [normal, axis] : {std::pair{"plane_nx", "sx"}, {"plane_ny", "sy"}, {"plane_nz", "sz"}}) {
      off += std::stod(rows[k].at(normal)) * std::stod(truth[k].at(axis));
    }
    EXPECT_LT(std::abs(off) * 57.3, 4.0 * std::stod(rows[k].at("sigma_plane_deg")));
  }
  EXPECT_EQ(rows[5].at("image"), "pass");
  EXPECT_EQ(rows[5].at("status"), "ok");
  // The third image is in the middle of the pass.
  EXPECT_LT(between_deg(rows[5], truth[2]), 0.3);
}

TEST_F(CliPointing, AWrongLawAndAGapInTheTrackAreRowsWithTheirReason) {
  std::string track = content_of(file("track.csv"));
  std::size_t line = track.find('\n') + 1;  // of the first image: no azimuth
  for (int comma = 0; comma < 2; ++comma) line = track.find(',', line) + 1;
  track.erase(line, track.find(',', line) - line);
  const std::string gap = folder_->write("pass/gap.csv", track);
  const Outcome run = pharos("line --track " + gap + " --camera " + file("camera.toml") + " --law nadir");
  EXPECT_EQ(run.exit_code, 0);
  const auto rows = rows_of(run.out);
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0].at("status"), "refused_track_gap");
  EXPECT_EQ(rows[0].at("sx"), "");
  EXPECT_EQ(rows[5].at("status"), "refused_law_does_not_fit");
  EXPECT_THAT(run.err, HasSubstr("law_does_not_fit"));
}

TEST_F(CliPointing, AnImageThatIsMissingOrBrokenIsARowOfThePassWithItsReason) {
  std::string track = content_of(file("track.csv"));
  const std::string first = rows_of(track)[0].at("image"), second = rows_of(track)[1].at("image");
  track.replace(track.find(first), first.size(), "gone.png");
  track.replace(track.find(second), second.size(), "broken.png");
  folder_->write("pass/broken.png", "no image");
  const Outcome run =
      pharos("line --track " + folder_->write("pass/torn.csv", track) + " --camera " + file("camera.toml"));
  EXPECT_EQ(run.exit_code, 0);
  const auto rows = rows_of(run.out);
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0].at("status"), "refused_unreadable");
  EXPECT_EQ(rows[1].at("status"), "refused_unreadable");
  EXPECT_EQ(rows[2].at("status"), "ok");
  EXPECT_EQ(rows[5].at("status"), "ok") << "three images are a pass";
  EXPECT_THAT(run.err, AllOf(HasSubstr("gone.png"), HasSubstr("broken.png")));
  EXPECT_THAT(run.err, HasSubstr("2 of 5 images could not be used and were left out"));
}

TEST_F(CliPointing, APassOfNothingReadableIsWrongInputWithItsRows) {
  std::string track = content_of(file("track.csv"));
  for (std::size_t at = 0; (at = track.find(".png", at)) != std::string::npos;) track.replace(at, 4, ".tif");
  const Outcome run =
      pharos("line --track " + folder_->write("pass/gone.csv", track) + " --camera " + file("camera.toml"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(rows_of(run.out).at(0).at("status"), "refused_unreadable");
  EXPECT_THAT(run.err, HasSubstr("5 of 5 images could not be used"));
}

TEST_F(CliPointing, OneImageNeedsItsDirectionInRange) {
  const std::string image = "line " + file("0000.png") + " --camera " + file("camera.toml");
  const auto message = [](const Outcome& run) {
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(count_lines(run.err), 1U) << run.err;
    return run.err;
  };
  EXPECT_THAT(message(pharos(image)), HasSubstr("--azimuth-deg"));
  EXPECT_THAT(message(pharos(image + " --azimuth-deg 720 --elevation-deg 40")), HasSubstr("azimuth"));
  EXPECT_THAT(message(pharos(image + " --azimuth-deg 72 --elevation-deg 140")), HasSubstr("elevation"));
  EXPECT_THAT(message(pharos(image + " --track " + file("track.csv"))), HasSubstr("track"));
  EXPECT_THAT(message(pharos("line none.png --camera " + file("camera.toml") + " --azimuth-deg 7 --elevation-deg 40")),
              HasSubstr("none.png"));
  const Outcome run = pharos(image + " --azimuth-deg 72 --elevation-deg 40 --json --time 3");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(first_line(run.out), AllOf(HasSubstr("\"status\":\"ok\""), HasSubstr("\"earth_pitch_deg\":null")));
  EXPECT_THAT(run.err, HasSubstr("median of 3"));
}

// Attitude 1 of paper 003's table 1 at 100 m: the panel is 400 px long.
class CliPointingByPaper : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder;
    made_ =
        new Outcome(pharos("sim line - --output " + folder_->path("still"),
                           "[camera]\nwidth_px = 1024\nheight_px = 1024\nfocal_px = 4000.0\n[imaging]\nbits = 16\n"
                           "[trajectory]\nkind = \"still\"\nattitudes = [[288.0, 52.0, 100.0, -33.7, 72.0, 15.0]]\n"));
  }
  static void TearDownTestSuite() {
    delete made_;
    delete folder_;
  }
  static Outcome line(const std::string& more) {
    return pharos("line " + folder_->path("still/0000.png") + " --camera " + folder_->path("still/camera.toml") +
                  " --azimuth-deg 288 --elevation-deg 52 " + more);
  }
  static Folder* folder_;
  static Outcome* made_;
};
Folder* CliPointingByPaper::folder_ = nullptr;
Outcome* CliPointingByPaper::made_ = nullptr;

TEST_F(CliPointingByPaper, HasTheSameColumnsTheAxisAndNoSigma) {
  ASSERT_EQ(made_->exit_code, 0) << made_->err;
  const Outcome run = line("--method paper --stages " + folder_->path("steps"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(first_line(run.out), first_line(line("").out));
  const Row row = rows_of(run.out).at(0), truth = rows_of(content_of(folder_->path("still/truth.csv"))).at(0);
  EXPECT_EQ(row.at("status"), "ok");
  EXPECT_EQ(row.at("sigma_deg"), "");
  EXPECT_LT(between_deg(row, truth), 0.5);  // its figures at 100 m: 0.066 deg to 0.12, and 6.2 once
  EXPECT_NEAR(std::stod(row.at("square_deg")), 90.0, 2.0);
  for (const char* picture : {"steps/binary.png", "steps/segments.png"}) {
    EXPECT_EQ(content_of(folder_->path(picture)).substr(1, 3), "PNG") << picture;
  }
}

TEST_F(CliPointingByPaper, AGivenSlopeIsTakenAndOptionsOfTheOtherMethodAreRefused) {
  const Outcome across = line("--method paper --paper-slope-deg 0");
  const Outcome found = line("--method paper");
  EXPECT_NE(across.out, found.out);
  EXPECT_EQ(line("--stages " + folder_->path("none")).exit_code, 2);
  EXPECT_EQ(line("--method paper --overlay " + folder_->path("x.png")).exit_code, 2);
  EXPECT_EQ(line("--method paper --time 3").exit_code, 2);
}

}  // namespace
}  // namespace pharos::cli_test
