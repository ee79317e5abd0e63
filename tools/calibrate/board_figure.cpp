// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/board_figure.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibrate/camera/camera_calibration.hpp"
#include "host/images/canvas.hpp"
#include "tools/sim/board/board_poses.hpp"

namespace pharos::tools {
namespace {

constexpr sim::Exposure kRetroReflective{2000.0, 30000.0, 1000.0, 0.5, 280.0, 0.3, 16};
constexpr sim::Exposure kPrinted{700.0, 3500.0, 500.0, 0.5, 280.0, 0.3, 16};

std::vector<BoardFigure::Parameter> parameters_of(const calibrate::BundleOutcome& outcome) {
  const sim::Lens& lens = sim::kPaperLens;
  const PinholeCamera& camera = outcome.state.cameras.front();
  std::vector<double> truth{lens.fx_px, lens.fy_px, lens.cx_px, lens.cy_px};
  std::vector<double> value{camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px};
  truth.insert(truth.end(), lens.distortion.begin(), lens.distortion.end());
  value.insert(value.end(), camera.distortion.begin(), camera.distortion.end());
  std::vector<BoardFigure::Parameter> parameters;
  for (std::size_t i = 0; i < outcome.parameters.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    parameters.push_back({outcome.parameters[i], truth[i], value[i], std::sqrt(outcome.covariance(index, index))});
  }
  return parameters;
}

}  // namespace

double BoardFigure::largest_error_sigmas() const {
  double largest = 0.0;
  for (const Parameter& parameter : parameters) largest = std::max(largest, std::abs(parameter.error_sigmas()));
  return largest;
}

BoardFigure reproduce_board_calibration(bool dots, int images, std::uint64_t seed, const std::function<void()>& tick) {
  sim::BoardSheet sheet;
  sheet.dots = dots;
  calibrate::CalibrationChoices choices;
  choices.board.kind = dots ? calibrate::BoardKind::kDots : calibrate::BoardKind::kChessboard;
  choices.fix_k3 = true;
  const sim::BoardRenderer renderer(sim::kPaperLens);
  std::vector<calibrate::ImageOutcome> found;
  for (const auto& T_camera_board : sim::board_poses(sim::kPaperLens, sheet, images, seed)) {
    const std::uint64_t noise_seed = 1000 * seed + found.size();
    const host::GreyImage image =
        renderer.render(sheet, T_camera_board, dots ? kRetroReflective : kPrinted, noise_seed);
    found.push_back({std::to_string(found.size()), calibrate::find_board(image.view(), choices.board)});
    tick();
  }
  const calibrate::CameraCalibration result =
      calibrate::calibrate_camera(std::move(found), sim::kPaperLens.width_px, sim::kPaperLens.height_px, choices);
  BoardFigure figure;
  figure.refusal = result.refusal;
  if (!result.outcome) return figure;
  figure.images = static_cast<int>(result.outcome->state.T_camera_board.size());
  figure.rms_px = result.outcome->rms_px;
  figure.opencv_rms_px = result.opencv_rms_px;
  figure.parameters = parameters_of(*result.outcome);
  return figure;
}

void write_board_pictures(const std::string& prefix, std::uint64_t seed) {
  const sim::BoardSheet sheet;
  const sim::BoardRenderer renderer(sim::kPaperLens);
  const auto poses = sim::board_poses(sim::kPaperLens, sheet, 1, seed);
  const host::GreyImage image = renderer.render(sheet, poses.front(), kRetroReflective, 1000 * seed);
  host::write_grey_png(prefix + "board.png", image.view(), 8);
  const calibrate::ImageOutcome found{"0", calibrate::find_board(image.view(), calibrate::CalibrationChoices{}.board)};
  host::Canvas canvas(image.view(), 1);
  std::vector<host::Place> places;
  for (const auto& point : found.search.board.points) places.push_back({point.pixel.x(), point.pixel.y()});
  canvas.polyline(places, host::colours::kGreen);
  for (const host::Place& place : places) canvas.cross(place, host::colours::kRed, 3.0);
  canvas.write_png(prefix + "dots.png");
}

}  // namespace pharos::tools
