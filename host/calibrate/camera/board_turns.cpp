// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/board_turns.hpp"

#include <cmath>
#include <limits>

#include "pharos/geometry/rotation.hpp"

namespace pharos::calibrate {
namespace {

// The board's point at the place of `index` after one turn: by half, or by a quarter.
std::size_t partner(const Board& board, std::size_t index) {
  const int column = board.column_of(index), row = board.row_of(index);
  if (turns_of(board) == 2) return board.index(board.columns - 1 - column, board.rows - 1 - row);
  return board.index(board.columns - 1 - row, column);
}

// A board's pose from those of three of its points: the turn is a rigid motion of the board in itself.
Pose<frame::Board, frame::Board> turn_of(const Board& board) {
  const Vector3 origin = board.point_m(partner(board, 0));
  const Vector3 x = (board.point_m(partner(board, board.index(1, 0))) - origin).normalized();
  const Vector3 y = (board.point_m(partner(board, board.index(0, 1))) - origin).normalized();
  Pose<frame::Board, frame::Board> turn;
  turn.R << x, y, x.cross(y);
  turn.t = origin;
  return turn;
}

// Difference of two rigs: an angle, and a shift over the boards' distance.
double difference(const LeftFromRight& a, const LeftFromRight& b, double distance_m) {
  return rotation_angle_between(a.R, b.R) + (a.t - b.t).norm() / distance_m;
}

}  // namespace

int turns_of(const Board& board) { return board.columns == board.rows ? 4 : 2; }

FoundBoard turned(const FoundBoard& found, const Board& board, int turns) {
  FoundBoard result = found;
  for (int turn = 0; turn < turns; ++turn) {
    const FoundBoard before = result;
    for (std::size_t i = 0; i < board.size(); ++i) result.points[i] = before.points[partner(board, i)];
  }
  return result;
}

CameraFromBoard turned(const CameraFromBoard& T_camera_board, const Board& board, int turns) {
  CameraFromBoard result = T_camera_board;
  for (int turn = 0; turn < turns; ++turn) result = result * turn_of(board);
  return result;
}

std::vector<int> matching_turns(const std::vector<CameraFromBoard>& left, const std::vector<CameraFromBoard>& right,
                                const Board& board) {
  const auto rig_of = [&](std::size_t view, int turns) {
    return left[view] * turned(right[view], board, turns).inverse();
  };
  std::vector<int> best;
  double minimum = std::numeric_limits<double>::infinity();
  for (int first = 0; first < turns_of(board); ++first) {
    const LeftFromRight rig = rig_of(0, first);
    std::vector<int> turns;
    double sum = 0.0;
    for (std::size_t view = 0; view < left.size(); ++view) {
      double nearest = std::numeric_limits<double>::infinity();
      int turn_here = 0;
      for (int turn = 0; turn < turns_of(board); ++turn) {
        const double apart = difference(rig_of(view, turn), rig, left[view].t.norm());
        if (apart < nearest) {
          nearest = apart;
          turn_here = turn;
        }
      }
      turns.push_back(turn_here);
      sum += nearest;
    }
    if (sum < minimum) {
      minimum = sum;
      best = turns;
    }
  }
  return best;
}

}  // namespace pharos::calibrate
