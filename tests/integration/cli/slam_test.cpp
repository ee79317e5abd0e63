// SPDX-License-Identifier: Apache-2.0
// `pharos slam` with wrong input of a user: one line that says what and where, and exit code 2, or 1 where images that
// can be read are no pairs. `pharos vocabulary`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <regex>
#include <sstream>

#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::HasSubstr;

// Cameras of 64x48 px, the right one `right_x_m` to the right.
std::string rig_text(const std::string& right_x_m) {
  std::string text;
  for (const auto& [side, x_m] : {std::pair<std::string, std::string>{"left", "0.0"}, {"right", right_x_m}}) {
    text += "[" + side +
            "]\nwidth_px = 64\nheight_px = 48\nfx_px = 64.0\nfy_px = 64.0\ncx_px = 31.5\ncy_px = 23.5\n"
            "distortion = [0.0, 0.0, 0.0, 0.0, 0.0]\nrotation_wxyz = [1.0, 0.0, 0.0, 0.0]\nposition_m = [" +
            x_m + ", 0.0, 0.0]\n";
  }
  return text;
}

// Two folders of three black pairs, and their rig.
class CliSlam : public ::testing::Test {
 protected:
  CliSlam() {
    for (const char* side : {"left", "right"}) {
      std::filesystem::create_directories(folder_.path(side));
      for (const char* name : {"0", "1", "2"}) black(side + std::string("/") + name + ".pgm", 64, 48);
    }
    rig_ = folder_.write("rig.toml", rig_text("0.5"));
  }
  void black(const std::string& name, int width_px, int height_px) const {
    const std::string head = "P5\n" + std::to_string(width_px) + " " + std::to_string(height_px) + "\n255\n";
    folder_.write(name, head + std::string(static_cast<std::size_t>(width_px * height_px), '\0'));
  }
  Outcome slam(const std::string& more = "") const {
    return pharos("slam " + folder_.path("left") + " " + folder_.path("right") + " --rig " + rig_ + more);
  }
  static void expect_refused(const Outcome& run, const std::string& words, int exit_code = 2) {
    EXPECT_EQ(run.exit_code, exit_code);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(count_lines(run.err), 1U) << run.err;
    EXPECT_THAT(run.err, HasSubstr(words));
  }
  Folder folder_;
  std::string rig_;
};

TEST_F(CliSlam, BlackPairsHaveNoPoseAndAReport) {
  const std::string report = folder_.path("report.json");
  const Outcome run = slam(" --pairs 7 --report " + report);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, HasSubstr("no frame could be placed: 7 pairs"));
  const std::string text = content_of(report);
  EXPECT_THAT(text, HasSubstr("\"dark\": 7"));
  const std::regex memory(R"("pair": 7,\s*"resident_mib": [1-9])");
  EXPECT_TRUE(std::regex_search(text, memory)) << text;
  EXPECT_THAT(text, HasSubstr("\"memory_peak_mib\": "));
}

TEST_F(CliSlam, ARigWithoutBaselineIsNamed) {
  rig_ = folder_.write("rig.toml", rig_text("0.0"));
  expect_refused(slam(), "right.position_m: is the left camera's");
}

TEST_F(CliSlam, ImagesOfAnotherSizeThanTheRigSaysAreNamed) {
  for (const char* side : {"left", "right"}) black(side + std::string("/0.pgm"), 32, 24);
  expect_refused(slam(), "32 x 24");
}

TEST_F(CliSlam, AVocabularyCutShortIsNamed) {
  const std::string whole = content_of((std::filesystem::path(PHAROS_PROGRAM).parent_path() / "orb.words").string());
  ASSERT_GT(whole.size(), 1000U);
  const std::string cut = folder_.write("cut.words", whole.substr(0, whole.size() / 2));
  expect_refused(slam(" --vocabulary " + cut), "cut.words");
}

TEST_F(CliSlam, AnEmptyFolderIsNamed) {
  for (const char* name : {"0", "1", "2"}) std::filesystem::remove(folder_.path(std::string("left/") + name + ".pgm"));
  expect_refused(slam(), "holds no .png, .tif, .pgm, .ppm, .jpg or .bmp image");
}

// An invalid pair affects only itself.
TEST_F(CliSlam, PairsThatAreNoneAreToldCountedAndLeftOut) {
  for (const char* side : {"left", "right"}) {
    for (const char* name : {"3", "4", "5"}) black(side + std::string("/") + name + ".pgm", 64, 48);
  }
  std::filesystem::remove(folder_.path("right/1.pgm"));
  folder_.write("right/3.pgm", "P5\n64 48\n255\nabc");
  black("left/4.pgm", 32, 24);
  const std::string report = folder_.path("report.json");
  const Outcome run = slam(" --report " + report);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(count_lines(run.err), 5U) << run.err;
  EXPECT_THAT(run.err, HasSubstr("left/1.pgm: has no partner; left out"));
  EXPECT_THAT(run.err, HasSubstr("right/3.pgm"));
  EXPECT_THAT(run.err, HasSubstr("left/4.pgm: has 32 x 24 pixels; the rig's cameras have 64 x 48"));
  EXPECT_THAT(run.err, HasSubstr("no frame could be placed: 3 pairs"));
  EXPECT_THAT(run.err, HasSubstr("2 of 5 pairs could not be used and were left out"));
  const std::string text = content_of(report);
  EXPECT_THAT(text, HasSubstr("\"frames\": 3"));
  EXPECT_THAT(text, HasSubstr("\"unreadable\": 2"));
  EXPECT_THAT(text, HasSubstr("\"without_partner\": 1"));
}

TEST_F(CliSlam, NumbersMissingOnBothSidesAreReported) {
  for (const char* side : {"left", "right"}) black(side + std::string("/4.pgm"), 64, 48);
  EXPECT_THAT(slam().err, HasSubstr("left/4.pgm: numbers are missing before it"));
}

TEST_F(CliSlam, AFirstImageCutShortIsLeftOutLikeAnyOther) {
  folder_.write("right/0.pgm", "P5\n64 48\n255\nabc");
  const Outcome run = slam();
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("right/0.pgm: damaged PGM"));
  EXPECT_THAT(run.err, HasSubstr("1 of 3 pairs could not be used"));
  EXPECT_THAT(run.err, HasSubstr("no frame could be placed: 2 pairs"));
}

TEST_F(CliSlam, WhereNothingCanBeReadTheInputIsWrong) {
  for (const char* name : {"0", "1", "2"}) folder_.write(std::string("left/") + name + ".pgm", "P5");
  const Outcome run = slam();
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("3 of 3 pairs could not be used"));
}

TEST_F(CliSlam, ColourIsSaidOnce) {
  for (const char* name : {"0", "1", "2"}) {
    std::filesystem::remove(folder_.path(std::string("left/") + name + ".pgm"));
    folder_.write(std::string("left/") + name + ".ppm", "P6\n64 48\n255\n" + std::string(64 * 48 * 3 - 1, '\0') + "x");
  }
  const Outcome run = slam();
  EXPECT_THAT(run.err, HasSubstr("left/0.ppm: is in colour; its luma"));
  EXPECT_EQ(count_lines(run.err), 2U) << run.err;
}

TEST_F(CliSlam, TheLeftPicturesTwiceAreRefused) {
  const std::string same = "left and right image are the same picture";
  expect_refused(pharos("slam " + folder_.path("left") + " " + folder_.path("left/../left") + " --rig " + rig_), same,
                 1);
  std::string picture = "P5\n64 48\n255\n" + std::string(64 * 48 - 1, '\0') + "x";
  for (const char* side : {"left", "right"}) folder_.write(side + std::string("/0.pgm"), picture);
  expect_refused(slam(), same, 1);
}

TEST_F(CliSlam, ATableNamesFramesWithoutAPose) {
  const Outcome run = slam(" --json");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(count_lines(run.out), 3U);
  EXPECT_THAT(first_line(run.out), HasSubstr("\"sigma_pos_mm\":null,\"status\":\"refused_lost\""));
  EXPECT_EQ(slam(" -o " + folder_.path("none.tum")).exit_code, 1);
  EXPECT_EQ(content_of(folder_.path("none.tum")), "");
}

TEST_F(CliSlam, ImagesWithoutPartnersOnBothSidesAreNoPairs) {
  for (const char* name : {"0", "1"}) std::filesystem::remove(folder_.path(std::string("left/") + name + ".pgm"));
  expect_refused(slam(), "has no partner");
}

// Raw images of the EuRoC data set's rig, whose frame is that of an IMU: accepted.
TEST_F(CliSlam, TheRigOfEurocIsTaken) {
  for (const char* side : {"left", "right"}) {
    for (const char* name : {"0", "1", "2"}) black(side + std::string("/") + name + ".pgm", 752, 480);
  }
  rig_ = PHAROS_EUROC_RIG;
  const Outcome run = slam(" --scene static");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("no frame could be placed: 3 pairs"));
}

TEST_F(CliSlam, ARigFileWithoutNumbersIsNamed) {
  std::string text = rig_text("0.5");
  text.replace(text.find("64.0"), 4, "nan");
  rig_ = folder_.write("rig.toml", text);
  expect_refused(slam(), "rig.toml:4: left.fx_px");
}

TEST_F(CliSlam, AMapThatCannotBeWrittenIsNamedBeforeTheWork) {
  expect_refused(slam(" --map /nowhere/map.ply"), "/nowhere/map.ply: cannot be written");
}

// Words from a chequered image's features, which pharos slam then accepts.
TEST_F(CliSlam, AVocabularyIsTrainedAndTaken) {
  std::string checks = "P5\n320 240\n255\n";
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u)
      checks.push_back(static_cast<char>(40 + (u / 9 * 31 + v / 7 * 17 + u * v / 600) % 9 * 20));
  }
  const std::string image = folder_.write("checks.pgm", checks), words = folder_.path("own.words"),
                    again = folder_.path("again.words");
  const std::string train = "vocabulary " + image + " --branches 4 --depth 2 --output ";
  const Outcome run = pharos(train + words);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("16 words of 1 images"));
  EXPECT_EQ(slam(" --vocabulary " + words).exit_code, 1) << "taken; the pairs are black";
  EXPECT_EQ(pharos(train + again).exit_code, 0);
  EXPECT_EQ(content_of(words), content_of(again));
  expect_refused(pharos("vocabulary " + folder_.path("left/0.pgm") + " --output " + words), "no features");
}

std::vector<std::vector<double>> numbers_of(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (double value = 0.0; fields >> value;) rows.back().push_back(value);
  }
  return rows;
}

// q = (x, y, z, w) as in the file.
std::array<double, 3> turned(const std::vector<double>& row, double x, double y, double z) {
  const double a = row[4], b = row[5], c = row[6], w = row[7];
  const double i = b * z - c * y + w * x, j = c * x - a * z + w * y, k = a * y - b * x + w * z;
  return {x + 2.0 * (b * k - c * j), y + 2.0 * (c * i - a * k), z + 2.0 * (a * j - b * i)};
}

double figure(const Outcome& evaluated, const std::string& column) {
  EXPECT_EQ(evaluated.exit_code, 0) << evaluated.err;
  return std::stod(rows_of(evaluated.out).at(0).at(column));
}

TEST(CliSlamFiles, ATumblingTargetToPosesMapAndPictures) {
  const Folder folder;
  const std::string turn = folder.path("turn"), report = folder.path("report.json"), map = folder.path("map.ply");
  ASSERT_EQ(pharos("sim stereo --scene tumbling --turn-deg 3 --renderer rays --output " + turn).exit_code, 0);
  const std::string slam = "slam " + turn + "/left " + turn + "/right --rig " + turn + "/rig.toml";
  const Outcome target = pharos(slam + " --report " + report + " --map " + map + " --overlay " + folder.path("seen"));
  ASSERT_EQ(target.exit_code, 0) << target.err;
  const auto rows = numbers_of(target.out);
  ASSERT_EQ(rows.size(), 7U);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    ASSERT_EQ(rows[k].size(), 8U);
    EXPECT_DOUBLE_EQ(rows[k][0], 0.05 * static_cast<double>(k));
  }
  const std::string against = " " + turn + "/truth.tum";
  const Outcome evaluated = pharos("evaluate " + folder.write("turn.tum", target.out) + against);
  EXPECT_EQ(figure(evaluated, "compared"), 7.0);
  EXPECT_LT(figure(evaluated, "rot_max_deg"), 0.1);
  EXPECT_LT(figure(evaluated, "pos_max_mm"), 10.0);

  const std::string table = folder.path("turn.csv");
  const Outcome csv = pharos(slam + " --format csv -o " + table);
  ASSERT_EQ(csv.exit_code, 0) << csv.err;
  EXPECT_EQ(csv.out, "");
  const auto cells = rows_of(content_of(table));
  ASSERT_EQ(cells.size(), 7U);
  EXPECT_EQ(std::stod(cells[6].at("tx_m")), rows[6][1]);
  EXPECT_EQ(std::stod(cells[6].at("qw")), rows[6][7]);
  EXPECT_EQ(std::stod(cells[0].at("sigma_pos_mm")), 0.0) << "the first frame defines the target's";
  const Outcome consistent = pharos("evaluate " + table + against);
  EXPECT_GT(figure(consistent, "pos_normalised_square"), 0.0);
  EXPECT_LT(figure(consistent, "pos_normalised_square"), 10.0);

  const auto slower = numbers_of(pharos(slam + " --rate 10").out);
  ASSERT_EQ(slower.size(), rows.size());
  EXPECT_DOUBLE_EQ(slower[6][0], 0.6);

  // Of the same rate, as keyframes depend on time.
  const auto camera = numbers_of(pharos(slam + " --output camera").out);
  ASSERT_EQ(camera.size(), rows.size());
  const std::vector<double>&of_target = rows[6], &of_camera = camera[6];
  const auto back = turned(of_target, of_camera[1], of_camera[2], of_camera[3]);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(back[k], -of_target[k + 1], 1e-9) << "R t' = -t";
    EXPECT_NEAR(of_camera[k + 4], -of_target[k + 4], 1e-12);
  }

  const Outcome exchanged = pharos("slam " + turn + "/right " + turn + "/left --rig " + turn + "/rig.toml");
  EXPECT_EQ(exchanged.exit_code, 1);
  EXPECT_EQ(exchanged.out, "");
  EXPECT_THAT(exchanged.err, HasSubstr("exchanged"));

  const std::string text = content_of(report), cloud = content_of(map);
  std::smatch points;
  ASSERT_TRUE(std::regex_search(text, points, std::regex(R"("points": (\d+))")));
  EXPECT_GT(std::stoi(points[1]), 100);
  EXPECT_THAT(cloud, HasSubstr("element vertex " + points[1].str() + "\n"));
  EXPECT_EQ(count_lines(cloud.substr(cloud.find("end_header"))), std::stoul(points[1]) + 1);
  EXPECT_THAT(text, HasSubstr("\"tracked\": 7"));
  EXPECT_TRUE(std::filesystem::exists(folder.path("seen/000006_slam.png")));
}

// Raw images with distortion of a rotated rig whose names are time stamps: the first decimetre of a walk.
TEST(CliSlamFiles, ARawRoomToTheCamerasPath) {
  const Folder folder;
  const std::string room = folder.path("room");
  ASSERT_EQ(pharos("sim stereo --scene room --path-m 0.14 --output " + room).exit_code, 0);
  const Outcome path =
      pharos("slam " + room + "/left " + room + "/right --rig " + room + "/rig.toml --scene static --output camera");
  ASSERT_EQ(path.exit_code, 0) << path.err;
  EXPECT_THAT(path.out, testing::StartsWith("1400000000.0 "));
  EXPECT_THAT(path.out, HasSubstr("\n1400000000.05 "));
  const Outcome evaluated = pharos("evaluate " + folder.write("path.tum", path.out) + " " + room + "/truth.tum");
  EXPECT_EQ(figure(evaluated, "compared"), 4.0);
  EXPECT_LT(figure(evaluated, "pos_max_mm"), 10.0);
  EXPECT_LT(figure(evaluated, "rot_max_deg"), 0.2);
}

}  // namespace
}  // namespace pharos::cli_test
