// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "host/images/picture.hpp"
#include "tests/integration/cli/program.hpp"

namespace pharos::cli_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// A dark target of stripes on black, as a PGM or PPM of 8 bits.
std::string dark_image(bool colour, int brightest = 25) {
  std::string file = colour ? "P6\n96 64\n255\n" : "P5\n96 64\n255\n";
  for (int v = 0; v < 64; ++v) {
    for (int u = 0; u < 96; ++u) {
      const bool target = u > 20 && u < 76 && v > 10 && v < 54;
      const int value = target ? (u / 6 % 2 == 0 ? brightest : brightest / 3) : 0;
      for (int c = 0; c < (colour ? 3 : 1); ++c) file.push_back(static_cast<char>(value >> c));
    }
  }
  return file;
}

double mean_of(const host::Picture& picture) {
  double sum = 0.0;
  for (const std::uint16_t value : picture.values) sum += value / 65535.0;
  return sum / static_cast<double>(picture.values.size());
}

TEST(CliEnhance, WritesABrighterImageAndEveryStep) {
  const Folder folder;
  const std::string in = folder.write("dark.ppm", dark_image(true)), out = folder.path("bright.png");
  const Outcome run =
      pharos("enhance " + in + " " + out + " --illumination " + folder.path("l.png") + " --reflectance " +
             folder.path("r.png") + " --max-rgb " + folder.path("m.png") + " --refined " + folder.path("f.png") +
             " --denoised " + folder.path("d.png") + " --report - --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("\"status\":\"ok\""), HasSubstr("\"noise_sigma\":"), HasSubstr("\"channels\":3")));
  const host::Picture bright = host::read_picture(out), dark = host::read_picture(in);
  EXPECT_EQ(bright.channels, 3);
  EXPECT_EQ(bright.bits, 8);
  EXPECT_GT(mean_of(bright), 4.0 * mean_of(dark));
  for (const char* step : {"l.png", "m.png", "f.png"}) {
    EXPECT_EQ(host::read_picture(folder.path(step)).channels, 1) << step;
    EXPECT_EQ(host::read_picture(folder.path(step)).bits, 16) << step;
  }
  for (const char* step : {"r.png", "d.png"}) EXPECT_EQ(host::read_picture(folder.path(step)).channels, 3) << step;
}

// (1) and (8) from the files, of a frame so dark that R is above white before it is scaled.
TEST(CliEnhance, TheStepsMakeTheImage) {
  const Folder folder;
  const std::string in = folder.write("dark.pgm", dark_image(false, 6)), out = folder.path("bright.png");
  const Outcome run =
      pharos("enhance " + in + " " + out + " --illumination " + folder.path("l.png") + " --reflectance " +
             folder.path("r.png") + " --denoised " + folder.path("d.png") + " --report -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const double peak = std::stod(rows_of(run.out).at(0).at("reflectance_peak"));
  EXPECT_GT(peak, 1.2);
  const host::Picture dark = host::read_picture(in), bright = host::read_picture(out),
                      light = host::read_picture(folder.path("l.png")), r = host::read_picture(folder.path("r.png")),
                      quiet = host::read_picture(folder.path("d.png"));
  std::size_t white = 0;
  for (std::size_t k = 0; k < bright.values.size(); ++k) {
    const double L = light.values[k] / 65535.0, R = r.values[k] / 65535.0, R_d = quiet.values[k] / 65535.0;
    ASSERT_NEAR(bright.values[k] / 65535.0, R * L + R_d * (1.0 - L), 0.51 / 255.0) << k;
    white += r.values[k] == 65535 ? 1U : 0U;
    if (r.values[k] == 65535) continue;
    ASSERT_NEAR(dark.values[k] / 65535.0, R * L * peak, 2e-4) << k;
  }
  EXPECT_LT(white, bright.values.size() / 10);
}

TEST(CliEnhance, StandardInputToStandardOutput) {
  const Folder folder;
  const std::string file = folder.path("dark.pgm");
  const Outcome run = pharos("enhance - - --denoiser fast", dark_image(false));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::uint8_t> bytes(run.out.begin(), run.out.end());
  const host::Picture bright = host::decode_picture(bytes, "standard output");
  EXPECT_EQ(bright.channels, 1);
  EXPECT_EQ(bright.width_px, 96);
}

TEST(CliEnhance, AFolderIsAVideo) {
  const Folder folder;
  std::filesystem::create_directory(folder.path("in"));
  folder.write("in/0001.pgm", dark_image(false, 25));
  folder.write("in/0002.pgm", dark_image(false, 26));
  folder.write("in/0003.pgm", "P5\n96 64\n255\nshort");
  folder.write("in/0004.pgm", dark_image(false, 0));
  const Outcome run = pharos("enhance " + folder.path("in") + " " + folder.path("out") + " --denoiser none --report -");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto rows = rows_of(run.out);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_LT(std::stoi(rows[1].at("iterations")), std::stoi(rows[0].at("iterations")));
  EXPECT_EQ(rows[2].at("status"), "refused_unreadable");
  EXPECT_EQ(rows[2].at("mean_out"), "");
  EXPECT_EQ(rows[3].at("status"), "refused_black");
  EXPECT_TRUE(std::filesystem::exists(folder.path("out/0002.png")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("out/0003.png")));
}

TEST(CliEnhance, AFolderOfNothingReadableIsWrongInput) {
  const Folder folder;
  std::filesystem::create_directory(folder.path("in"));
  folder.write("in/a.tif", std::string("II*\0", 4));
  folder.write("in/b.bmp", "BM");
  const Outcome run = pharos("enhance " + folder.path("in") + " " + folder.path("out") + " --report -");
  EXPECT_EQ(run.exit_code, 2);
  ASSERT_EQ(rows_of(run.out).size(), 2U);
  EXPECT_EQ(rows_of(run.out)[0].at("status"), "refused_unreadable");
  EXPECT_THAT(run.err, AllOf(HasSubstr("a.tif: damaged TIFF"), HasSubstr("2 of 2 images could not be used")));
}

TEST(CliEnhance, BadInputIsReportedInOneLine) {
  const Folder folder;
  const std::string out = " " + folder.path("out.png");
  const auto refused = [&](const std::string& arguments, int code, const std::string& why) {
    const Outcome run = pharos("enhance " + arguments);
    EXPECT_EQ(run.exit_code, code) << arguments;
    EXPECT_THAT(run.err, HasSubstr(why)) << arguments;
    EXPECT_EQ(count_lines(run.err), 1U) << run.err;
  };
  refused(folder.write("black.pgm", dark_image(false, 0)) + out, 1, "black");
  refused(folder.write("white.pgm", "P5\n1 1\n255\n\xFF") + out, 1, "white");
  refused(folder.write("text.png", "not an image") + out, 2, "no PNG");
  refused(folder.write("cut.pgm", dark_image(false).substr(0, 3000)) + out, 2, "less data");
  refused(folder.write("claim.pgm", "P5\n60000 60000\n255\n") + out, 2, "claims");
  refused(folder.path("nowhere.png") + out, 2, "cannot be read");
  const std::string good = folder.write("good.pgm", dark_image(false));
  refused(good + " /nowhere/out.png", 2, "cannot be written");
  refused(good + out + " --alpha nan", 2, "--alpha");
  refused(good + out + " --denoise-only --illumination " + folder.path("l.png"), 2, "--denoise-only");
}

TEST(CliEnhance, DenoisesAlone) {
  const Folder folder;
  std::string noisy = "P5\n64 64\n255\n";
  std::mt19937 random(1);
  std::normal_distribution<double> noise(120.0, 12.0);
  for (int k = 0; k < 64 * 64; ++k) noisy.push_back(static_cast<char>(noise(random)));
  const std::string out = folder.path("quiet.png");
  ASSERT_EQ(pharos("enhance " + folder.write("noisy.pgm", noisy) + " " + out + " --denoise-only --noise 12").exit_code,
            0);
  double mean = 0.0, square = 0.0;
  const host::Picture quiet = host::read_picture(out);
  for (const std::uint16_t value : quiet.values) mean += value / 257.0 / 4096.0;
  for (const std::uint16_t value : quiet.values) square += (value / 257.0 - mean) * (value / 257.0 - mean) / 4096.0;
  EXPECT_NEAR(mean, 120.0, 1.0);
  EXPECT_LT(std::sqrt(square), 4.0);  // 12 before
}

}  // namespace
}  // namespace pharos::cli_test
