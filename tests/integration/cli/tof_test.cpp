// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// Frames of 32 x 24 pixels that show nothing, and their camera.
class CliTof : public ::testing::Test {
 protected:
  void write_frame(const std::string& number) const {
    const std::string black = "P5\n32 24\n65535\n" + std::string(2 * 32 * 24, '\0');
    folder_.write(number + "_intensity.pgm", black);
    folder_.write(number + "_depth.pgm", black);
  }
  void write_broken_frame(const std::string& number) const {
    folder_.write(number + "_intensity.png", "no image");
    folder_.write(number + "_depth.tif", std::string("II*\0", 4));
  }
  Outcome tof(const std::string& more = "") const {
    const std::string camera = folder_.write("camera.toml",
                                             "width_px = 32\nheight_px = 24\nfx_px = 32.0\nfy_px = 32.0\ncx_px = 15.5\n"
                                             "cy_px = 11.5\ndistortion = [0.0, 0.0, 0.0, 0.0, 0.0]\n");
    return pharos("tof " + folder_.path("") + " --camera " + camera + " " + more);
  }
  Folder folder_;
};

TEST_F(CliTof, AFrameThatCannotBeReadIsToldCountedAndARow) {
  write_broken_frame("0000");
  write_frame("0001");
  const Outcome run = tof();
  EXPECT_EQ(run.exit_code, 1);
  const auto rows = rows_of(run.out);
  ASSERT_EQ(rows.size(), 2U) << run.err;
  EXPECT_EQ(rows[0].at("status"), "refused_unreadable");
  EXPECT_EQ(rows[0].at("tx_m"), "");
  EXPECT_THAT(run.err, AllOf(HasSubstr("0000_intensity.png: is no PNG"), HasSubstr("1 of 2 frames could not be used")));
}

TEST_F(CliTof, WhereNothingCanBeReadTheInputIsWrong) {
  write_broken_frame("0000");
  write_broken_frame("0001");
  const Outcome run = tof();
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(rows_of(run.out).size(), 2U);
}

// Three frames of a target at rest before the camera, as paper 000's test 3.
class CliTofByPaper : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder;
    made_ = new Outcome(pharos("sim tof - --seed 1 --output " + folder_->path("frames"),
                               "[trajectory]\nkind = \"still\"\nframes_per_pose = 3\nposes = [[-0.0249, -0.0177, "
                               "3.161, 2.2, -1.1, -50.0]]\n"));
  }
  static void TearDownTestSuite() {
    delete made_;
    delete folder_;
  }
  static Outcome tof(const std::string& more) {
    return pharos("tof " + folder_->path("frames") + " --camera " + folder_->path("frames/camera.toml") + " " + more);
  }
  static Outcome by_paper(const std::string& more) { return tof("--method paper " + more); }

  static Folder* folder_;
  static Outcome* made_;
};
Folder* CliTofByPaper::folder_ = nullptr;
Outcome* CliTofByPaper::made_ = nullptr;

// The median, as single frames of the chain may take another pair of ellipses.
double median_of(const std::vector<Row>& rows, const std::string& column) {
  std::vector<double> values;
  for (const Row& row : rows) values.push_back(std::stod(row.at(column)));
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

TEST_F(CliTofByPaper, HasTheSameColumnsAndThePrintedPose) {
  ASSERT_EQ(made_->exit_code, 0) << made_->err;
  const Outcome run = by_paper("");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(first_line(run.out), first_line(tof("").out));
  const auto rows = rows_of(run.out);
  ASSERT_EQ(rows.size(), 3U);
  for (const Row& row : rows) {
    EXPECT_EQ(row.at("status"), "ok");
    EXPECT_EQ(row.at("sigma_rot_deg"), "");
    EXPECT_EQ(row.at("flags"), "");
  }
  // A grey value is 3.9 mm, and table 2 scatters by 2.3 mm and 0.4 deg.
  EXPECT_NEAR(median_of(rows, "tz_m"), 3.161, 0.010);
  EXPECT_NEAR(median_of(rows, "tx_m"), -0.0249, 0.005);
  EXPECT_NEAR(median_of(rows, "alpha_deg"), 2.2, 1.5);
  EXPECT_NEAR(median_of(rows, "beta_deg"), -1.1, 1.5);
}

TEST_F(CliTofByPaper, StatesNoCovarianceAndNoForetoldSigma) {
  const auto rows = rows_of(by_paper("--covariance").out);
  ASSERT_EQ(rows.size(), 3U);
  for (const Row& row : rows) EXPECT_EQ(row.at("cov_tx_tx_m2"), "");
  const auto summary = rows_of(by_paper("--summary").out);
  ASSERT_EQ(summary.size(), 2U);
  EXPECT_EQ(summary[0].at("statistic"), "mean");
  EXPECT_EQ(summary[1].at("statistic"), "sigma");
  EXPECT_EQ(summary[0].at("frames"), "3");
}

TEST_F(CliTofByPaper, StagesAreThePicturesOfFiguresFiveAndSix) {
  ASSERT_EQ(by_paper("--stages " + folder_->path("stages")).exit_code, 0);
  for (const char* frame : {"0000", "0001", "0002"}) {
    for (const char* step : {"5_amplitude", "5a_grey", "5b_edges", "5c_arcs", "5d_fitted", "5e_accepted", "5f_ring",
                             "6b_above", "6c_morphology", "6d_area", "6e_aspect", "6f_filling"}) {
      const std::string picture = folder_->path("stages/" + (frame + ('_' + std::string(step))) + ".png");
      EXPECT_EQ(content_of(picture).substr(1, 3), "PNG") << picture;
    }
  }
}

// The binary images differ, whatever comes out of them.
TEST_F(CliTofByPaper, TheThresholdIsThePrintedOneOrThatByCount) {
  ASSERT_EQ(by_paper("--threshold count --stages " + folder_->path("count")).exit_code, 0);
  ASSERT_EQ(by_paper("--threshold printed --stages " + folder_->path("printed")).exit_code, 0);
  ASSERT_EQ(by_paper("--stages " + folder_->path("default")).exit_code, 0);
  const auto above = [](const std::string& folder) { return content_of(folder_->path(folder + "/0000_6b_above.png")); };
  EXPECT_NE(above("count"), above("printed"));
  EXPECT_EQ(above("default"), above("printed"));
  EXPECT_EQ(by_paper("--threshold otsu").exit_code, 2);
}

TEST_F(CliTofByPaper, OptionsOfTheOtherMethodAreRefused) {
  for (const char* option : {"--window 2", "--depth-bits 8", "--connectors 1", "--overlay x", "--learn x"}) {
    const Outcome run = by_paper(option);
    EXPECT_EQ(run.exit_code, 2) << option;
    EXPECT_THAT(run.err, HasSubstr("is not of --method paper")) << option;
  }
  for (const char* option : {"--threshold count", "--stages x"}) {
    const Outcome run = tof(option);
    EXPECT_EQ(run.exit_code, 2) << option;
    EXPECT_THAT(run.err, HasSubstr("is of --method paper alone")) << option;
  }
}

TEST_F(CliTof, ThePapersMethodRefusesAFrameWithoutARing) {
  write_frame("0000");
  const Outcome run = tof("--method paper");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(rows_of(run.out).at(0).at("status"), "refused_no_ring");
  EXPECT_THAT(run.err, HasSubstr("refused_no_ring"));
}

}  // namespace
}  // namespace pharos::cli_test
