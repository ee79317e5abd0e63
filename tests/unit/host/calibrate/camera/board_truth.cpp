// SPDX-License-Identifier: Apache-2.0
#include "board_truth.hpp"

#include <cmath>

#include "host/linear/dense.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::calibrate {
namespace {

constexpr int kRings = 20;
constexpr int kSpokes = 40;
constexpr double kStep_m = 1e-6;

Vector2 seen(const sim::Lens& lens, const CameraFromBoard& T, const Vector3& p_board) {
  return sim::pixel_of(lens, T * p_board);
}

}  // namespace

Vector2 true_centroid(const sim::Lens& lens, const CameraFromBoard& T_camera_board, const Board& board,
                      std::size_t index) {
  const Vector3 centre = board.point_m(index);
  if (board.kind == BoardKind::kChessboard) return seen(lens, T_camera_board, centre);
  Vector2 sum = Vector2::Zero();
  double whole = 0.0;
  for (int ring = 0; ring < kRings; ++ring) {
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const double radius = board.radius_m * (ring + 0.5) / kRings, angle = 6.283185307179586 * spoke / kSpokes;
      const Vector3 p = centre + Vector3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
      const Vector2 pixel = seen(lens, T_camera_board, p);
      const Vector2 du = seen(lens, T_camera_board, p + Vector3(kStep_m, 0.0, 0.0)) - pixel;
      const Vector2 dv = seen(lens, T_camera_board, p + Vector3(0.0, kStep_m, 0.0)) - pixel;
      const double area = std::abs(du.x() * dv.y() - du.y() * dv.x()) * radius;
      sum += area * pixel;
      whole += area;
    }
  }
  return sum / whole;
}

FoundBoard observed(const sim::Lens& lens, const CameraFromBoard& T_camera_board, const Board& board, double sigma_px,
                    std::uint64_t seed) {
  sim::RandomStream noise(seed, "found points");
  FoundBoard found;
  for (std::size_t i = 0; i < board.size(); ++i) {
    const Vector2 error(sigma_px * noise.normal(), sigma_px * noise.normal());
    const double area = 1.0;
    found.points.push_back({true_centroid(lens, T_camera_board, board, i) + error, sigma_px, area});
  }
  return found;
}

ImageOutcome image_of(const FoundBoard& found) {
  ImageOutcome image;
  image.search.status = ImageStatus::kUsed;
  image.search.board = found;
  return image;
}

std::vector<double> values_of(const PinholeCamera& camera, bool fix_k3) {
  std::vector<double> values{camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px};
  values.insert(values.end(), camera.distortion.begin(), camera.distortion.end() - (fix_k3 ? 1 : 0));
  return values;
}

PinholeCamera camera_of(const sim::Lens& lens) { return sim::optics_as<PinholeCamera>(lens); }

std::vector<double> values_of(const sim::Lens& lens, bool fix_k3) { return values_of(camera_of(lens), fix_k3); }

Errors errors_of(const BundleOutcome& outcome, const sim::Lens& lens, bool fix_k3) {
  const std::vector<double> found = values_of(outcome.state.cameras.front(), fix_k3), truth = values_of(lens, fix_k3);
  const auto size = static_cast<Eigen::Index>(truth.size());
  Eigen::VectorXd error(size);
  Errors errors;
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto at = static_cast<std::size_t>(i);
    error[i] = found[at] - truth[at];
    errors.largest = std::max(errors.largest, std::abs(error[i]) / std::sqrt(outcome.covariance(i, i)));
  }
  const Eigen::MatrixXd covariance = outcome.covariance.topLeftCorner(size, size);
  errors.nees = host::dense_mahalanobis_squared(error, covariance) / static_cast<double>(size);
  return errors;
}

}  // namespace pharos::calibrate
