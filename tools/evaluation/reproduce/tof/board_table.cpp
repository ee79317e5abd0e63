// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/board_table.hpp"

#include "host/support/input_error.hpp"
#include "tools/calibrate/board_figure.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

std::string of_images(const BoardFigure& figure) { return std::to_string(figure.images) + " images"; }

void add_board(std::vector<ComparisonRow>& rows, const std::string& board, const char* published_px,
               const BoardFigure& figure) {
  if (!figure.refusal.empty()) throw host::InputError("table 1: " + board + ": " + figure.refusal);
  rows.push_back({"table 1", board + ": reprojection RMS", "px", published_px, figure.rms_px, of_images(figure)});
  rows.push_back({"table 1", board + ": reprojection RMS by OpenCV", "px", "", figure.opencv_rms_px, ""});
  rows.push_back({"table 1", board + ": largest error of a parameter", "its sigma", "<= 3",
                  figure.largest_error_sigmas(), "against the lens that was rendered"});
  for (const BoardFigure::Parameter& parameter : figure.parameters) {
    const bool pixels = parameter.name.ends_with("_px");
    rows.push_back({"table 1", board + ": error of " + parameter.name, pixels ? "px" : "", "",
                    parameter.value - parameter.truth, "its sigma " + std::to_string(parameter.sigma)});
  }
}

}  // namespace

std::vector<ComparisonRow> reproduce_board_table(int images, std::uint64_t seed) {
  Progress progress("paper 000's boards", "images", 2 * static_cast<std::size_t>(images));
  const auto tick = [&progress] { progress.step(); };
  std::vector<ComparisonRow> rows;
  add_board(rows, "dots", "0.008", reproduce_board_calibration(true, images, seed, tick));
  add_board(rows, "chessboard", "0.094", reproduce_board_calibration(false, images, seed, tick));
  return rows;
}

}  // namespace pharos::tools
