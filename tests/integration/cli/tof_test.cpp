// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  Outcome tof() const {
    const std::string camera = folder_.write("camera.toml",
                                             "width_px = 32\nheight_px = 24\nfx_px = 32.0\nfy_px = 32.0\ncx_px = 15.5\n"
                                             "cy_px = 11.5\ndistortion = [0.0, 0.0, 0.0, 0.0, 0.0]\n");
    return pharos("tof " + folder_.path("") + " --camera " + camera);
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

}  // namespace
}  // namespace pharos::cli_test
