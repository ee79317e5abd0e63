// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Ellipses of the installed sweep scenario, without noise, and their rig.
struct Sweep {
  explicit Sweep(const Folder& folder) : rig(folder.path("out/rig.toml")), ellipses(folder.path("out/ellipses.csv")) {
    std::string scenario = content_of(std::string(PHAROS_SCENARIOS) + "/stereo_sweep.toml");
    const std::string noise = "edge_sigma_px = 0.1";
    scenario.replace(scenario.find(noise), noise.size(), "edge_sigma_px = 0.0");
    made = pharos("sim stereo - --output " + folder.path("out"), scenario);
  }
  Outcome made;
  std::string rig, ellipses;
};

TEST(CliRing2, BatchKeepsItsRowsAndAnswersWithTheTruth) {
  const Folder folder;
  const Sweep sweep(folder);
  ASSERT_EQ(sweep.made.exit_code, 0) << sweep.made.err;
  const Outcome run = pharos("circles --ellipses " + sweep.ellipses + " --rig " + sweep.rig);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("problem,theta_deg,gamma_deg,nx,ny,nz,cx_m,cy_m,cz_m,ring_radius_m,nozzle_radius_m,"
                                  "distance_m,sigma_deg,status"));
  const auto rows = rows_of(run.out);
  const auto truth = rows_of(content_of(folder.path("out/truth.csv")));
  ASSERT_EQ(rows.size(), truth.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k].at("problem"), truth[k].at("pair"));
    EXPECT_EQ(rows[k].at("status"), "ok");
    for (const char* column : {"theta_deg", "gamma_deg", "cz_m", "ring_radius_m", "nozzle_radius_m", "distance_m"}) {
      EXPECT_NEAR(std::stod(rows[k].at(column)), std::stod(truth[k].at(column)), 1e-6) << column;
    }
  }
}

TEST(CliRing2, ThePaperSaysItsOwnAndNoSigma) {
  const Folder folder;
  const Sweep sweep(folder);
  const Outcome run = pharos("circles --ellipses " + sweep.ellipses + " --rig " + sweep.rig + " --method paper --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(first_line(run.out), AllOf(HasSubstr("\"sigma_deg\":null"), HasSubstr("\"status\":\"ok\"")));
}

TEST(CliRing2, RefusedRowsKeepTheirPlaceWithEmptyFields) {
  const Folder folder;
  const Sweep sweep(folder);
  const std::string table = "view,feature,cx_px,cy_px,a_px,b_px,theta_rad\nleft,ring,600,510,110,100,0.1\n";
  const Outcome run = pharos("circles --ellipses - --rig " + sweep.rig, table);
  EXPECT_EQ(run.exit_code, 1);
  const auto rows = rows_of(run.out);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("status"), "refused_too_few_ellipses");
  EXPECT_EQ(rows[0].at("theta_deg"), "");
  EXPECT_THAT(run.err, HasSubstr("fewer than two ellipses")) << "and not in silence";
}

TEST(CliRing2, LeftAndRightExchangedIsTheReasonOfEveryRow) {
  const Folder folder;
  const Sweep sweep(folder);
  std::string table = content_of(sweep.ellipses);
  for (const auto& [from, to] : {std::pair{",left,", ",other,"}, {",right,", ",left,"}, {",other,", ",right,"}}) {
    table = std::regex_replace(table, std::regex(from), to);
  }
  const Outcome run = pharos("circles --ellipses - --rig " + sweep.rig, table);
  EXPECT_EQ(run.exit_code, 1);
  for (const Row& row : rows_of(run.out)) EXPECT_EQ(row.at("status"), "refused_left_right_exchanged");
}

TEST(CliRing2, AnImageOfNothingIsNamedWithItsSide) {
  const Folder folder;
  const Sweep sweep(folder);
  // A grey image of the rig's 1280 x 1024 pixels, all of one value.
  const auto even = [&](const std::string& name, char value) {
    return folder.write(name, "P5\n1280 1024\n255\n" + std::string(std::size_t{1280} * 1024, value));
  };
  const std::string black = even("black.pgm", '\0'), white = even("white.pgm", '\xff');
  for (const auto& [images, status] :
       {std::pair{black + ' ' + white, "refused_left_black"}, {white + ' ' + black, "refused_left_saturated"}}) {
    const Outcome run = pharos("circles " + images + " --rig " + sweep.rig);
    EXPECT_EQ(run.exit_code, 1);
    ASSERT_EQ(rows_of(run.out).size(), 1U) << run.err;
    EXPECT_EQ(rows_of(run.out)[0].at("status"), status);
    EXPECT_THAT(run.err, HasSubstr("left image: is ")) << "and not in silence";
  }
}

TEST(CliRing2, WrongUsageIsSaidInOneLine) {
  const Folder folder;
  const Sweep sweep(folder);
  const auto message = [](const Outcome& run) {
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(count_lines(run.err), 1U) << run.err;
    return run.err;
  };
  EXPECT_THAT(message(pharos("circles --rig " + sweep.rig)), HasSubstr("two images"));
  EXPECT_THAT(message(pharos("circles one.png --rig " + sweep.rig)), HasSubstr("both images"));
  EXPECT_THAT(message(pharos("circles no.png none.png --rig " + sweep.rig)), HasSubstr("no.png"));
  const std::string broken = folder.write("broken.bmp", "BM");
  EXPECT_THAT(message(pharos("circles " + broken + " " + broken + " --rig " + sweep.rig)), HasSubstr("damaged BMP"));
  std::string rig = content_of(sweep.rig);
  const std::size_t place = rig.find("position_m = [0.9");
  ASSERT_NE(place, std::string::npos) << rig;
  rig.replace(place, 17, "position_m = [-0.9");
  EXPECT_THAT(message(pharos("circles --ellipses " + sweep.ellipses + " --rig " + folder.write("same.toml", rig))),
              HasSubstr("same.toml"));
}

}  // namespace
}  // namespace pharos::cli_test
