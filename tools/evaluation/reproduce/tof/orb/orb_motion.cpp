// SPDX-License-Identifier: Apache-2.0
// OpenCV's ORB, matcher and RANSAC: what the paper compares itself with.
#include "tools/evaluation/reproduce/tof/orb/orb_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

namespace pharos::tools {
namespace {

using sim::TofPixels;

constexpr int kFeatures = 1000;
constexpr double kFullPicture = 255.0;
constexpr double kBrightestFraction = 0.995;  // of the pixels lie below the picture's white
constexpr float kRatio = 0.8F;                // of the best match's distance to the second best
constexpr int kMinMatches = 8;
// A motion is believed where this many pairs agree with it and the second frame's own depths are where it puts the
// points, in the median: a solution that diverged has neither.
constexpr int kMinAgreeing = 20;
constexpr double kMaxDepthError_m = 0.02;
constexpr int kTrials = 500;
constexpr float kMaxError_px = 2.0F;

struct Features {
  std::vector<cv::KeyPoint> points;
  cv::Mat words;
};

// The grey picture of 8 bits that ORB takes, by the square root, so that the dark foil keeps its texture.
cv::Mat picture(const TofPixels& frame) {
  const cv::Mat raw(frame.height_px, frame.width_px, CV_16U, const_cast<std::uint16_t*>(frame.intensity.data()));
  cv::Mat grey;
  raw.convertTo(grey, CV_32F);
  cv::Mat sorted;
  cv::sort(grey.reshape(1, 1), sorted, cv::SORT_ASCENDING);
  const float white = sorted.at<float>(static_cast<int>(kBrightestFraction * (sorted.cols - 1)));
  cv::sqrt(cv::min(grey / static_cast<double>(white), 1.0), grey);
  cv::Mat result;
  grey.convertTo(result, CV_8U, kFullPicture);
  return result;
}

Features features_of(const TofPixels& frame) {
  Features features;
  cv::ORB::create(kFeatures)->detectAndCompute(picture(frame), cv::noArray(), features.points, features.words);
  return features;
}

int depth_counts(const TofPixels& frame, const cv::Point2d& place) {
  return frame.depth[static_cast<std::size_t>(cvRound(place.y) * frame.width_px + cvRound(place.x))];
}

// Median distance along z between where the motion puts the points and what the second frame's depths say there.
double depth_error_m(const std::vector<cv::Point3d>& points, const std::vector<cv::Point2d>& to, const cv::Mat& R,
                     const cv::Mat& t, const TofPixels& second, const DepthCamera& camera) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int counts = depth_counts(second, to[i]);
    if (counts == 0) continue;
    const cv::Point3d& p = points[i];
    const double z = R.at<double>(2, 0) * p.x + R.at<double>(2, 1) * p.y + R.at<double>(2, 2) * p.z + t.at<double>(2);
    errors.push_back(std::abs(z - counts * camera.depth_scale_m));
  }
  if (errors.size() < static_cast<std::size_t>(kMinMatches)) return std::numeric_limits<double>::infinity();
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

bool motion(const TofPixels& first, const TofPixels& second, const DepthCamera& camera, cv::Mat& R, cv::Mat& t) {
  const Features one = features_of(first);
  const Features other = features_of(second);
  if (one.words.empty() || other.words.empty()) return false;
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher(cv::NORM_HAMMING).knnMatch(one.words, other.words, matches, 2);

  const PinholeCamera& lens = camera.intrinsics;
  const cv::Matx33d K(lens.fx_px, 0, lens.cx_px, 0, lens.fy_px, lens.cy_px, 0, 0, 1);
  const cv::Mat distortion(lens.distortion, true);
  std::vector<cv::Point2d> from;
  std::vector<cv::Point2d> to;
  std::vector<double> depth_m;
  for (const std::vector<cv::DMatch>& match : matches) {
    if (match.size() < 2 || match[0].distance > kRatio * match[1].distance) continue;
    const cv::Point2f place = one.points[static_cast<std::size_t>(match[0].queryIdx)].pt;
    const int counts = depth_counts(first, place);
    if (counts == 0) continue;
    from.emplace_back(place);
    to.emplace_back(other.points[static_cast<std::size_t>(match[0].trainIdx)].pt);
    depth_m.push_back(counts * camera.depth_scale_m);
  }
  if (from.size() < kMinMatches) return false;
  std::vector<cv::Point2d> rays;
  cv::undistortPoints(from, rays, K, distortion);
  std::vector<cv::Point3d> points;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    points.emplace_back(rays[i].x * depth_m[i], rays[i].y * depth_m[i], depth_m[i]);
  }
  cv::theRNG().state = 1;  // the same pairs give the same motion
  cv::Mat turn;
  cv::Mat inliers;
  if (!cv::solvePnPRansac(points, to, K, distortion, turn, t, false, kTrials, kMaxError_px, 0.999, inliers)) {
    return false;
  }
  if (inliers.rows < kMinAgreeing) return false;
  std::vector<cv::Point3d> agreeing;
  std::vector<cv::Point2d> seen;
  for (int i = 0; i < inliers.rows; ++i) {
    agreeing.push_back(points[static_cast<std::size_t>(inliers.at<int>(i))]);
    seen.push_back(to[static_cast<std::size_t>(inliers.at<int>(i))]);
  }
  cv::solvePnPRefineLM(agreeing, seen, K, distortion, turn, t);
  cv::Rodrigues(turn, R);
  return depth_error_m(agreeing, seen, R, t, second, camera) < kMaxDepthError_m;
}

}  // namespace

std::optional<Pose<frame::Camera, frame::Camera>> orb_motion(const TofPixels& first, const TofPixels& second,
                                                             const DepthCamera& camera) try {
  cv::Mat R, t;
  if (!motion(first, second, camera, R, t)) return std::nullopt;
  Pose<frame::Camera, frame::Camera> moved;
  cv::cv2eigen(R, moved.R);
  cv::cv2eigen(t, moved.t);
  return moved;
} catch (const cv::Exception&) {
  return std::nullopt;
}

}  // namespace pharos::tools
