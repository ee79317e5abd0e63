// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/set_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"

namespace pharos::calibrate {
namespace {

// Poses nearer to each other than both thresholds count as one: they constrain the lens in the same way.
constexpr double kSameAngle_rad = 0.02;
constexpr double kSameShift = 0.02;  // of the distance
// With boards parallel within this, only noise separates focal length from distance.
constexpr double kMinSpread_rad = 8.0 * kRadPerDeg;
constexpr double kMaxSigma = 0.01;  // of the focal length, or of the image's width
constexpr double kMaxCornerSigma_px = 0.5;

std::string to_tenth(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

bool is_same(const CameraFromBoard& a, const CameraFromBoard& b) {
  return rotation_angle_between(a.R, b.R) < kSameAngle_rad && (a.t - b.t).norm() < kSameShift * a.t.norm();
}

int distinct_poses(const std::vector<CameraFromBoard>& poses) {
  std::vector<CameraFromBoard> distinct;
  for (const CameraFromBoard& pose : poses) {
    const auto same = [&](const CameraFromBoard& other) { return is_same(pose, other); };
    if (std::none_of(distinct.begin(), distinct.end(), same)) distinct.push_back(pose);
  }
  return static_cast<int>(distinct.size());
}

double spread_of_normals(const std::vector<CameraFromBoard>& poses) {
  double spread = 0.0;
  for (const CameraFromBoard& a : poses) {
    for (const CameraFromBoard& b : poses) {
      spread = std::max(spread, std::acos(std::clamp(a.R.col(2).dot(b.R.col(2)), -1.0, 1.0)));
    }
  }
  return spread;
}

// 1 sigma, from the distortion terms, of the image of the corner farthest from the principal point, px.
double corner_sigma(const BundleOutcome& outcome, std::size_t camera) {
  const PinholeCamera& lens = outcome.state.cameras[camera];
  const bool with_k3 = std::any_of(outcome.parameters.begin(), outcome.parameters.end(),
                                   [](const std::string& name) { return name.ends_with("k3"); });
  const Eigen::Index terms = with_k3 ? 5 : 4;
  const Eigen::Index first = static_cast<Eigen::Index>(camera) * (4 + terms) + 4;
  double worst = 0.0;
  for (const double u : {0.0, lens.width_px - 1.0}) {
    for (const double v : {0.0, lens.height_px - 1.0}) {
      const auto ray = undistort(lens, {u, v});
      if (!ray) return std::numeric_limits<double>::infinity();
      const double x = ray->x(), y = ray->y(), r2 = ray->squaredNorm();
      Eigen::Matrix<double, 2, 5> J;
      J << x * r2, x * r2 * r2, 2.0 * x * y, r2 + 2.0 * x * x, x * r2 * r2 * r2,  //
          y * r2, y * r2 * r2, r2 + 2.0 * y * y, 2.0 * x * y, y * r2 * r2 * r2;
      const Eigen::MatrixXd used = Vector2(lens.fx_px, lens.fy_px).asDiagonal() * J.leftCols(terms);
      const Eigen::MatrixXd own = outcome.covariance.block(first, first, terms, terms);
      worst = std::max(worst, std::sqrt((used * own * used.transpose()).trace()));
    }
  }
  return worst;
}

std::string whose(const BundleOutcome& outcome, std::size_t camera) {
  return outcome.state.cameras.size() == 1 ? "" : camera == 0 ? "left camera: " : "right camera: ";
}

}  // namespace

std::string what_is_degenerate(const BundleOutcome& outcome) {
  const std::vector<CameraFromBoard>& poses = outcome.state.T_camera_board;
  const int distinct = distinct_poses(poses);
  if (distinct == 1) return "the board stands in one pose in all images; move and tilt it between images";
  if (distinct < kMinViews) {
    return "the board stands in " + std::to_string(distinct) + " different poses only; move and tilt it, at least " +
           std::to_string(kMinViews) + " are needed";
  }
  const double spread = spread_of_normals(poses);
  if (spread < kMinSpread_rad) {
    return "all boards are parallel within " + to_tenth(spread / kRadPerDeg) +
           " deg: such images cannot tell focal length from distance; tilt the board by 20 to 40 deg, each way";
  }
  for (std::size_t i = 0; i < outcome.parameters.size(); ++i) {
    const std::string& name = outcome.parameters[i];
    const std::size_t camera = name.starts_with("right.") ? 1 : 0;
    const PinholeCamera& lens = outcome.state.cameras[camera];
    const auto index = static_cast<Eigen::Index>(i);
    const double sigma = std::sqrt(outcome.covariance(index, index));
    const bool focal = name.ends_with("fx_px") || name.ends_with("fy_px");
    const bool middle = name.ends_with("cx_px") || name.ends_with("cy_px");
    const double fraction = focal ? sigma / lens.fx_px : middle ? sigma / lens.width_px : 0.0;
    if (fraction > kMaxSigma) {
      return name + " is known to " + to_tenth(sigma) +
             " px only (1 sigma); tilt the board more, each way, and fill the image with it";
    }
  }
  return "";
}

std::vector<std::string> what_is_unobservable(const BundleOutcome& outcome, std::size_t camera,
                                              const Coverage& coverage, bool fixed_k3) {
  const std::string prefix = whose(outcome, camera);
  std::vector<std::string> unobservable;
  for (const std::string& part : coverage.uncovered)
    unobservable.push_back(prefix + "no point in this part of the image: " + part);
  const double sigma = corner_sigma(outcome, camera);
  if (!std::isfinite(sigma)) {
    unobservable.push_back(prefix + "the lens model folds within the image's corners: it holds only where points were");
  } else if (sigma > kMaxCornerSigma_px) {
    unobservable.push_back(prefix + "distortion in the corners is known to " + to_tenth(sigma) + " px (1 sigma)");
  }
  if (fixed_k3) unobservable.push_back(prefix + "k3 was held at 0");
  return unobservable;
}

}  // namespace pharos::calibrate
