// SPDX-License-Identifier: Apache-2.0
// pharos calibrate stereo: pairs of images of a board to a rig file.
#include <CLI/CLI.hpp>

#include "host/calibrate/camera/rig_calibration.hpp"
#include "host/cameras/pair_order.hpp"
#include "host/cameras/rig_file.hpp"
#include "host/support/input_error.hpp"
#include "pharos/geometry/rotation.hpp"
#include "tools/calibrate/add_calibrate.hpp"
#include "tools/calibrate/board_options.hpp"
#include "tools/calibrate/board_pictures.hpp"
#include "tools/calibrate/board_reports.hpp"
#include "tools/calibrate/printf_text.hpp"
#include "tools/calibrate/text_file.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kStereoExample =
    "Example:\n"
    "  pharos calibrate stereo --left left*.png --right right*.png --board chessboard --columns 9 --rows 6 --pitch-mm "
    "25 "
    "--output rig.toml\n"
    "The n-th left and the n-th right image show the board at the same moment. The rig's frame is the left camera's. "
    "On\n"
    "standard output: parameter,value,sigma; the right camera's rotation vector and position are in the left camera's\n"
    "frame. Images as for `pharos calibrate camera`.";

struct StereoOptions {
  BoardOptions board;
  std::vector<std::string> left;
  std::vector<std::string> right;
};

std::vector<calibrate::ImageOutcome> both(const calibrate::RigCalibration& result) {
  std::vector<calibrate::ImageOutcome> images = result.images[0];
  images.insert(images.end(), result.images[1].begin(), result.images[1].end());
  return images;
}

host::RigFile file_of(const calibrate::RigCalibration& result, const calibrate::Board& board) {
  const calibrate::BundleState& state = result.outcome->state;
  const Quaternion q = canonical_quaternion(state.T_left_right.R);
  const Vector3& t = state.T_left_right.t;
  host::RigFile file;
  file.left.intrinsics = state.cameras[0];
  file.right = {state.cameras[1], {q.w(), q.x(), q.y(), q.z()}, {t.x(), t.y(), t.z()}};
  file.calibration = record_of(*result.outcome, 2 * result.pairs * board.size(), result.unobservable);
  return file;
}

// Left images only with the left camera's own poses; the right camera's follow from the rig.
void write_overlays(const StereoOptions& options, const calibrate::Board& board,
                    const std::array<const BoardPictures*, 2>& pictures, const calibrate::RigCalibration& result) {
  for (std::size_t side = 0; side < 2; ++side) {
    write_board_overlays(options.board.overlay, side == 0 ? "left_" : "right_", *pictures[side], result.images[side],
                         board, nullptr, {});
  }
}

// Two images of one pair that are the same picture, or cameras that stand the other way round.
host::PairFault fault_of(const BoardPictures& left, const BoardPictures& right) {
  for (std::size_t i = 0; i < left.pictures().size(); ++i) {
    const host::PairFault fault = host::pair_fault({left.pictures()[i].image, right.pictures()[i].image});
    if (fault != host::PairFault::kNone) return fault;
  }
  return host::PairFault::kNone;
}

host::PairFault fault_of(const calibrate::RigCalibration& result) {
  const Vector3& t_left_right = result.outcome->state.T_left_right.t;
  return host::pair_fault({t_left_right.x(), t_left_right.y(), t_left_right.z()});
}

int run_stereo(const StereoOptions& options) {
  if (options.left.size() != options.right.size()) {
    throw host::InputError(std::to_string(options.left.size()) + " left and " + std::to_string(options.right.size()) +
                           " right images are no pairs; give as many, in one order");
  }
  const calibrate::CalibrationChoices choices = choices_of(options.board);
  if (options.board.output != "-") require_writable(options.board.output);
  ImageInput input;
  const BoardPictures left(options.left, input), right(options.right, input);
  if (input.nothing_read()) return input.finish(false);
  const auto refuse = [&input](const std::string& why) {
    note("no rig: " + why);
    return input.finish(false);
  };
  if (const auto fault = fault_of(left, right); fault != host::PairFault::kNone) return refuse(text_of(fault));
  calibrate::RigCalibration result;
  {
    Progress progress("looking for boards", "images", 2 * options.left.size());
    result = calibrate::calibrate_rig(left.pictures(), right.pictures(), choices, [&] { progress.step(); });
  }
  const std::vector<calibrate::ImageOutcome> images = both(result);
  note_images(images);
  if (!options.board.images.empty()) write_image_statuses(images, {options.board.json, options.board.images});
  if (!options.board.overlay.empty()) write_overlays(options, choices.board, {&left, &right}, result);
  if (!result.refusal.empty()) return refuse(result.refusal);
  if (const auto fault = fault_of(result); fault != host::PairFault::kNone) return refuse(text_of(fault));
  note_fit(*result.outcome, images, choices.board);
  note(printf_text("epipolar rms %.4f px from %zu pairs", result.epipolar_rms_px, result.pairs));
  note(printf_text("OpenCV's own adjustment to the same points: rms %.4f px, epipolar rms %.4f px",
                   result.opencv_rms_px, result.opencv_epipolar_rms_px));
  note_coverage(result.coverage[0], "left ");
  note_coverage(result.coverage[1], "right ");
  for (const std::string& unobservable : result.unobservable) note("not told: " + unobservable);
  write_text_file(options.board.output,
                  "# Written by `pharos calibrate stereo`.\n" + host::rig_text(file_of(result, choices.board)));
  if (options.board.output != "-") write_board_parameters(*result.outcome, {options.board.json, "-"});
  return input.finish(true);
}

}  // namespace

void add_calibrate_stereo(CLI::App& calibrate, int& exit_code) {
  CLI::App* command =
      calibrate.add_subcommand("stereo", "Two cameras and the pose between them from pairs of images of a board");
  const auto options = std::make_shared<StereoOptions>();
  command->add_option("--left", options->left, "Images of the left camera")->required();
  command->add_option("--right", options->right, "Images of the right camera, in the same order")->required();
  add_board_options(*command, options->board);
  command->footer(kStereoExample);
  command->callback([options, &exit_code] { exit_code = run_stereo(*options); });
}

}  // namespace pharos::tools
