// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/opencv_boards.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

namespace pharos::calibrate {
namespace {

using Pixels = std::vector<cv::Point2f>;
using Points = std::vector<cv::Point3f>;

// Half of the window around a corner, as a fraction of the shortest side: its neighbours are outside, along the
// diagonal too.
constexpr double kWindow = 0.35;
constexpr int kMaxOpenCvSteps = 100;
constexpr double kSmallestStep = 1e-12;
const cv::TermCriteria kUntilStill(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kMaxOpenCvSteps, kSmallestStep);

// OpenCV's own optimum is a start and a comparison: its floats are good to 1e-5 px.
std::vector<Pixels> pixels_of(const std::vector<FoundBoard>& views) {
  std::vector<Pixels> result;
  for (const FoundBoard& view : views) {
    Pixels& pixels = result.emplace_back();
    for (const FoundPoint& point : view.points) {
      pixels.emplace_back(static_cast<float>(point.pixel.x()), static_cast<float>(point.pixel.y()));
    }
  }
  return result;
}

std::vector<Points> boards_of(const Board& board, std::size_t views) {
  Points points;
  for (std::size_t i = 0; i < board.size(); ++i) {
    const Eigen::Vector3f p = board.point_m(i).cast<float>();
    points.emplace_back(p.x(), p.y(), p.z());
  }
  return std::vector<Points>(views, points);
}

// A camera as OpenCV has it.
struct Optics {
  cv::Matx33d K;
  cv::Mat distortion;

  Optics() = default;
  explicit Optics(const PinholeCamera& camera)
      : K(camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0, 1.0),
        distortion(cv::Mat(camera.distortion, true).t()) {}
  PinholeCamera camera(std::int32_t width_px, std::int32_t height_px) const {
    PinholeCamera camera{width_px, height_px, K(0, 0), K(1, 1), K(0, 2), K(1, 2), {}};
    std::copy_n(distortion.begin<double>(), camera.distortion.size(), camera.distortion.begin());
    return camera;
  }
};

template <class PoseType>
PoseType pose_of(const cv::Matx33d& R, const cv::Vec3d& t) {
  PoseType pose;
  cv::cv2eigen(R, pose.R);
  pose.t = {t[0], t[1], t[2]};
  return pose;
}

// Edges of a neighbour within the window would bias the corner.
double shortest_side(const Pixels& corners, int columns) {
  double shortest = std::numeric_limits<double>::infinity();
  const auto across = static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if ((i + 1) % across != 0) shortest = std::min(shortest, cv::norm(corners[i + 1] - corners[i]));
    if (i + across < corners.size()) shortest = std::min(shortest, cv::norm(corners[i + across] - corners[i]));
  }
  return shortest;
}

int flags_of(bool fix_k3) { return fix_k3 ? cv::CALIB_FIX_K3 : 0; }

}  // namespace

std::optional<Corners> opencv_corners(ImageView<const std::uint8_t> image, const Board& board) try {
  const cv::Mat grey(image.height_px, image.width_px, CV_8U, const_cast<std::uint8_t*>(image.data));
  const cv::Size size(board.columns, board.rows);
  Pixels found;
  if (!cv::findChessboardCorners(grey, size, found) &&
      !cv::findChessboardCornersSB(grey, size, found, cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY)) {
    return std::nullopt;
  }
  const int window = std::clamp(static_cast<int>(kWindow * shortest_side(found, board.columns)), 2, 11);
  cv::cornerSubPix(grey, found, {window, window}, {-1, -1}, kUntilStill);
  Corners corners;
  corners.edge_px = cv::estimateChessboardSharpness(grey, size, found)[0];
  for (const cv::Point2f& corner : found) {
    corners.pixels.emplace_back(static_cast<double>(corner.x), static_cast<double>(corner.y));
  }
  return corners;
} catch (const cv::Exception&) {
  return std::nullopt;
}

std::optional<OpencvCalibration> opencv_calibration(const Board& board, const std::vector<FoundBoard>& views,
                                                    std::int32_t width_px, std::int32_t height_px, bool fix_k3) try {
  Optics intrinsics;
  std::vector<cv::Vec3d> rotations, translations;
  OpencvCalibration result;
  result.rms_px =
      cv::calibrateCamera(boards_of(board, views.size()), pixels_of(views), {width_px, height_px}, intrinsics.K,
                          intrinsics.distortion, rotations, translations, flags_of(fix_k3), kUntilStill);
  result.state.cameras = {intrinsics.camera(width_px, height_px)};
  for (std::size_t view = 0; view < rotations.size(); ++view) {
    cv::Matx33d R;
    cv::Rodrigues(rotations[view], R);
    result.state.T_camera_board.push_back(pose_of<CameraFromBoard>(R, translations[view]));
  }
  return result;
} catch (const cv::Exception&) {
  return std::nullopt;
}

std::optional<OpencvCalibration> opencv_stereo(const Board& board, const std::vector<FoundBoard>& left,
                                               const std::vector<FoundBoard>& right, const PinholeCamera& left_camera,
                                               const PinholeCamera& right_camera, bool fix_k3) try {
  Optics left_optics(left_camera), right_optics(right_camera);
  cv::Matx33d R;
  cv::Vec3d t;
  cv::Mat E, F;
  OpencvCalibration result;
  result.rms_px = cv::stereoCalibrate(boards_of(board, left.size()), pixels_of(left), pixels_of(right), left_optics.K,
                                      left_optics.distortion, right_optics.K, right_optics.distortion,
                                      {left_camera.width_px, left_camera.height_px}, R, t, E, F,
                                      cv::CALIB_USE_INTRINSIC_GUESS | flags_of(fix_k3), kUntilStill);
  result.state.cameras = {left_optics.camera(left_camera.width_px, left_camera.height_px),
                          right_optics.camera(right_camera.width_px, right_camera.height_px)};
  result.state.T_left_right = pose_of<LeftFromRight>(R, t).inverse();
  return result;
} catch (const cv::Exception&) {
  return std::nullopt;
}

}  // namespace pharos::calibrate
