// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/tof/board_table.hpp"

#include <array>
#include <cstdio>
#include <map>

#include "host/support/input_error.hpp"
#include "tools/calibrate/board_figure.hpp"
#include "tools/support/progress.hpp"

namespace pharos::tools {
namespace {

std::string of_images(const BoardFigure& figure) { return std::to_string(figure.images) + " images"; }

// Table 1. The published values are the lens that is rendered.
const std::map<std::string, const char*> kPublished = {{"fx_px", "608.61"}, {"fy_px", "605.04"}, {"cx_px", "321.85"},
                                                       {"cy_px", "238.94"}, {"k1", "-0.1991"},   {"k2", "0.0809"},
                                                       {"p1", "0.0021"},    {"p2", "-0.0002"}};

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

void add_board(std::vector<ComparisonRow>& rows, const std::string& board, const char* published_px,
               const BoardFigure& figure) {
  if (!figure.refusal.empty()) throw host::InputError("table 1: " + board + ": " + figure.refusal);
  ComparisonRow rms{"table 1",     board + ": reprojection RMS",
                    "px",          published_px,
                    figure.rms_px, of_images(figure) + "; theirs: OpenCV's calibration of the same points"};
  rms.theirs = figure.opencv_rms_px;
  rows.push_back(rms);
  rows.push_back({"table 1", board + ": largest error of a parameter", "its sigma", "<= 3",
                  figure.largest_error_sigmas(), "against the lens that was rendered; asked of ours"});
  for (const BoardFigure::Parameter& parameter : figure.parameters) {
    const auto published = kPublished.find(parameter.name);
    rows.push_back({"table 1", board + ": " + parameter.name, parameter.name.ends_with("_px") ? "px" : "",
                    published == kPublished.end() ? "" : published->second, parameter.value,
                    "off by " + number(parameter.value - parameter.truth) + ", sigma " + number(parameter.sigma)});
  }
  rows.push_back({"table 1", board + ": k3", "", "0", 0.0, "held at 0, as printed"});
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
