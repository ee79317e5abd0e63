// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/board_image.hpp"

#include <gtest/gtest.h>

#include "board_truth.hpp"

namespace pharos::calibrate {
namespace {

TEST(BoardImage, ADotsCentroidIsThatOfItsWholeImageAndNotOfItsCentre) {
  const Board board;
  const CameraFromBoard T = sim::board_at({}, {0.03, 0.02, 0.25}, {0.5, -0.5, 0.0});
  const PinholeCamera camera = camera_of(sim::kPaperLens);
  double largest = 0.0, bias = 0.0;
  for (std::size_t i = 0; i < board.size(); ++i) {
    const Vector2 seen = project_board_point(camera, T, board, i).pixel;
    largest = std::max(largest, (seen - true_centroid(sim::kPaperLens, T, board, i)).norm());
    bias = std::max(bias, (seen - distort(camera, (T * board.point_m(i)).hnormalized())).norm());
  }
  EXPECT_LT(largest, 1e-3);
  EXPECT_GT(bias, 0.1);
}

TEST(BoardImage, ACornerIsSeenWhereItProjects) {
  Board board;
  board.kind = BoardKind::kChessboard;
  const CameraFromBoard T = sim::board_at({}, {0.0, 0.0, 0.5}, {0.3, 0.2, 0.0});
  const PinholeCamera camera = camera_of(sim::kPaperLens);
  EXPECT_EQ(project_board_point(camera, T, board, 17).pixel, distort(camera, (T * board.point_m(17)).hnormalized()));
}

}  // namespace
}  // namespace pharos::calibrate
