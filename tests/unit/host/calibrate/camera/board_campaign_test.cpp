// SPDX-License-Identifier: Apache-2.0
// Table 1 of paper 000 over several seeds: prints the figures of the README.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tools/calibrate/board_figure.hpp"

namespace pharos::tools {
namespace {

void run(bool dots, double max_rms_px) {
  constexpr int kSets = 5;
  constexpr int kImages = 20;
  double squares = 0.0, count = 0.0;
  for (std::uint64_t seed = 1; seed <= kSets; ++seed) {
    const BoardFigure figure = reproduce_board_calibration(dots, kImages, seed, [] {});
    ASSERT_EQ(figure.refusal, "");
    std::printf("%s set %d: %d images, rms %.4f px, largest error %.2f sigma\n", dots ? "dots" : "chessboard",
                static_cast<int>(seed), figure.images, figure.rms_px, figure.largest_error_sigmas());
    EXPECT_EQ(figure.images, kImages);
    EXPECT_LT(figure.rms_px, max_rms_px);
    for (const BoardFigure::Parameter& parameter : figure.parameters) {
      std::printf("  %-5s truth %10.4f value %10.4f sigma %8.5f error %5.2f sigma\n", parameter.name.c_str(),
                  parameter.truth, parameter.value, parameter.sigma, parameter.error_sigmas());
      EXPECT_LT(std::abs(parameter.error_sigmas()), 4.0);  // one of 40 may be beyond 3
      squares += parameter.error_sigmas() * parameter.error_sigmas();
      count += 1.0;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 1.4);
}

TEST(BoardCampaign, DotsGiveThePapersLensWithinTheirCovariance) { run(true, 0.012); }
TEST(BoardCampaign, ChessboardsDoToo) { run(false, 0.2); }

}  // namespace
}  // namespace pharos::tools
