// SPDX-License-Identifier: Apache-2.0
// pharos calibrate camera: images of a board to a camera file.
#include <CLI/CLI.hpp>

#include "host/calibrate/camera/camera_calibration.hpp"
#include "host/cameras/camera_file.hpp"
#include "tools/calibrate/add_calibrate.hpp"
#include "tools/calibrate/board_options.hpp"
#include "tools/calibrate/board_pictures.hpp"
#include "tools/calibrate/board_reports.hpp"
#include "tools/calibrate/printf_text.hpp"
#include "tools/calibrate/text_file.hpp"
#include "tools/support/commands.hpp"
#include "tools/support/output_place.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

constexpr const char* kCameraExample =
    "Example:\n"
    "  pharos calibrate camera board*.png --board dots --columns 12 --rows 8 --pitch-mm 20 --radius-mm 5 --output "
    "camera.toml\n"
    "  pharos calibrate camera board*.png --board chessboard --columns 9 --rows 6 --pitch-mm 25 --output camera.toml\n"
    "PNG, TIFF, PGM or PPM of 8 or 16 bits, JPEG or BMP, all of one size. Show the whole board in each, in ten or more "
    "poses: all over "
    "the\n"
    "image, near and far, tilted by 20 to 40 degrees each way. On standard output: parameter,value,sigma. Exit code 1\n"
    "where the images cannot tell a camera; standard error says what became of each and what is missing.";

struct CameraOptions {
  BoardOptions board;
  std::vector<std::string> images;
  std::string points;
};

void write_outputs(const CameraOptions& options, const calibrate::CalibrationChoices& choices,
                   const BoardPictures& pictures, const calibrate::CameraCalibration& result) {
  if (!options.board.images.empty()) write_image_statuses(result.images, {options.board.json, options.board.images});
  if (!options.points.empty()) write_board_points(result, choices.board, {options.board.json, options.points});
  if (options.board.overlay.empty()) return;
  const PinholeCamera* camera = result.outcome ? &result.camera() : nullptr;
  const std::vector<calibrate::CameraFromBoard> none;
  write_board_overlays(options.board.overlay, "", pictures, result.images, choices.board, camera,
                       result.outcome ? result.outcome->state.T_camera_board : none);
}

int run_camera(const CameraOptions& options) {
  const calibrate::CalibrationChoices choices = choices_of(options.board);
  if (options.board.output != "-") require_writable(options.board.output);
  if (!options.points.empty()) require_writable(options.points);
  ImageInput input;
  const BoardPictures pictures(options.images, input);
  if (input.nothing_read()) return input.finish(false);
  calibrate::CameraCalibration result;
  {
    Progress progress("looking for boards", "images", options.images.size());
    result = calibrate::calibrate_camera(pictures.pictures(), choices, [&] { progress.step(); });
  }
  note_images(result.images);
  write_outputs(options, choices, pictures, result);
  if (!result.refusal.empty()) {
    note("no camera: " + result.refusal);
    return input.finish(false);
  }
  const calibrate::BundleOutcome& outcome = *result.outcome;
  note_fit(outcome, result.images, choices.board);
  note(printf_text("OpenCV's own adjustment to the same points: rms %.4f px", result.opencv_rms_px));
  note_coverage(result.coverage, "");
  for (const std::string& unobservable : result.unobservable) note("not told: " + unobservable);
  host::CameraFile file;
  file.camera.intrinsics = result.camera();
  file.calibration =
      record_of(outcome, outcome.state.T_camera_board.size() * choices.board.size(), result.unobservable);
  write_text_file(options.board.output, "# Written by `pharos calibrate camera`.\n" + host::camera_text(file));
  if (options.board.output != "-") write_board_parameters(outcome, {options.board.json, "-"});
  return input.finish(true);
}

}  // namespace

void add_calibrate_camera(CLI::App& calibrate, int& exit_code) {
  CLI::App* command =
      calibrate.add_subcommand("camera", "A camera's intrinsics and distortion from images of a calibration board");
  const auto options = std::make_shared<CameraOptions>();
  command->add_option("IMAGE", options->images, "Images of the board")->required();
  add_board_options(*command, options->board);
  command
      ->add_option("--points", options->points,
                   "File for each point and its residual (a table, for `pharos plot calibration`)")
      ->check(output_place());
  command->footer(kCameraExample);
  command->callback([options, &exit_code] { exit_code = run_camera(*options); });
}

}  // namespace pharos::tools
