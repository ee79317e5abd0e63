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

// A ring with known ellipses as a PGM of 16 bits.
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
  // The overlay is in colour: its luma contains the ring and the drawing.
  const Outcome colour = pharos("ellipses " + picture);
  EXPECT_EQ(colour.exit_code, 0);
  EXPECT_THAT(colour.err, HasSubstr("in colour"));
}

// The ring's upper 8 bits as a BMP and a TIFF, grey, and as a PPM whose blue is darker.
std::vector<std::string> other_formats(const Folder& folder, const std::string& pgm) {
  const std::size_t pixels = std::size_t{320} * 240, head = pgm.size() - 2 * pixels;
  std::string grey, ppm = "P6\n320 240\n255\n";
  for (std::size_t k = 0; k < pixels; ++k) {
    const char value = pgm[head + 2 * k];
    grey.push_back(value);
    ppm += {value, value, static_cast<char>(static_cast<unsigned char>(value) / 2)};
  }
  const auto number = [](std::uint32_t value, int bytes) {
    std::string text;
    for (int k = 0; k < bytes; ++k) text.push_back(static_cast<char>(value >> (8 * k)));
    return text;
  };
  std::string bmp = "BM" + number(0, 8) + number(14 + 40 + 1024, 4) + number(40, 4) + number(320, 4) +
                    number(static_cast<std::uint32_t>(-240), 4) + number(1, 2) + number(8, 2) + number(0, 24);
  for (std::uint32_t k = 0; k < 256; ++k) bmp += number(k * 0x010101U, 4);
  std::string tiff = "II" + number(42, 2) + number(8, 4) + number(8, 2);
  const std::uint32_t behind = 8 + 2 + 8 * 12 + 4;
  for (const auto& [tag, value] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{
           {256, 320}, {257, 240}, {258, 8}, {259, 1}, {262, 1}, {273, behind}, {278, 240}, {279, 320 * 240}}) {
    tiff += number(tag, 2) + number(4, 2) + number(1, 4) + number(value, 4);
  }
  tiff += number(0, 4);
  return {folder.write("ring.bmp", bmp + grey), folder.write("ring.tif", tiff + grey), folder.write("ring.ppm", ppm),
          folder.write("again.ppm", ppm)};
}

TEST(CliEllipses, EveryFormatShowsTheRingAndColourIsSaidOnce) {
  const Folder folder;
  const RingFile ring(folder);
  const std::vector<std::string> files = other_formats(folder, ring.bytes);
  std::string images;
  for (const std::string& file : files) images += " " + file;
  const Outcome run = pharos("ellipses" + images);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(count_lines(run.err), 1U) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("ring.ppm: is in colour"), HasSubstr("luma")));
  for (const std::string& file : files) {
    double widest = 0.0;
    for (const Row& row : rows_of(run.out)) {
      if (row.at("image") == file) widest = std::max(widest, std::stod(row.at("a_px")));
    }
    EXPECT_NEAR(widest, ring.truth.a_px, 0.15) << file;
  }
}

TEST(CliEllipses, OneUnreadableImageOfManyIsToldCountedAndLeftOut) {
  const Folder folder;
  const RingFile ring(folder);
  const std::string bad = folder.write("bad.png", "no image");
  const Outcome run = pharos("ellipses " + bad + " " + ring.path);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(rows_of(run.out).size(), 2U);
  EXPECT_THAT(run.err, AllOf(HasSubstr("bad.png: is no PNG"), HasSubstr("1 of 2 images could not be used")));
  const Outcome none = pharos("ellipses " + bad + " " + bad);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(count_lines(none.out), 1U);  // the header
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
