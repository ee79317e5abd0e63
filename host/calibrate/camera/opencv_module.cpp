// SPDX-License-Identifier: Apache-2.0
// OpenCV behind the module's border.
#include "host/calibrate/camera/opencv_module.hpp"

#include <algorithm>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace pharos::calibrate {
namespace {

using Pixels = std::vector<cv::Point2f>;
using Points = std::vector<cv::Point3f>;

// Half of the window that a corner is told from, of the shortest side: along the diagonal too its neighbours stay
// outside.
constexpr double kWindow = 0.35;
constexpr int kMaxSteps = 100;
constexpr double kSmallestStep = 1e-12;
const cv::TermCriteria kUntilStill(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kMaxSteps, kSmallestStep);

// OpenCV's own optimum is a start and a comparison: its floats are good to 1e-5 px.
std::vector<Pixels> pixels_of(const ModuleViews& views, const double* pixels) {
  std::vector<Pixels> result(static_cast<std::size_t>(views.views));
  for (Pixels& view : result) {
    for (int i = 0; i < views.points; ++i, pixels += 2) {
      view.emplace_back(static_cast<float>(pixels[0]), static_cast<float>(pixels[1]));
    }
  }
  return result;
}

std::vector<Points> boards_of(const ModuleViews& views) {
  Points board;
  for (int i = 0; i < views.points; ++i) {
    const double* p = views.board + static_cast<std::ptrdiff_t>(3) * i;
    board.emplace_back(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
  }
  return std::vector<Points>(static_cast<std::size_t>(views.views), board);
}

void write_pose(const cv::Matx33d& R, const cv::Vec3d& t, double* pose) {
  std::copy(R.val, R.val + 9, pose);
  std::copy(t.val, t.val + 3, pose + 9);
}

cv::Matx33d matrix_of(const double* intrinsics) {
  return {intrinsics[0], 0.0, intrinsics[2], 0.0, intrinsics[1], intrinsics[3], 0.0, 0.0, 1.0};
}

void write_optics(const cv::Matx33d& K, const cv::Mat& distortion, double* intrinsics) {
  intrinsics[0] = K(0, 0);
  intrinsics[1] = K(1, 1);
  intrinsics[2] = K(0, 2);
  intrinsics[3] = K(1, 2);
  for (int k = 0; k < 5; ++k) intrinsics[4 + k] = distortion.at<double>(k);
}

template <class Work>
bool tried(Work work) {
  try {
    return work();
  } catch (const cv::Exception&) {
    return false;
  }
}

// A window that reaches a neighbour's edges would be pulled by them.
double shortest_side(const std::vector<cv::Point2f>& corners, int columns) {
  double shortest = std::numeric_limits<double>::infinity();
  const auto across = static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if ((i + 1) % across != 0) shortest = std::min(shortest, cv::norm(corners[i + 1] - corners[i]));
    if (i + across < corners.size()) shortest = std::min(shortest, cv::norm(corners[i + across] - corners[i]));
  }
  return shortest;
}

bool find_corners(const std::uint8_t* image, int width_px, int height_px, int columns, int rows, double* pixels,
                  double* edge_px) {
  return tried([&] {
    const cv::Mat grey(height_px, width_px, CV_8U, const_cast<std::uint8_t*>(image));
    const cv::Size size(columns, rows);
    std::vector<cv::Point2f> corners;
    if (!cv::findChessboardCorners(grey, size, corners) &&
        !cv::findChessboardCornersSB(grey, size, corners, cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY)) {
      return false;
    }
    const int window = std::clamp(static_cast<int>(kWindow * shortest_side(corners, columns)), 2, 11);
    cv::cornerSubPix(grey, corners, {window, window}, {-1, -1}, kUntilStill);
    *edge_px = cv::estimateChessboardSharpness(grey, size, corners)[0];
    for (const cv::Point2f& corner : corners) {
      *pixels++ = static_cast<double>(corner.x);
      *pixels++ = static_cast<double>(corner.y);
    }
    return true;
  });
}

bool calibrate(const ModuleViews& views, const double* pixels, double* intrinsics, double* poses, double* rms_px) {
  return tried([&] {
    cv::Matx33d K;
    cv::Mat distortion;
    std::vector<cv::Vec3d> rotations, translations;
    *rms_px =
        cv::calibrateCamera(boards_of(views), pixels_of(views, pixels), {views.width_px, views.height_px}, K,
                            distortion, rotations, translations, views.fix_k3 ? cv::CALIB_FIX_K3 : 0, kUntilStill);
    write_optics(K, distortion, intrinsics);
    for (std::size_t view = 0; view < rotations.size(); ++view) {
      cv::Matx33d R;
      cv::Rodrigues(rotations[view], R);
      write_pose(R, translations[view], poses + 12 * view);
    }
    return true;
  });
}

bool calibrate_stereo(const ModuleViews& views, const double* left, const double* right, double* intrinsics,
                      double* pose, double* rms_px) {
  return tried([&] {
    cv::Matx33d K_left = matrix_of(intrinsics), K_right = matrix_of(intrinsics + 9), R;
    cv::Mat left_distortion(1, 5, CV_64F, intrinsics + 4), right_distortion(1, 5, CV_64F, intrinsics + 13), E, F;
    left_distortion = left_distortion.clone();
    right_distortion = right_distortion.clone();
    cv::Vec3d t;
    const int flags = cv::CALIB_USE_INTRINSIC_GUESS | (views.fix_k3 ? cv::CALIB_FIX_K3 : 0);
    *rms_px = cv::stereoCalibrate(boards_of(views), pixels_of(views, left), pixels_of(views, right), K_left,
                                  left_distortion, K_right, right_distortion, {views.width_px, views.height_px}, R, t,
                                  E, F, flags, kUntilStill);
    write_optics(K_left, left_distortion, intrinsics);
    write_optics(K_right, right_distortion, intrinsics + 9);
    write_pose(R, t, pose);
    return true;
  });
}

constexpr OpencvModule kModule{find_corners, calibrate, calibrate_stereo};

}  // namespace
}  // namespace pharos::calibrate

extern "C" const pharos::calibrate::OpencvModule* pharos_opencv_boards() { return &pharos::calibrate::kModule; }
