// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/find_dots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "board_truth.hpp"

namespace pharos::calibrate {
namespace {

const sim::BoardRenderer& renderer() {
  static const sim::BoardRenderer renderer(sim::kPaperLens);
  return renderer;
}

// At the centre of the image, 0.4 m away: dots of 7.6 px radius.
CameraFromBoard in_the_middle(const sim::BoardSheet& sheet) {
  return sim::board_at(sheet, {0.0, 0.0, 0.4}, {0.3, -0.4, 0.0}, 0.1);
}

BoardSearch search(const sim::BoardSheet& sheet, const CameraFromBoard& T, const sim::Exposure& exposure,
                   const Board& board = {}) {
  return find_dots(renderer().render(sheet, T, exposure, 1).view(), board);
}

TEST(FindDots, CentresAreNearTheNoiseBoundAndTheirSigmasAreTrue) {
  const sim::BoardSheet sheet;
  const Board board;
  sim::Exposure exposure;
  exposure.noise = 280.0;
  const double blur = std::sqrt(exposure.blur_px * exposure.blur_px + 1.0 / 12.0);
  const double noise = exposure.noise / (exposure.bright - exposure.dark);
  double squares = 0.0, pulls = 0.0, bound = 0.0, count = 0.0;
  for (const double tilt : {-0.4, 0.1, 0.5}) {
    const CameraFromBoard T = sim::board_at(sheet, {0.0, 0.0, 0.4}, {0.3, tilt, 0.0}, 0.1);
    const BoardSearch found = search(sheet, T, exposure);
    ASSERT_EQ(found.status, ImageStatus::kUsed) << found.detail;
    for (std::size_t i = 0; i < board.size(); ++i) {
      const FoundPoint& point = found.board.points[i];
      const double error = (point.pixel - true_centroid(sim::kPaperLens, T, board, i)).squaredNorm();
      const double radius = std::sqrt(point.area_px2 / std::numbers::pi);
      squares += error;
      pulls += error / (2.0 * point.sigma_px * point.sigma_px);
      bound += 2.0 * 2.0 * noise * noise * blur / (std::sqrt(std::numbers::pi) * radius);
      count += 1.0;
    }
  }
  // The bound assumes known brightness, shape and blur, which the fit estimates.
  EXPECT_LT(std::sqrt(squares / bound), 1.5);
  EXPECT_NEAR(std::sqrt(pulls / count), 1.0, 0.12);
}

TEST(FindDots, FindsDarkDotsOnABrightSheetInEightBitsUnderUnevenLight) {
  const sim::BoardSheet sheet;
  sim::Exposure exposure{200.0, 40.0, 20.0, 0.6, 1.5, 0.5, 8};
  const CameraFromBoard T = in_the_middle(sheet);
  const BoardSearch found = search(sheet, T, exposure);
  ASSERT_EQ(found.status, ImageStatus::kUsed) << found.detail;
  for (std::size_t i = 0; i < found.board.points.size(); ++i) {
    EXPECT_LT((found.board.points[i].pixel - true_centroid(sim::kPaperLens, T, Board{}, i)).norm(), 0.1);
  }
}

// One threshold for the image, as paper 000 has it: the same dots and centres while the board is alone in even light.
TEST(FindDots, ByOtsuAreTheSameDotsWhileNothingElseIsBright) {
  const sim::BoardSheet sheet;
  host::GreyImage image = renderer().render(sheet, in_the_middle(sheet), {}, 1);
  const BoardSearch local = find_dots(image.view(), {}), otsu = find_dots(image.view(), {}, DotThreshold::kOtsu);
  ASSERT_EQ(local.status, ImageStatus::kUsed) << local.detail;
  ASSERT_EQ(otsu.status, ImageStatus::kUsed) << otsu.detail;
  for (std::size_t i = 0; i < local.board.points.size(); ++i) {
    EXPECT_LT((local.board.points[i].pixel - otsu.board.points[i].pixel).norm(), 0.01);
  }
  // A wall in the sun beside the board, twenty times as bright.
  for (std::size_t v = 0; v < static_cast<std::size_t>(image.height_px); ++v) {
    for (std::size_t u = 0; u < static_cast<std::size_t>(image.width_px); ++u) {
      std::uint16_t& pixel = image.pixels[v * static_cast<std::size_t>(image.width_px) + u];
      pixel = u < 40 ? std::uint16_t{60000} : static_cast<std::uint16_t>(pixel / 20);
    }
  }
  EXPECT_EQ(find_dots(image.view(), {}).status, ImageStatus::kUsed);
  EXPECT_EQ(find_dots(image.view(), {}, DotThreshold::kOtsu).status, ImageStatus::kNoBoard);
}

TEST(FindDots, NamesTheDotThatIsMissing) {
  sim::BoardSheet sheet;
  sheet.missing = 4 * sheet.columns + 2;
  const BoardSearch found = search(sheet, in_the_middle(sheet), {});
  EXPECT_EQ(found.status, ImageStatus::kIncomplete);
  EXPECT_EQ(found.detail, "the dot in column 3, row 5 as seen is missing");
}

TEST(FindDots, SaysThatABoardIsPartlyOutside) {
  const sim::BoardSheet sheet;
  const BoardSearch found = search(sheet, sim::board_at(sheet, {0.12, 0.0, 0.4}, {0.2, 0.0, 0.0}), {});
  EXPECT_EQ(found.status, ImageStatus::kPartlyOutside) << found.detail;
}

TEST(FindDots, SaysThatAnImageIsBlurred) {
  const sim::BoardSheet sheet;
  sim::Exposure exposure;
  exposure.blur_px = 5.5;
  EXPECT_EQ(search(sheet, in_the_middle(sheet), exposure).status, ImageStatus::kBlurred);
}

TEST(FindDots, SaysThatDotsAreTooSmall) {
  const sim::BoardSheet sheet;
  EXPECT_EQ(search(sheet, sim::board_at(sheet, {0.0, 0.0, 1.5}, {0.0, 0.6, 0.0}), {}).status, ImageStatus::kTooSmall);
}

TEST(FindDots, RefusesABoardWithOtherNumbersOfDots) {
  const sim::BoardSheet sheet;
  Board small;
  small.columns = 10;
  EXPECT_EQ(search(sheet, in_the_middle(sheet), {}, small).status, ImageStatus::kTooMany);
  Board large;
  large.columns = 14;
  EXPECT_EQ(search(sheet, in_the_middle(sheet), {}, large).status, ImageStatus::kIncomplete);
}

TEST(FindDots, FindsNoBoardInNoiseBlackOrWhite) {
  std::vector<std::uint16_t> pixels(320 * 240, 0);
  const GreyView view(pixels.data(), 320, 240);
  EXPECT_EQ(find_dots(view, {}).status, ImageStatus::kNoBoard);
  std::fill(pixels.begin(), pixels.end(), std::uint16_t{65535});
  EXPECT_EQ(find_dots(view, {}).status, ImageStatus::kNoBoard);
  std::uint32_t state = 1;
  for (std::uint16_t& pixel : pixels)
    pixel = static_cast<std::uint16_t>((state = state * 1664525U + 1013904223U) >> 16);
  EXPECT_EQ(find_dots(view, {}).status, ImageStatus::kNoBoard);
}

}  // namespace
}  // namespace pharos::calibrate
