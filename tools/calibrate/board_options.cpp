// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/board_options.hpp"

#include <CLI/CLI.hpp>

#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "tools/support/number_option.hpp"
#include "tools/support/output_place.hpp"

namespace pharos::tools {
namespace {

constexpr int kMinPoints = 3;  // a column or row
constexpr int kMaxPoints = 100;
// Minimum gap between two dots' edges, over their radius.
constexpr double kMinGap = 0.4;
// Paper 000's board.
constexpr int kPaperColumns = 12;
constexpr int kPaperRows = 8;
constexpr double kPaperPitch_mm = 20.0;

}  // namespace

void add_board_options(CLI::App& command, BoardOptions& options) {
  command.add_option("--board", options.board, "What the board carries: dots or chessboard")
      ->check(CLI::IsMember({"dots", "chessboard"}))
      ->capture_default_str();
  command.add_option("--columns", options.columns, "Dots, or inner corners, in a row (dots: 12)")
      ->check(CLI::Range(kMinPoints, kMaxPoints));
  command.add_option("--rows", options.rows, "Dots, or inner corners, in a column (dots: 8)")
      ->check(CLI::Range(kMinPoints, kMaxPoints));
  command.add_option("--pitch-mm", options.pitch_mm, "From dot to dot, or a square's side (dots: 20)")
      ->check(number_from(0.01, 10000.0));
  command.add_option("--radius-mm", options.radius_mm, "A dot's radius")
      ->check(number_from(0.001, 5000.0))
      ->capture_default_str();
  command
      .add_option("--dot-threshold", options.dot_threshold,
                  "What tells dots from the sheet: local (of each place's surroundings) or otsu (one for the image, as "
                  "paper 000)")
      ->check(CLI::IsMember({"local", "otsu"}))
      ->capture_default_str();
  command.add_flag("--hold-k3", options.fix_k3, "Hold the fifth distortion term at 0");
  command.add_option("-o,--output", options.output, "File to write (TOML); - is standard output")
      ->check(output_place())
      ->required();
  command.add_option("--images", options.images, "File for what became of each image (a table)")->check(output_place());
  command.add_option("--overlay", options.overlay, "Folder for pictures of what was found")->check(output_place());
  command.add_flag("--json", options.json, "Tables as one JSON object a line instead of CSV");
}

calibrate::CalibrationChoices choices_of(const BoardOptions& options) {
  calibrate::CalibrationChoices choices;
  calibrate::Board& board = choices.board;
  const bool dots = options.board == "dots";
  board.kind = dots ? calibrate::BoardKind::kDots : calibrate::BoardKind::kChessboard;
  if (!dots && (options.columns == 0 || options.rows == 0 || options.pitch_mm == 0.0)) {
    throw host::InputError(
        "a chessboard needs --columns, --rows (inner corners) and --pitch-mm (a square's side), such as --columns 9 "
        "--rows 6 --pitch-mm 25");
  }
  board.columns = options.columns != 0 ? options.columns : kPaperColumns;
  board.rows = options.rows != 0 ? options.rows : kPaperRows;
  board.pitch_m = (options.pitch_mm != 0.0 ? options.pitch_mm : kPaperPitch_mm) / kMmPerM;
  board.radius_m = options.radius_mm / kMmPerM;
  if (dots && board.pitch_m < (2.0 + kMinGap) * board.radius_m) {
    throw host::InputError("dots of --radius-mm " + shown(options.radius_mm) + " every --pitch-mm " +
                           shown(board.pitch_m * kMmPerM) + " would (nearly) touch; give the radius, not the diameter");
  }
  choices.fix_k3 = options.fix_k3;
  if (options.dot_threshold == "otsu") choices.dot_threshold = calibrate::DotThreshold::kOtsu;
  return choices;
}

}  // namespace pharos::tools
