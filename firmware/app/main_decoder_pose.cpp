// SPDX-License-Identifier: Apache-2.0
// The build `decoder_pose`: sweeps, OOTX payloads and on-board poses of the target that target_table() describes. The
// program runs from the timer's interrupt, the solver in the main loop.
#include "firmware/app/pose_task.hpp"
#include "firmware/app/program.hpp"
#include "firmware/app/target_table.hpp"
#include "firmware/hal/board.hpp"

namespace {

// Its memory is free again before the first pose.
[[gnu::noinline]] pharos::Target target() {
  pharos::Target placements;
  for (const auto& row : pharos::app::target_table()) {
    pharos::SensorPlacement placement;
    placement.sensor = row.sensor;
    placement.position_m = {row.position_m[0], row.position_m[1], row.position_m[2]};
    placement.normal = {row.normal[0], row.normal[1], row.normal[2]};
    placements.push_back(placement);
  }
  return placements;
}

[[gnu::noinline]] pharos::app::PoseTask& start_poses(const pharos::hal::Board& board) {
  static pharos::app::PoseTask poses(board.system, target());
  return poses;
}

}  // namespace

int main() {
  static const pharos::hal::Board board = pharos::hal::start_board();
  pharos::app::PoseTask& poses = start_poses(board);
  static pharos::app::Program program(board, &poses);
  pharos::hal::call_every_millisecond([](void* context) { static_cast<pharos::app::Program*>(context)->poll(); },
                                      &program);
  for (;;) {
    if (!poses.solve()) pharos::hal::wait_for_event();
  }
}
