// SPDX-License-Identifier: Apache-2.0
#include "tools/calibrate/board_reports.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "host/calibrate/camera/board_image.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"
#include "tools/calibrate/printf_text.hpp"

namespace pharos::tools {
namespace {

using calibrate::BundleOutcome;
using calibrate::ImageOutcome;
using calibrate::ImageStatus;

constexpr double kWorse = 3.0;  // than the median image
// With a larger deviation of the dots' area the given radius is wrong; the choice of the threshold has a smaller
// effect.
constexpr double kRadiusTolerance = 0.1;

std::vector<double> values_of(const BundleOutcome& outcome) {
  std::vector<double> values;
  const bool with_k3 = std::any_of(outcome.parameters.begin(), outcome.parameters.end(),
                                   [](const std::string& name) { return name.ends_with("k3"); });
  for (const PinholeCamera& camera : outcome.state.cameras) {
    values.insert(values.end(), {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px});
    values.insert(values.end(), camera.distortion.begin(), camera.distortion.end() - (with_k3 ? 0 : 1));
  }
  if (outcome.state.cameras.size() > 1) {
    const Vector3 turn = rotation_log(outcome.state.T_left_right.R), shift = outcome.state.T_left_right.t;
    values.insert(values.end(), {turn.x(), turn.y(), turn.z(), shift.x(), shift.y(), shift.z()});
  }
  return values;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

void write_board_parameters(const BundleOutcome& outcome, const OutputOptions& options) {
  Output output(options, {"parameter", "value", "sigma"});
  const std::vector<double> values = values_of(outcome);
  for (std::size_t i = 0; i < outcome.parameters.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    output.rows().text(outcome.parameters[i]).number(values[i]);
    output.rows().number(std::sqrt(outcome.covariance(index, index))).end_row();
  }
  output.finish();
}

void write_image_statuses(const std::vector<ImageOutcome>& images, const OutputOptions& options) {
  Output output(options, {"image", "status", "points", "rms_px", "detail"});
  for (const ImageOutcome& image : images) {
    const bool used = image.search.status == ImageStatus::kUsed;
    output.rows().text(image.name).text(name_of(image.search.status));
    output.rows().integer(
        static_cast<std::int64_t>(image.search.status == ImageStatus::kUsed ? image.search.board.points.size() : 0));
    output.rows().number(used && image.rms_px > 0.0 ? std::optional(image.rms_px) : std::nullopt);
    output.rows().text(image.search.detail).end_row();
  }
  output.finish();
}

void write_board_points(const calibrate::CameraCalibration& result, const calibrate::Board& board,
                        const OutputOptions& options) {
  Output output(options, {"image", "point", "u_px", "v_px", "du_px", "dv_px"});
  host::RowWriter& rows = output.rows();
  for (const ImageOutcome& image : result.images) {
    if (!result.outcome || image.search.status != ImageStatus::kUsed) continue;
    const auto& T = result.outcome->state.T_camera_board[image.view];
    for (std::size_t i = 0; i < board.size(); ++i) {
      const Vector2 found = image.search.board.points[i].pixel;
      const Vector2 residual = found - calibrate::project_board_point(result.camera(), T, board, i).pixel;
      rows.text(image.name).integer(static_cast<std::int64_t>(i)).number(found.x()).number(found.y());
      rows.number(residual.x()).number(residual.y()).end_row();
    }
  }
  output.finish();
}

void note_images(const std::vector<ImageOutcome>& images) {
  std::map<std::string, int> statuses;
  for (const ImageOutcome& image : images) ++statuses[name_of(image.search.status)];
  std::string text = std::to_string(images.size()) + " images:";
  for (const auto& [status, count] : statuses) text += " " + std::to_string(count) + " " + status + ",";
  text.pop_back();
  note(text);
  for (const ImageOutcome& image : images) {
    // Images that could not be read were already reported.
    if (image.search.status == ImageStatus::kUsed || image.search.status == ImageStatus::kUnreadable) continue;
    note(image.name + ": " + name_of(image.search.status) + ": " + image.search.detail);
  }
}

void note_fit(const BundleOutcome& outcome, const std::vector<ImageOutcome>& images, const calibrate::Board& board) {
  const bool dots = board.kind == calibrate::BoardKind::kDots;
  note(printf_text("reprojection rms %.4f px", outcome.rms_px) +
       (dots ? printf_text(": %.2f times what the images' own noise lets expect", outcome.noise_ratio) : ""));
  std::vector<double> all;
  for (const ImageOutcome& image : images) {
    if (image.rms_px > 0.0) all.push_back(image.rms_px);
  }
  if (all.empty()) return;
  std::sort(all.begin(), all.end());
  for (const ImageOutcome& image : images) {
    if (image.rms_px > kWorse * all[all.size() / 2]) {
      note(printf_text("%s fits worse than the others: rms %.3f px, median %.3f; look at its overlay",
                       image.name.c_str(), image.rms_px, all[all.size() / 2]));
    }
  }
  const double radius_m = board.radius_m * std::sqrt(outcome.area_ratio);
  if (std::abs(radius_m / board.radius_m - 1.0) > kRadiusTolerance) {
    note(printf_text(
        "the dots look %.2f mm in radius, not %.2f as --radius-mm says; centres are corrected for the latter",
        radius_m * kMmPerM, board.radius_m * kMmPerM));
  }
}

void note_coverage(const calibrate::Coverage& coverage, const std::string& whose) {
  const std::string uncovered =
      coverage.uncovered.empty() ? "every ninth of the image has points" : "no point in: " + joined(coverage.uncovered);
  note(printf_text("%scoverage: points in %.0f %% of the image's cells, out to %.0f %% of the corners' distance; %s",
                   whose.c_str(), 100.0 * coverage.fraction, 100.0 * coverage.reach, uncovered.c_str()));
}

host::CalibrationRecord record_of(const BundleOutcome& outcome, std::size_t points,
                                  const std::vector<std::string>& unobservable) {
  host::CalibrationRecord record;
  record.images = static_cast<std::int64_t>(outcome.state.T_camera_board.size());
  record.points = static_cast<std::int64_t>(points);
  record.rms_px = outcome.rms_px;
  record.parameters = outcome.parameters;
  for (Eigen::Index i = 0; i < outcome.covariance.rows(); ++i) {
    const Eigen::VectorXd row = outcome.covariance.row(i);
    record.covariance.emplace_back(row.begin(), row.end());
  }
  record.unobservable = unobservable;
  return record;
}

}  // namespace pharos::tools
