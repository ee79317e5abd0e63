// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/integration/cli/program.hpp"
#include "tools/evaluation/problems/ring_images.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// A ring of known ellipses as a PGM of 16 bits.
struct RingFile {
  explicit RingFile(const Folder& folder) {
    const test::PaintedCamera camera{320, 240, 304.0};
    const test::Vec3 centre{0.1, -0.1, 4.0}, normal{0.0, std::sin(0.5), -std::cos(0.5)};
    test::PaintedScene scene(camera, 0.05);
    const test::Disc outer{centre, normal, 0.55}, inner{centre, normal, 0.48};
    scene.add({outer, 0.7});
    scene.add({inner, 0.2});
    truth = outer.outline(camera);
    std::mt19937_64 random(1);
    std::string file = "P5\n320 240\n65535\n";
    for (const std::uint16_t value : scene.image({}, random)) {
      file.push_back(static_cast<char>(value >> 8));
      file.push_back(static_cast<char>(value & 0xFF));
    }
    bytes = file;
    path = folder.write("ring.pgm", file);
  }
  test::TrueEllipse truth;
  std::string bytes, path;
};

TEST(CliEllipses, RowsAreThoseOfTheRing) {
  const Folder folder;
  const RingFile ring(folder);
  const Outcome run = pharos("ellipses " + ring.path + " --time 2");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("image,cx_px,cy_px,a_px,b_px,theta_rad,score"));
  EXPECT_THAT(run.err, AllOf(HasSubstr("median"), HasSubstr("ms")));
  const auto rows = rows_of(run.out);
  ASSERT_EQ(rows.size(), 2U);
  const Row& outer = std::stod(rows[0].at("a_px")) > std::stod(rows[1].at("a_px")) ? rows[0] : rows[1];
  EXPECT_EQ(outer.at("image"), ring.path);
  EXPECT_NEAR(std::stod(outer.at("cx_px")), ring.truth.cx_px, 0.1);
  EXPECT_NEAR(std::stod(outer.at("a_px")), ring.truth.a_px, 0.1);
  EXPECT_NEAR(std::stod(outer.at("b_px")), ring.truth.b_px, 0.1);
  EXPECT_EQ(outer.at("bright_inside"), "1");
}

TEST(CliEllipses, StandardInputAndJson) {
  const Folder folder;
  const RingFile ring(folder);
  const Outcome run = pharos("ellipses - --json", ring.bytes);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(count_lines(run.out), 2U);
  EXPECT_THAT(run.out, HasSubstr("\"cx_px\""));
}

TEST(CliEllipses, DrawsAPicture) {
  const Folder folder;
  const RingFile ring(folder);
  const std::string picture = folder.path("found.png");
  EXPECT_EQ(pharos("ellipses " + ring.path + " --overlay " + picture).exit_code, 0);
  EXPECT_THAT(content_of(picture), StartsWith("\x89PNG"));
  const Outcome two = pharos("ellipses " + ring.path + " " + ring.path + " --overlay " + picture);
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_THAT(two.err, HasSubstr("one image"));
  EXPECT_EQ(pharos("ellipses " + ring.path + " --overlay /nowhere/x.png").exit_code, 2);
  // The overlay is in colour: no input.
  const Outcome colour = pharos("ellipses " + picture);
  EXPECT_EQ(colour.exit_code, 2);
  EXPECT_THAT(colour.err, HasSubstr("in colour"));
}

TEST(CliEllipses, AnImageWithoutAnyIsAnswerNone) {
  const Folder folder;
  const std::string dark = folder.write("dark.pgm", "P5\n16 16\n255\n" + std::string(256, '\x10'));
  const std::string one = folder.write("one.pgm", "P5\n1 1\n255\nx");
  const Outcome run = pharos("ellipses " + dark + " " + one);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(count_lines(run.out), 1U);  // the header
  EXPECT_THAT(run.err, AllOf(HasSubstr("dark.pgm: no ellipse"), HasSubstr("1 x 1 pixels are too few")));
}

TEST(CliEllipses, UnreadableImagesAreWrongUsage) {
  const Folder folder;
  for (const std::string& content : {std::string(), std::string("no image"), std::string("P5\n9 9\n255\nshort"),
                                     std::string("P5\n32000 32000\n255\n"), std::string("\x89PNG\r\n\x1a\nxx")}) {
    const std::string path = folder.write("bad.png", content);
    const Outcome run = pharos("ellipses " + path);
    EXPECT_EQ(run.exit_code, 2) << content;
    EXPECT_THAT(run.err, HasSubstr("bad.png")) << content;
    EXPECT_EQ(count_lines(run.err), 1U) << run.err;
  }
  EXPECT_EQ(pharos("ellipses " + folder.path("missing.png")).exit_code, 2);
  EXPECT_EQ(pharos("ellipses").exit_code, 2);
  EXPECT_EQ(pharos("ellipses x.png --min-score nan").exit_code, 2);
}

}  // namespace
}  // namespace pharos::cli_test
